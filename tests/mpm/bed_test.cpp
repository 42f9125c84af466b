// Beds of sand at rest.

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/mpm/engine_helper.h"

namespace conebench::test {
namespace {

using Eigen::Vector3d;
using mpm::Scene;
using mpm::Simulation;

TEST(Bed, OnTheGridStaysAtRest) {
  Scene scene = box_scene({8, 6});
  scene.step_s = 4e-3;
  add_block(scene, Vector3d::Zero(), {8.0, 4.0, 0.0});
  Simulation simulation(scene, step_solver("auto", 1e-10));
  double fastest = 0.0;
  for (int k = 0; k < 1000; ++k) {
    simulation.step();
    fastest = std::max(fastest, simulation.state().fastest_m_s);
  }
  EXPECT_EQ(simulation.summary().unconverged_steps, 0);
  EXPECT_LE(fastest, 1e-8 * std::sqrt(kGravity * 0.4));
}

// Runs the first step of a bed that fills `depth` cells of spacing 0.8 m / depth in a shaft two
// cells wide, and shows it to `look`.
void first_step_of_a_bed(double depth, double friction, const mpm::Observer& look) {
  const double spacing = 0.8 / depth;
  const int layers = static_cast<int>(depth) + 2;
  Scene scene = box_scene({2, layers});
  scene.grid.size_m = {2.0 * spacing, layers * spacing, 0.0};
  scene.material.friction = friction;
  scene.step_s = 1e-4;
  mpm::Block& block = add_block(scene, Vector3d::Zero(), {2.0, depth, 0.0});
  block.particles_per_cell = 4;
  Simulation simulation(scene, step_solver("auto", 1e-9));
  simulation.add_observer(look);
  simulation.step();
}

// Largest error of the pressure at the nodes, as a share of that at the foot. Without friction, so
// that it is unique. The grains carry rho g depth (the bulk phi times as much).
double pressure_error(double depth) {
  double worst = 0.0;
  first_step_of_a_bed(depth, 0.0, [&](const mpm::StepView& view) {
    for (int i = 0; i < view.nodes->count(); ++i) {
      const int node = view.nodes->index[static_cast<std::size_t>(i)];
      const double below = std::max(0.0, 0.8 - view.scene->grid.position(node).y());
      const double p = view.answer->r[view.problem->start(i)] / view.h;
      worst = std::max(worst, std::abs(p - 1500.0 * kGravity * below));
    }
  });
  return worst / (1500.0 * kGravity * 0.8);
}

TEST(Bed, PressureIsHydrostaticWhereItEndsOnTheGrid) {
  // eta of 1e-9 is of the rate of free fall; W's condition grows as depth^2.
  for (const double depth : {4.0, 8.0, 16.0}) EXPECT_LT(pressure_error(depth), 1e-6);
}

TEST(Bed, PressureIsHydrostaticToFirstOrderWhereItEndsBetweenNodes) {
  const std::array<double, 3> errors = {pressure_error(4.5), pressure_error(8.5),
                                        pressure_error(16.5)};
  EXPECT_GT(std::log(errors[0] / errors[1]) / std::log(8.5 / 4.5), 0.9);
  EXPECT_GT(std::log(errors[1] / errors[2]) / std::log(16.5 / 8.5), 0.9);
}

// With friction the stress is not unique, but each layer carries what is above it: its vertical
// stress has the mean of the hydrostatic one.
TEST(Bed, LayersOfSandCarryTheWeightAbove) {
  first_step_of_a_bed(6.0, 0.4, [](const mpm::StepView& view) {
    std::vector<double> vertical(7, 0.0);
    for (int i = 0; i < view.nodes->count(); ++i) {
      const auto at = view.scene->grid.place(view.nodes->index[static_cast<std::size_t>(i)]);
      const Eigen::Vector3d r = view.answer->r.segment<3>(view.problem->start(i));
      const double share = at.x() == 1 ? 0.5 : 0.25;
      vertical[static_cast<std::size_t>(at.y())] += share * mpm::to_tensor<2>(r)(1, 1) / view.h;
    }
    const double foot = 1500.0 * kGravity * 0.8;
    for (std::size_t layer = 0; layer < 7; ++layer) {
      EXPECT_NEAR(vertical[layer] / foot, 1.0 - static_cast<double>(layer) / 6.0, 1e-6);
    }
  });
}

// Kinetic energy with the affine part, that of the grid's velocities at the particle, and
// potential.
double energy_of(const Simulation& simulation) {
  const Scene& scene = simulation.scene();
  const auto& particles = simulation.particles();
  double energy = 0.0;
  for (std::size_t p = 0; p < particles.count(); ++p) {
    const double m = scene.material.density_kg_m3 * particles.volume[p];
    energy += m * (0.5 * particles.velocity[p].squaredNorm() -
                   scene.gravity_m_s2.dot(particles.position[p]));
    for (int a = 0; a < scene.grid.dim; ++a) {
      const double l = scene.grid.spacing(a);
      const double place = (particles.position[p][a] - scene.grid.low_m[a]) / l;
      const double s = place - std::floor(place);
      energy += 0.5 * m * s * (1.0 - s) * l * l * particles.affine[p].col(a).squaredNorm();
    }
  }
  return energy;
}

TEST(Bed, OffTheGridSettlesWithoutGainingEnergy) {
  Scene scene = box_scene({6, 6});
  mpm::Block& block = add_block(scene, {0.0, 0.4, 0.0}, {6.0, 3.37, 0.0});
  block.jitter = 0.8;
  block.fraction = 0.57;
  Simulation simulation(scene, step_solver("auto", 1e-7));
  const double start = energy_of(simulation);
  double last = start, last_plain = simulation.state().kinetic_J + simulation.state().potential_J;
  for (int k = 0; k < 400; ++k) {
    simulation.step();
    const double energy = energy_of(simulation);
    const double plain = simulation.state().kinetic_J + simulation.state().potential_J;
    // Rounding of 72 particles' energies.
    EXPECT_LE(energy, last + 1e-12 * std::abs(start)) << "step " << k;
    EXPECT_LE(plain, last_plain + 1e-12 * std::abs(start)) << "step " << k;
    last = energy;
    last_plain = plain;
  }
  EXPECT_LT(last, start - 0.05 * mass_of(simulation) * kGravity * 0.3) << "it did not fall";
  EXPECT_LT(simulation.state().kinetic_J, 1e-3 * (start - last));
}

}  // namespace
}  // namespace conebench::test
