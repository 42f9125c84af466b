#include "tests/mpm/engine_helper.h"

#include <stdexcept>

#include "mpm/placement.h"
#include "solvers/registry.h"

namespace conebench::test {

engine::StepSolver step_solver(const std::string& variant, double tol) {
  const solvers::Stop stop{.tol = tol, .max_iterations = 100'000};
  return [solver = solvers::make_solver(variant), stop](const problems::Problem& standard,
                                                        const Eigen::VectorXd& guess) {
    if (const auto reason = solver.refuses(standard)) throw std::logic_error(*reason);
    const solvers::Result result = solver.solve(standard, {.stop = stop, .guess = guess});
    return engine::StepAnswer{result.r, result.status == solvers::Status::kConverged,
                              std::string(solvers::to_string(result.status)), result.iterations,
                              result.solve_s};
  };
}

std::string dimension_name(const testing::TestParamInfo<int>& dimension) {
  return std::to_string(dimension.param) + "D";
}

mpm::Scene open_scene(const std::vector<int>& cells) {
  mpm::Scene scene;
  scene.name = "small";
  scene.step_s = 2e-3;
  scene.duration_s = 1.0;
  scene.grid.dim = static_cast<int>(cells.size());
  for (int a = 0; a < scene.grid.dim; ++a) {
    scene.grid.cells[a] = cells[static_cast<std::size_t>(a)];
    scene.grid.size_m[a] = 0.1 * scene.grid.cells[a];
  }
  scene.gravity_m_s2 = -kGravity * Eigen::Vector3d::Unit(scene.grid.dim - 1);
  scene.material.density_kg_m3 = 1500.0;
  scene.material.phi_max = 0.6;
  scene.material.friction = 0.4;
  for (mpm::Wall& wall : scene.walls) wall.condition = mpm::Condition::kFree;
  return scene;
}

mpm::Scene box_scene(const std::vector<int>& cells) {
  mpm::Scene scene = open_scene(cells);
  for (mpm::Wall& wall : scene.walls) wall.condition = mpm::Condition::kSlip;
  scene.walls[2 * cells.size() - 2].condition = mpm::Condition::kStick;
  return scene;
}

mpm::Block& add_block(mpm::Scene& scene, const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  mpm::Block block;
  for (int a = 0; a < scene.grid.dim; ++a) {
    block.low_m[a] = scene.grid.low_m[a] + low[a] * scene.grid.spacing(a);
    block.high_m[a] = scene.grid.low_m[a] + high[a] * scene.grid.spacing(a);
  }
  block.fraction = scene.material.phi_max;
  scene.blocks.push_back(block);
  return scene.blocks.back();
}

mpm::Scene thrown(int dim) {
  mpm::Scene scene = open_scene(dim == 2 ? std::vector{10, 10} : std::vector{7, 7, 7});
  mpm::Block& block =
      add_block(scene, Eigen::Vector3d::Constant(2.3), Eigen::Vector3d::Constant(4.6));
  block.velocity_m_s = flat(dim, {0.7, 0.4, 1.1});
  block.jitter = 0.5;
  return scene;
}

Eigen::Vector3d flat(int dim, Eigen::Vector3d x) {
  if (dim == 2) x.z() = 0.0;
  return x;
}

Posed pose(const mpm::Scene& scene, const mpm::Particles& particles, double h,
           const std::vector<mpm::RigidBody>& bodies, double time_s) {
  Posed posed;
  mpm::scatter(scene, particles, posed.nodes);
  mpm::cover(scene, bodies, time_s, posed.nodes);
  posed.assembly = mpm::assemble(scene, particles, posed.nodes, bodies, time_s, h);
  return posed;
}

mpm::Particles particles_of(const mpm::Scene& scene) { return mpm::place_particles(scene, {}); }

double mass_of(const mpm::Simulation& simulation) {
  double mass = 0.0;
  for (const double volume : simulation.particles().volume) {
    mass += simulation.scene().material.density_kg_m3 * volume;
  }
  for (const mpm::RigidBody& body : simulation.bodies()) mass += body.mass;
  return mass;
}

Eigen::Vector3d momentum_of(const mpm::Simulation& simulation) {
  Eigen::Vector3d momentum = simulation.state().momentum;
  for (const mpm::RigidBody& body : simulation.bodies()) momentum += body.mass * body.velocity;
  return momentum;
}

void run(mpm::Simulation& simulation, int count) {
  for (int k = 0; k < count; ++k) simulation.step();
}

}  // namespace conebench::test
