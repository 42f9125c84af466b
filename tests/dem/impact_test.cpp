// Balls in a row, and a ball that bounces to rest: closed forms of Newton's law of restitution.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "dem/simulation.h"
#include "tests/dem/scene_helper.h"
#include "tests/engine/small_solver.h"

namespace conebench::test {
namespace {

using dem::Simulation;

constexpr double kGravity = 9.81;

// Balls of these radii along x with `gap_m` between neighbours; the first flies at 1 m/s towards
// the others, which are at rest. Radii and gap should be sums of few powers of 2, so that a gap of
// 0 is exactly 0.
Simulation row(const std::vector<double>& radii, double restitution, double gap_m) {
  dem::Scene scene = small_scene({.friction = 0.0, .restitution = restitution});
  scene.gravity_m_s2.setZero();
  double x = 0.0;
  for (std::size_t i = 0; i < radii.size(); ++i) {
    if (i > 0) x += radii[i - 1] + gap_m + radii[i];
    add_body(scene, {x, 0.0, 0.0}, radii[i]);
  }
  scene.bodies[0].velocity_m_s.x() = 1.0;
  return Simulation(scene, small_solver());
}

// The speed of each ball after it was hit for the first time.
std::vector<double> first_speeds(Simulation& simulation) {
  std::vector<double> speeds(simulation.bodies().velocity.size(), 0.0);
  while (speeds.back() == 0.0 && simulation.time_s() < 10.0) {
    simulation.step();
    for (std::size_t i = 0; i < speeds.size(); ++i) {
      if (speeds[i] == 0.0) speeds[i] = simulation.bodies().velocity[i].x();
    }
  }
  return speeds;
}

TEST(Row, SeparateImpactsMultiplyTheSpeedByTheMassesOfEachPair) {
  const std::vector<std::vector<double>> rows = {
      {0.03125, 0.03125, 0.03125, 0.03125, 0.03125},  // equal
      {0.0625, 0.046875, 0.03125, 0.015625},          // the last one is the fastest
      {0.015625, 0.03125, 0.0625}};                   // light ones bounce back
  for (const std::vector<double>& radii : rows) {
    for (const double e : {0.5, 0.8, 1.0}) {
      Simulation simulation = row(radii, e, 0.0078125);
      const std::vector<double> speeds = first_speeds(simulation);
      const std::vector<double>& mass = simulation.bodies().mass;
      double expected = 1.0;
      for (std::size_t k = 0; k + 1 < radii.size(); ++k) {
        // v_{k+1} = (1 + e) m_k / (m_k + m_{k+1}) v_k, from Newton's law and the momentum.
        expected *= (1.0 + e) * mass[k] / (mass[k] + mass[k + 1]);
        EXPECT_NEAR(speeds[k + 1], expected, 1e-12 * expected) << "ball " << k + 1 << ", e = " << e;
      }
    }
  }
}

TEST(Row, EqualElasticBallsApartAreNewtonsCradle) {
  Simulation simulation = row(std::vector<double>(5, 0.03125), 1.0, 0.0078125);
  simulation.run(100);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(simulation.bodies().velocity[i].x(), i == 4 ? 1.0 : 0.0, 1e-12) << "ball " << i;
  }
}

// Touching balls are not a cradle under Moreau's law, which knows one step and no waves. With
// z = (v + e v_minus) / (1 + e) its step, M (v - v_minus) = H^T r, 0 <= u + e u_minus and r >= 0
// complementary, says M (z - v_minus) = H^T r / (1 + e), 0 <= H z: z is the velocity of the same
// impact without restitution. There all go on together, at V = m_1 v_minus / sum m (each contact
// has to bring the balls behind it to V > 0, so none is open), hence
//
//   v = (1 + e) V - e v_minus:   (1 + e) V for those that were at rest.
TEST(Row, TouchingBallsShareTheImpactByMoreausLaw) {
  for (const std::vector<double>& radii :
       {std::vector<double>(5, 0.03125), {0.0625, 0.03125, 0.015625, 0.03125}}) {
    for (const double e : {0.0, 0.5, 1.0}) {
      Simulation simulation = row(radii, e, 0.0);
      simulation.run(20);
      const dem::Bodies& bodies = simulation.bodies();
      const double all = std::accumulate(bodies.mass.begin(), bodies.mass.end(), 0.0);
      const double together = (1.0 + e) * bodies.mass[0] / all;
      EXPECT_NEAR(bodies.velocity[0].x(), together - e, 1e-12) << "e = " << e;
      for (std::size_t i = 1; i < radii.size(); ++i) {
        EXPECT_NEAR(bodies.velocity[i].x(), together, 1e-12) << "ball " << i << ", e = " << e;
      }
    }
  }
}

// Whether elastic or not, the law loses (1 - e^2) of the energy that the impact without
// restitution loses, for any number of contacts at once: from v = (1 + e) z - e v_minus and
// (z - v_minus) . M z = 0.
TEST(Row, ImpactLosesItsShareOfEnergyHoweverManyTouch) {
  for (const double e : {0.0, 0.5, 1.0}) {
    Simulation simulation = row({0.0625, 0.03125, 0.015625, 0.03125}, e, 0.0);
    simulation.run(20);
    const std::vector<double>& mass = simulation.bodies().mass;
    const double all = std::accumulate(mass.begin(), mass.end(), 0.0);
    const double before = 0.5 * mass[0], lost = before * (1.0 - mass[0] / all);
    const dem::EnergyLedger& energy = simulation.energy();
    EXPECT_NEAR(energy.kinetic_J, before - (1.0 - e * e) * lost, 1e-12 * before);
    EXPECT_NEAR(energy.impact_J, -(1.0 - e * e) * lost, 1e-12 * before);
  }
}

// A bouncing ball's apexes above the floor, and the times at which it was thrown back.
struct Bounces {
  std::vector<double> apexes_m, impacts_s;
};

Bounces bounce(double height_m, double restitution, double step_s, std::size_t count) {
  dem::Scene scene = small_scene({.friction = 0.3, .restitution = restitution});
  scene.step_s = step_s;
  add_floor(scene);
  add_body(scene, {0.0, 0.0, 0.05 + height_m}, 0.05);
  Simulation simulation(scene, small_solver());
  Bounces bounces;
  double highest = height_m;
  while (bounces.impacts_s.size() < count) {
    const double before = simulation.bodies().velocity[0].z();
    simulation.step();
    highest = std::max(highest, simulation.bodies().position[0].z() - 0.05);
    if (simulation.bodies().velocity[0].z() <= std::max(before, 0.0)) continue;
    bounces.apexes_m.push_back(highest);
    bounces.impacts_s.push_back(simulation.time_s());
    highest = 0.0;
  }
  return bounces;
}

// In flight the scheme is on the exact parabola of velocity v - g h / 2. An impact, though, comes
// up to half a step early or late: |gap| <= h w / 2 where w is the speed, to first order in h. So
// |H' - e^2 H| <= (1 - e^2) |gap| + (1 + e) e w h / 2 <= (1 + e) w h / 2.
TEST(BouncingBall, RisesToTheSquareOfRestitution) {
  for (const double e : {0.5, 0.8}) {
    for (const double step_s : {1e-3, 1e-4}) {
      const std::vector<double> apexes = bounce(0.2, e, step_s, 5).apexes_m;
      for (std::size_t k = 0; k + 1 < apexes.size(); ++k) {
        const double bound = 0.5 * (1.0 + e) * step_s * std::sqrt(2.0 * kGravity * apexes[k]);
        // What is left out is of second order: of g h^2.
        EXPECT_NEAR(apexes[k + 1], e * e * apexes[k], bound + kGravity * step_s * step_s)
            << "bounce " << k << ", e = " << e << ", step " << step_s << " s";
      }
    }
  }
}

// The n-th impact is at (1 + 2 e + ... + 2 e^(n-1)) fall times, which ends at (1 + e) / (1 - e) of
// them: the ball bounces without end in finite time, and then rests. By the bound above each
// rebound speed adds an error of at most c g h, c = (1 + 2 e) / 2 + 1 / (2 e), to e times the last
// one: c g h / (1 - e) at any time, hence 2 c h / (1 - e) + h for the time of each flight.
TEST(BouncingBall, EndsItsBouncesInTheKnownTime) {
  const double height = 0.2, e = 0.5, fall = std::sqrt(2.0 * height / kGravity);
  for (const double step_s : {1e-3, 1e-4, 1e-5}) {
    const std::size_t count = 5;
    const double found = bounce(height, e, step_s, count).impacts_s.back();
    const double powers = (e - std::pow(e, static_cast<double>(count))) / (1.0 - e);
    const double c = 0.5 * (1.0 + 2.0 * e) + 0.5 / e;
    EXPECT_NEAR(found, fall * (1.0 + 2.0 * powers),
                static_cast<double>(count) * (2.0 * c / (1.0 - e) + 1.0) * step_s)
        << "step " << step_s << " s";
  }
}

TEST(BouncingBall, RestsAfterTheSumOfAllItsBounces) {
  const double height = 0.2, e = 0.5, fall = std::sqrt(2.0 * height / kGravity);
  dem::Scene scene = small_scene({.friction = 0.3, .restitution = e});
  scene.step_s = 1e-4;
  add_floor(scene);
  add_body(scene, {0.0, 0.0, 0.05 + height}, 0.05);
  Simulation simulation(scene, small_solver());
  double last_moved_s = 0.0;
  while (simulation.time_s() < 1.0) {
    simulation.step();
    // Gravity alone brings a speed of g h in each step; ten times that is motion.
    const double speed = simulation.bodies().velocity[0].norm();
    if (speed > 10.0 * kGravity * scene.step_s) last_moved_s = simulation.time_s();
  }
  // Flights of less than 20 h each are not seen, in all 20 h / (1 - e) = 40 h; the eight that are
  // seen last as above to 9 h each.
  EXPECT_NEAR(last_moved_s, fall * (1.0 + e) / (1.0 - e), 112.0 * scene.step_s);
  EXPECT_LT(simulation.bodies().velocity[0].norm(), 2.0 * kGravity * scene.step_s);
  EXPECT_NEAR(simulation.bodies().position[0].z(), 0.05,
              2.0 * kGravity * scene.step_s * scene.step_s);
}

}  // namespace
}  // namespace conebench::test
