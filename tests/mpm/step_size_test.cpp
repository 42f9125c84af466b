// How long a step is, and when it is repeated.

#include <gtest/gtest.h>

#include <vector>

#include "problems/error.h"
#include "tests/mpm/engine_helper.h"

namespace conebench::test {
namespace {

using Eigen::Vector3d;
using mpm::Scene;
using mpm::Simulation;

TEST(Step, KeepsTheCflNumber) {
  Scene scene = thrown(2);
  scene.blocks[0].velocity_m_s = {30.0, 0.0, 0.0};  // 0.6 cells in step_s
  Simulation simulation(scene, step_solver("auto", 1e-6));
  std::vector<double> sizes;
  simulation.add_observer([&](const mpm::StepView& view) {
    sizes.push_back(view.h);
    for (const Vector3d& v : view.particles->velocity) {
      EXPECT_LE(view.h * v.cwiseAbs().maxCoeff() / 0.1, scene.cfl * (1.0 + 1e-12));
    }
  });
  run(simulation, 4);
  EXPECT_EQ(sizes, std::vector<double>(4, 1e-3));
  EXPECT_EQ(simulation.time_s(), 4e-3);
  EXPECT_EQ(simulation.summary().repeated_steps, 0);
}

// A solver whose first `wrong` answers push apart what should lie still.
engine::StepSolver pushing(int wrong, double times) {
  return [wrong, times, calls = 0, right = step_solver("gs", 1e-8)](
             const problems::Problem& standard, const Eigen::VectorXd& guess) mutable {
    engine::StepAnswer answer = right(standard, guess);
    if (calls++ < wrong) answer.r *= times;
    return answer;
  };
}

TEST(Step, IsRepeatedAtHalfTheSizeWhereAParticleWouldCrossACell) {
  Scene scene = box_scene({6, 6});
  add_block(scene, Vector3d::Zero(), {6.0, 3.0, 0.0});
  Simulation simulation(scene, pushing(1, 1e5));
  const auto before = simulation.particles().position;
  double h = 0.0;
  simulation.add_observer([&](const mpm::StepView& view) { h = view.h; });
  simulation.step();
  EXPECT_EQ(simulation.summary().repeated_steps, 1);
  EXPECT_EQ(simulation.summary().steps, 1);
  EXPECT_EQ(h, 0.5 * scene.step_s);
  for (std::size_t p = 0; p < before.size(); ++p) {
    const Vector3d moved = simulation.particles().position[p] - before[p];
    EXPECT_LT(moved.norm(), 1e-3 * 0.1) << "the first answer left a trace";
  }
  simulation.step();
  EXPECT_EQ(simulation.time_s(), scene.step_s) << "the rest of the period comes next";
}

TEST(Step, NeverMovesAParticleByMoreThanACell) {
  Scene scene = box_scene({6, 6});
  add_block(scene, Vector3d::Zero(), {6.0, 3.0, 0.0});
  Simulation simulation(scene, pushing(3, 3e4));
  auto before = simulation.particles().position;
  for (int k = 0; k < 5; ++k) {
    simulation.step();
    for (std::size_t p = 0; p < before.size(); ++p) {
      const Vector3d moved = simulation.particles().position[p] - before[p];
      EXPECT_LE(moved.cwiseAbs().maxCoeff(), 0.1 * (1.0 + 1e-12));
    }
    before = simulation.particles().position;
  }
  EXPECT_GE(simulation.summary().repeated_steps, 1);
}

TEST(Step, GivesUpWhereNoSizeIsShortEnough) {
  Scene scene = box_scene({6, 6});
  add_block(scene, Vector3d::Zero(), {6.0, 3.0, 0.0});
  Simulation simulation(scene, [](const problems::Problem& standard, const Eigen::VectorXd&) {
    engine::StepAnswer answer;
    answer.r = Eigen::VectorXd::Zero(standard.rows());
    answer.r[standard.start(standard.cone_count() / 2)] = 1e12;
    return answer;
  });
  EXPECT_THROW(simulation.step(), problems::InputError);
}

TEST(Step, TimeEndsAtTheDuration) {
  Scene scene = thrown(2);
  scene.duration_s = 0.02;
  Simulation simulation(scene, step_solver("auto", 1e-6));
  while (!simulation.finished()) simulation.step();
  EXPECT_NEAR(simulation.time_s(), 0.02, 1e-15);
  EXPECT_EQ(simulation.summary().steps, 10);
}

}  // namespace
}  // namespace conebench::test
