// A run that is saved, and restarted in another simulation, goes on bit for bit.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>

#include "problems/error.h"
#include "tests/engine/own_folder.h"
#include "tests/engine/small_solver.h"
#include "tests/mpm/engine_helper.h"

namespace conebench::test {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;
using mpm::Simulation;
using testing::HasSubstr;

// A cohesive column under a falling ball, friction that rises with the strain rate, a free wall.
mpm::Scene busy() {
  mpm::Scene scene = box_scene({8, 6});
  scene.walls[1].condition = mpm::Condition::kFree;
  scene.material.cohesion_Pa = 300.0;
  scene.material.cohesion_decay = 0.5;
  scene.material.friction_rise = 0.2;
  scene.material.grain_diameter_m = 1e-3;
  mpm::Block& block = add_block(scene, {5.0, 0.0, 0.0}, {7.9, 3.0, 0.0});
  block.jitter = 0.6;
  block.velocity_m_s = {1.0, 0.0, 0.0};
  mpm::Body ball;
  ball.motion = mpm::Motion::kFree;
  ball.radius_m = 0.11;
  ball.density_kg_m3 = 3000.0;
  ball.centre_m = {0.6, 0.42, 0.0};
  ball.velocity_m_s = {0.0, -3.0, 0.0};
  ball.angular_velocity_rad_s = {0.0, 0.0, 2.0};
  ball.friction = 0.4;
  scene.bodies.push_back(ball);
  return scene;
}

// Few sweeps, so that what the solver starts from shows in the result.
engine::StepSolver sloppy() { return small_solver(1e-4); }

class Checkpoint : public OwnFolder {
 protected:
  Checkpoint() : path_(folder_ / "run.checkpoint") { fs::create_directories(folder_); }

  // What restarting from path_ complains of, or "no error".
  std::string error_of_restart(const mpm::Scene& scene) const {
    Simulation simulation(scene, sloppy());
    const auto before = simulation.particles().position;
    try {
      simulation.restart(path_);
    } catch (const problems::InputError& error) {
      EXPECT_EQ(simulation.time_s(), 0.0) << "half a restart";
      EXPECT_EQ(simulation.particles().position, before) << "half a restart";
      return error.what();
    }
    return "no error";
  }

