// Sand in flight keeps its momentum, and falls at g.

#include <gtest/gtest.h>

#include "tests/mpm/engine_helper.h"

namespace conebench::test {
namespace {

using Eigen::Vector3d;
using mpm::Scene;
using mpm::Simulation;

TEST(Flight, KeepsMomentumAndFallsAtG) {
  for (const int dim : {2, 3}) {
    const Scene scene = thrown(dim);
    Simulation simulation(scene, step_solver("auto", 1e-6));
    const double mass = mass_of(simulation);
    const Vector3d start = momentum_of(simulation);
    for (int k = 0; k < 40; ++k) {
      simulation.step();
      const Vector3d expected = start + mass * simulation.time_s() * scene.gravity_m_s2;
      // Rounding of some hundred particles and 40 steps, at 1 m/s.
      EXPECT_LT((momentum_of(simulation) - expected).norm(), 1e-13 * mass) << dim << "D";
    }
    const Vector3d v = scene.blocks[0].velocity_m_s + simulation.time_s() * scene.gravity_m_s2;
    for (const Vector3d& of_particle : simulation.particles().velocity) {
      EXPECT_LT((of_particle - v).norm(), 1e-5) << "no stress may act on a block in flight";
    }
  }
}

TEST(Flight, IsTheSameForParticlesOnFacesOfCells) {
  Scene scene = open_scene({8, 8});
  mpm::Block& block = add_block(scene, {2.5, 2.5, 0.0}, {4.5, 4.5, 0.0});
  block.particles_per_cell = 1;
  block.velocity_m_s = {0.7, 0.4, 0.0};
  Simulation simulation(scene, step_solver("auto", 1e-8));
  const double mass = mass_of(simulation);
  const Vector3d start = momentum_of(simulation);
  simulation.step();
  const Vector3d expected = start + mass * simulation.time_s() * scene.gravity_m_s2;
  EXPECT_LT((momentum_of(simulation) - expected).norm(), 1e-13 * mass);
}

TEST(Flight, BlocksThatCollideKeepTheirMomentum) {
  for (const int dim : {2, 3}) {
    Scene scene = thrown(dim);
    scene.gravity_m_s2.setZero();
    mpm::Block& other = add_block(scene, Vector3d::Constant(4.8), Vector3d::Constant(6.1));
    other.velocity_m_s = flat(dim, {-3.0, -1.0, -2.0});
    // Momentum is kept whatever the solver's accuracy: r acts on two sides.
    Simulation simulation(scene, step_solver("gs", 1e-2));
    const double mass = mass_of(simulation);
    const Vector3d start = momentum_of(simulation);
    const double kinetic = simulation.state().kinetic_J;
    run(simulation, 30);
    EXPECT_LT((momentum_of(simulation) - start).norm(), 1e-12 * mass);
    EXPECT_LT(simulation.state().kinetic_J, 0.9 * kinetic) << "they did not collide";
  }
}

}  // namespace
}  // namespace conebench::test
