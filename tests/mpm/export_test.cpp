// The problems that a running simulation writes, read back.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <filesystem>

#include "problems/error.h"
#include "problems/problem_file.h"
#include "problems/residual.h"
#include "tests/engine/own_folder.h"
#include "tests/mpm/engine_helper.h"

namespace conebench::test {
namespace {

namespace fs = std::filesystem;
using mpm::NodeState;
using mpm::Simulation;

class Export : public OwnFolder {};

// A cohesive block beside a wall of friction, its top off the grid, and a ball on it.
mpm::Scene cohesive(int dim) {
  mpm::Scene scene = box_scene(dim == 2 ? std::vector{7, 6} : std::vector{4, 4, 5});
  scene.name = "heap";
  scene.material.cohesion_Pa = 150.0;
  scene.walls[0] = {mpm::Condition::kFrictional, 0.3};
  add_block(scene, Eigen::Vector3d::Zero(),
            dim == 2 ? Eigen::Vector3d(4.0, 2.7, 0.0) : Eigen::Vector3d(3.0, 4.0, 1.7));
  mpm::Body ball;
  ball.motion = mpm::Motion::kFree;
  ball.radius_m = 0.11;
  ball.density_kg_m3 = 2500.0;
  ball.centre_m = dim == 2 ? Eigen::Vector3d(0.2, 0.37, 0.0) : Eigen::Vector3d(0.15, 0.2, 0.28);
  ball.velocity_m_s[dim - 1] = -1.0;
  scene.bodies.push_back(ball);
  return scene;
}

// What the engine solved in its last step.
struct Solved {
  Eigen::VectorXd r, f, standard_f, q;
  double eta = 0.0, h = 0.0;
  std::vector<NodeState> states;
  Eigen::VectorXd fraction;
  int nodes = 0, interfaces = 0;
  std::vector<Eigen::Vector3d> points;
};

Solved remember(const mpm::StepView& view) {
  Solved solved;
  solved.r = view.answer->r;
  solved.f = view.problem->f();
  solved.standard_f = view.standard->f();
  solved.q = view.standard->q();
  solved.eta = problems::evaluate_eta(*view.standard, solved.r);
  solved.h = view.h;
  solved.states = *view.states;
  solved.nodes = view.nodes->count();
  solved.interfaces = static_cast<int>(view.assembly->interfaces.size());
  solved.fraction.resize(solved.nodes);
  for (int i = 0; i < solved.nodes; ++i) {
    solved.fraction[i] = view.nodes->solid[i] / view.nodes->volume[i];
    const auto slot = static_cast<std::size_t>(i);
    solved.points.push_back(view.scene->grid.position(view.nodes->index[slot]));
  }
  return solved;
}

class ExportIn : public Export, public testing::WithParamInterface<int> {};
INSTANTIATE_TEST_SUITE_P(Dimensions, ExportIn, testing::Values(2, 3), dimension_name);

TEST_P(ExportIn, ProblemsReadBackAsTheyWereSolved) {
  Simulation simulation(cohesive(GetParam()), step_solver("auto", 1e-6));
  std::vector<Solved> steps;
  simulation.add_observer([&](const mpm::StepView& view) { steps.push_back(remember(view)); });
  mpm::Exporter exporter(folder_, engine::parse_selection("all"), simulation.scene());
  simulation.add_observer(std::ref(exporter));
  run(simulation, 8);
  exporter.finish();
  int cohesive_steps = 0;
  for (std::size_t step = 0; step < 8; ++step) {
    const Solved& solved = steps[step];
    const auto path = folder_ / ("heap_00000" + std::to_string(step) + ".h5");
    ASSERT_TRUE(fs::exists(path));
    const auto file = problems::read_problem_file(path);
    const problems::Problem standard = file.problem.shifted();
    ASSERT_TRUE(file.solution);
    EXPECT_EQ(file.solution->r, solved.r);
    EXPECT_NEAR(problems::evaluate_eta(standard, file.solution->r), solved.eta,
                1e-6 * solved.eta + 1e-15);
    EXPECT_NEAR(file.solution->eta, solved.eta, 1e-6 * solved.eta + 1e-15);
    // kappa beside the unshifted f: shifting what was read gives what was solved.
    EXPECT_LT((standard.f() - solved.standard_f).norm(), 1e-14 * solved.standard_f.norm());
    EXPECT_LT((standard.q() - solved.q).norm(), 1e-13 * solved.q.norm());
    EXPECT_EQ(file.problem.f(), solved.f);
    cohesive_steps += !file.problem.is_standard();
    EXPECT_EQ(solved.f == solved.standard_f, file.problem.is_standard());
    EXPECT_EQ(file.guess.size(), solved.r.size());
  }
  EXPECT_GT(cohesive_steps, 0);
  EXPECT_EQ(exporter.written(), 8);
  EXPECT_EQ(count(), 8u);
}

TEST_P(ExportIn, FilesSayWhereTheNodesAreAndWhatTheyDo) {
  Simulation simulation(cohesive(GetParam()), step_solver("auto", 1e-6));
  Solved solved;
  simulation.add_observer([&](const mpm::StepView& view) { solved = remember(view); });
  mpm::Exporter exporter(folder_, engine::parse_selection("all"), simulation.scene());
  simulation.add_observer(std::ref(exporter));
  run(simulation, 8);
  exporter.finish();
  const auto file = problems::read_problem_file(folder_ / "heap_000007.h5");
  ASSERT_TRUE(file.geometry);
  const problems::Geometry& geometry = *file.geometry;
  ASSERT_GT(solved.interfaces, 0);
  ASSERT_EQ(file.problem.cone_count(), solved.nodes + solved.interfaces);
  ASSERT_EQ(geometry.state.size(), static_cast<std::size_t>(file.problem.cone_count()));
  ASSERT_EQ(geometry.volume_fraction.size(), file.problem.cone_count());
  std::array<int, 3> states{};
  for (int i = 0; i < solved.nodes; ++i) {
    const auto slot = static_cast<std::size_t>(i);
    EXPECT_EQ(geometry.state[slot], static_cast<int>(solved.states[slot]));
    ++states[static_cast<std::size_t>(geometry.state[slot])];
    EXPECT_EQ(geometry.volume_fraction[i], solved.fraction[i]);
    EXPECT_EQ(geometry.points.row(i).transpose(), solved.points[slot]);
    // A state says which law was solved: loose nodes are dry, the others have no gap.
    const bool loose = geometry.state[slot] == static_cast<int>(NodeState::kLoose);
    EXPECT_EQ(file.problem.cones()[slot].kappa == 0.0, loose) << "node " << i;
    if (loose) continue;
    EXPECT_EQ(file.problem.w()[file.problem.start(i)], 0.0) << "node " << i;
  }
  EXPECT_GT(states[0] * states[2], 0) << "only one kind of node";
  for (int i = solved.nodes; i < file.problem.cone_count(); ++i) {
    EXPECT_EQ(geometry.state[static_cast<std::size_t>(i)], -1);
    EXPECT_EQ(geometry.volume_fraction[i], 0.0);
    EXPECT_EQ(file.problem.cones()[static_cast<std::size_t>(i)].kappa, 0.0);
  }
  EXPECT_EQ(geometry.body_radii[0], 0.11);
}

TEST_F(Export, FilesSayWhatTheyAre) {
  Simulation simulation(cohesive(2), step_solver("auto", 1e-6));
  mpm::Exporter exporter(folder_, engine::parse_selection("every:3"), simulation.scene());
  simulation.add_observer(std::ref(exporter));
  run(simulation, 7);
  exporter.finish();
  EXPECT_EQ(exporter.written(), 3);
  EXPECT_EQ(count(), 3u);
  const auto file = problems::read_problem_file(folder_ / "heap_000003.h5");
  const problems::Metadata& metadata = file.problem.metadata();
  EXPECT_EQ(metadata.name, "heap_000003");
  EXPECT_EQ(metadata.engine, "mpm");
  EXPECT_EQ(metadata.scene, "heap");
  EXPECT_EQ(metadata.step, 3);
  EXPECT_EQ(metadata.step_size_s, 2e-3);
  EXPECT_EQ(metadata.sampling_weight, 3.0);
  EXPECT_EQ(metadata.force_unit, "Pa s");
  EXPECT_EQ(metadata.rate_unit, "m3/s");
}

// kappa = h (c / mu) sqrt(d/2) and mu sqrt(2/d), read from the file.
TEST_P(ExportIn, ConesAreThoseOfTheMaterial) {
  const int dim = GetParam();
  Simulation simulation(cohesive(dim), step_solver("auto", 1e-6));
  mpm::Exporter exporter(folder_, engine::parse_selection("0..0"), simulation.scene());
  simulation.add_observer(std::ref(exporter));
  simulation.step();
  exporter.finish();
  const auto file = problems::read_problem_file(folder_ / "heap_000000.h5");
  int cohesive_cones = 0;
  for (const problems::Cone& cone : file.problem.cones()) {
    if (cone.dim != (dim == 2 ? 3 : 6)) continue;
    EXPECT_NEAR(cone.mu, 0.4 * std::sqrt(2.0 / dim), 1e-15);
    EXPECT_EQ(cone.theta, cone.mu);
    if (cone.kappa == 0.0) continue;
    EXPECT_NEAR(cone.kappa, 2e-3 * 150.0 / 0.4 * std::sqrt(dim / 2.0), 1e-12);
    ++cohesive_cones;
  }
  EXPECT_GT(cohesive_cones, 0);
}

TEST_F(Export, StepsWithoutSandAreCountedNotWritten) {
  mpm::Scene scene = open_scene({3, 3});
  scene.gravity_m_s2.setZero();
  add_block(scene, {2.0, 1.0, 0.0}, {3.0, 2.0, 0.0}).velocity_m_s = {50.0, 0.0, 0.0};
  Simulation simulation(scene, step_solver("auto", 1e-6));
  mpm::Exporter exporter(folder_, engine::parse_selection("all"), simulation.scene());
  simulation.add_observer(std::ref(exporter));
  run(simulation, 10);
  exporter.finish();
  EXPECT_EQ(simulation.particles().count(), 0u);
  EXPECT_GT(exporter.written(), 0);
  EXPECT_GT(exporter.without_cones(), 0);
  EXPECT_EQ(exporter.written() + exporter.without_cones(), 10);
  EXPECT_EQ(count(), static_cast<std::size_t>(exporter.written()));
}

TEST_F(Export, UnwritableFolderIsAnOutputError) {
  fs::create_directories(folder_);
  EXPECT_THROW(mpm::Exporter("/dev/null/folder", {}, cohesive(2)), problems::OutputError);
}

}  // namespace
}  // namespace conebench::test