  fs::path path_;
};

void expect_same(const Simulation& a, const Simulation& b) {
  EXPECT_EQ(a.time_s(), b.time_s());
  EXPECT_EQ(a.particles().position, b.particles().position);
  EXPECT_EQ(a.particles().velocity, b.particles().velocity);
  EXPECT_EQ(a.particles().affine, b.particles().affine);
  EXPECT_EQ(a.particles().volume, b.particles().volume);
  EXPECT_EQ(a.particles().cohesion, b.particles().cohesion);
  EXPECT_EQ(a.particles().inertial_number, b.particles().inertial_number);
  EXPECT_EQ(a.particles().stress, b.particles().stress);
  for (std::size_t k = 0; k < a.bodies().size(); ++k) {
    EXPECT_EQ(a.bodies()[k].centre_m, b.bodies()[k].centre_m);
    EXPECT_EQ(a.bodies()[k].velocity, b.bodies()[k].velocity);
    EXPECT_EQ(a.bodies()[k].angular_velocity, b.bodies()[k].angular_velocity);
    EXPECT_EQ(a.bodies()[k].orientation.coeffs(), b.bodies()[k].orientation.coeffs());
  }
}

TEST_F(Checkpoint, RestartedRunGoesOnBitForBit) {
  for (const mpm::Law law : {mpm::Law::kMonotone, mpm::Law::kDenseOnly}) {
    mpm::Scene scene = busy();
    scene.material.law = law;
    Simulation whole(scene, sloppy());
    run(whole, 40);
    Simulation first(scene, sloppy());
    run(first, 20);
    first.save(path_);
    Simulation second(scene, sloppy());
    second.restart(path_);
    expect_same(first, second);
    run(second, 20);
    expect_same(whole, second);
    ASSERT_GT(whole.summary().left_particles, 0) << "the scene is not as busy as it should be";
    ASSERT_NE(whole.bodies()[0].velocity.x(), 0.0) << "the ball meets nothing";
    EXPECT_EQ(whole.summary().steps, second.summary().steps);
    EXPECT_EQ(whole.summary().solves, second.summary().solves);
    EXPECT_EQ(whole.summary().iterations, second.summary().iterations);
    EXPECT_EQ(whole.summary().left_particles, second.summary().left_particles);
    EXPECT_EQ(whole.summary().left_volume_m3, second.summary().left_volume_m3);
    EXPECT_EQ(whole.summary().unconverged_steps, second.summary().unconverged_steps);
  }
}

TEST_F(Checkpoint, SavingDoesNotDisturbTheRun) {
  Simulation undisturbed(busy(), sloppy()), saved(busy(), sloppy());
  for (int k = 0; k < 10; ++k) {
    undisturbed.step();
    saved.step();
    saved.save(path_);
  }
  expect_same(undisturbed, saved);
}

TEST_F(Checkpoint, OfAnotherSceneOrOfOtherSettingsIsRefused) {
  Simulation simulation(busy(), sloppy());
  run(simulation, 3);
  simulation.save(path_);
  mpm::Scene other = busy();
  other.material.friction = 0.41;
  EXPECT_THAT(error_of_restart(other), HasSubstr("is of another scene"));
  other = busy();
  other.name = "another";
  EXPECT_THAT(error_of_restart(other), HasSubstr("than another"));
}

TEST_F(Checkpoint, CutShortIsRefusedWhereverItWasCut) {
  Simulation simulation(busy(), sloppy());
  run(simulation, 3);
  simulation.save(path_);
  std::ifstream file(path_, std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(file), {}};
  ASSERT_GT(whole.size(), 5000u);
  for (const double share : {0.0, 0.001, 0.1, 0.5, 0.9, 1.0}) {
    const auto length = static_cast<std::streamsize>(share * static_cast<double>(whole.size())) -
                        (share == 1.0 ? 1 : 0);
    std::ofstream(path_, std::ios::binary | std::ios::trunc).write(whole.data(), length);
    EXPECT_THAT(error_of_restart(busy()), HasSubstr("run.checkpoint: not a whole checkpoint"))
        << length;
  }
}

TEST_F(Checkpoint, OtherFilesAreRefused) {
  std::ofstream(path_) << "schema = 1\nengine = \"mpm\"\n";
  EXPECT_THAT(error_of_restart(busy()), HasSubstr("not a whole checkpoint"));
  std::ofstream(path_, std::ios::trunc) << '\xa1' << "fformata1";  // CBOR: {"format": "1"}
  EXPECT_THAT(error_of_restart(busy()), HasSubstr("not a"));
  fs::remove(path_);
  EXPECT_THAT(error_of_restart(busy()), HasSubstr("cannot be read"));
  fs::create_directory(path_);
  EXPECT_THAT(error_of_restart(busy()), HasSubstr("cannot be read"));
}

TEST_F(Checkpoint, UnwritablePathIsAnOutputError) {
  Simulation simulation(busy(), sloppy());
  EXPECT_THROW(simulation.save(folder_ / "no" / "such" / "folder"), problems::OutputError);
}

// ---- What a step solver may not do

// Answers with `spoil` applied to the right r.
engine::StepSolver spoilt(const std::function<void(Eigen::VectorXd&)>& spoil) {
  return [spoil, right = small_solver(1e-6)](const problems::Problem& standard,
                                             const Eigen::VectorXd& guess) {
    engine::StepAnswer answer = right(standard, guess);
    spoil(answer.r);
    answer.status = "made_up";
    return answer;
  };
}

std::string error_of_step(const std::function<void(Eigen::VectorXd&)>& spoil) {
  Simulation simulation(busy(), spoilt(spoil));
  try {
    simulation.step();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "no error";
}

TEST(StepSolver, NumbersThatAreNotFiniteAreAnErrorThatNamesSceneStepAndStatus) {
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    const std::string error = error_of_step([bad](Eigen::VectorXd& r) { r[r.size() / 2] = bad; });
    EXPECT_THAT(error, HasSubstr("small: step 0: the solver (status made_up)"));
    EXPECT_THAT(error, HasSubstr("expected"));
  }
}

TEST(StepSolver, TooFewOrTooManyNumbersAreAnError) {
  EXPECT_THAT(error_of_step([](Eigen::VectorXd& r) { r.conservativeResize(r.size() - 1); }),
              HasSubstr("small: step 0"));
  EXPECT_THAT(error_of_step([](Eigen::VectorXd& r) { r = Eigen::VectorXd::Zero(r.size() + 1); }),
              HasSubstr("small: step 0"));
}

TEST(StepSolver, AnswersBeyondAllBoundsAreAnError) {
  EXPECT_NE(error_of_step([](Eigen::VectorXd& r) { r.setConstant(1e308); }), "no error");
  EXPECT_NE(error_of_step([](Eigen::VectorXd& r) {
              for (Eigen::Index i = 0; i < r.size(); ++i) r[i] = i % 2 == 0 ? 1e308 : -1e308;
            }),
            "no error");
}

TEST(StepSolver, ThatDoesNotConvergeIsCountedAndTheRunGoesOn) {
  Simulation simulation(busy(), [](const problems::Problem&, const Eigen::VectorXd& guess) {
    return engine::StepAnswer{guess, false, "iteration_limit", 1, 0.0};
  });
  run(simulation, 3);
  EXPECT_EQ(simulation.summary().unconverged_steps, 3);
  EXPECT_EQ(simulation.summary().steps, 3);
}

}  // namespace
}  // namespace conebench::test
