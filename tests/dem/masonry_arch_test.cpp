// Couplet's problem: how thin, and how smooth, may a semicircular arch of dry stones be? Rigid
// stones can stand only if some line of thrust stays inside all joints and within the angle of
// friction there (Heyman, Int. J. Solids Struct. 2 (1966) 249-279; not checked). That is a problem
// in two unknowns, solved here without the engine.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <vector>

#include "dem/simulation.h"
#include "harness/step_solver.h"

namespace conebench::test {
namespace {

constexpr double kPi = std::numbers::pi;

// A semicircle of mean radius 1 about the origin, of wedges between flat joints of depth t, as the
// generator makes them.
struct Semicircle {
  int stones;
  double thickness;

  double angle() const { return kPi / stones; }
  // A wedge's weight, as an area, and how far its centroid is from the origin: that of the triangle
  // to the extrados less that to the intrados.
  double area() const { return std::sin(angle()) * thickness; }
  double centroid() const {
    const double outer = 1.0 + 0.5 * thickness, inner = 1.0 - 0.5 * thickness;
    return 2.0 / 3.0 * std::cos(0.5 * angle()) * (std::pow(outer, 3) - std::pow(inner, 3)) /
           (2.0 * thickness);
  }
};

struct Interval {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
};

// Calls look(V, from_crown) at each joint, from the left springing on: V is the vertical force that
// passes it, half of the weight at first as all is symmetric, and from_crown its angle.
void for_each_joint(const Semicircle& arch, const std::function<void(double, double)>& look) {
  for (int j = 0; j <= arch.stones; ++j) {
    look((0.5 * arch.stones - j) * arch.area(), 0.5 * kPi - j * arch.angle());
  }
}

// The horizontal thrusts H that no joint slides under: |V cos - H sin| <= mu (V sin + H cos). By
// symmetry the left half will do, where sin >= 0.
Interval held_by_friction(const Semicircle& arch, double mu) {
  Interval H;
  for_each_joint(arch, [&](double V, double from_crown) {
    const double s = std::sin(from_crown), c = std::cos(from_crown);
    if (s <= 0.0) return;
    H.low = std::max(H.low, V * (c - mu * s) / (s + mu * c));
    if (s > mu * c) H.high = std::min(H.high, V * (c + mu * s) / (s - mu * c));
  });
  return H;
}

// With the left springer's force (H, V) and its moment M about the origin, what is left of a joint
// balances if the joint's force passes it at a distance rho from the origin with M + (moment of the
// weights) = -rho N, N the force normal to the joint. Where rho lies between intrados and extrados,
// M lies between two bounds. Returns how much room all joints leave to M; < 0: none.
double room_for(const Semicircle& arch, double H) {
  const double outer = 1.0 + 0.5 * arch.thickness, inner = 1.0 - 0.5 * arch.thickness;
  Interval M;
  double moment = 0.0;
  for_each_joint(arch, [&](double V, double from_crown) {
    const double N = V * std::sin(from_crown) + H * std::cos(from_crown);
    M.low = std::max(M.low, -moment - outer * N);
    M.high = std::min(M.high, -moment - inner * N);
    moment += arch.area() * arch.centroid() * std::sin(from_crown - 0.5 * arch.angle());
  });
  return M.high - M.low;
}

// M.low is a maximum and M.high a minimum of lines in H: the room is concave in H, so that
// trisection finds its maximum.
bool can_stand(const Semicircle& arch, double mu) {
  Interval H = held_by_friction(arch, mu);
  if (H.low > H.high) return false;
  for (int k = 0; k < 60; ++k) {
    const double third = (H.high - H.low) / 3.0;
    if (room_for(arch, H.low + third) < room_for(arch, H.high - third)) {
      H.low += third;
    } else {
      H.high -= third;
    }
  }
  return room_for(arch, H.low) >= 0.0;
}

// Between one where it is false and one where it is true.
double where_it_turns(double no, double yes, const std::function<bool(double)>& is) {
  while (std::abs(yes - no) > 1e-7) {
    const double middle = 0.5 * (no + yes);
    (is(middle) ? yes : no) = middle;
  }
  return yes;
}

constexpr double kRough = 0.7;  // more than any of these arches needs

double critical_thickness(int stones) {
  return where_it_turns(0.01, 0.5, [&](double t) { return can_stand({stones, t}, kRough); });
}

double critical_friction(const Semicircle& arch) {
  return where_it_turns(0.0, kRough, [&](double mu) { return can_stand(arch, mu); });
}

TEST(ThrustLine, OfManyStonesIsThatOfTheContinuousArch) {
  // Milankovitch 1907: 0.1075. Couplet's arch of that thickness needs friction of 0.395, a thick
  // one of 0.309 (Sinopoli, Corradi, Foce 1997). Quoted second hand.
  const double thickness = critical_thickness(400);
  EXPECT_NEAR(thickness, 0.1075, 5e-5);
  EXPECT_NEAR(critical_friction({400, thickness}), 0.395, 5e-4);
  EXPECT_NEAR(critical_friction({400, 0.3}), 0.309, 1e-3);
  EXPECT_GT(1.002 * critical_thickness(40), 0.1075);
  EXPECT_LT(0.998 * critical_thickness(40), 0.1075);
  // Hinges can be at joints alone: an arch of fewer stones may be thinner.
  for (const int stones : {8, 9, 25}) EXPECT_LT(critical_thickness(stones), thickness) << stones;
}

class MasonryArch : public testing::TestWithParam<int> {
 protected:
  static constexpr double kSunk = 0.02;  ///< of the radius of 1 m

  // Runs an arch until a stone has sunk by kSunk, or for 2 s.
  static dem::Simulation run(double thickness, double mu) {
    dem::Scene scene = dem::load_scene("masonry-arch");
    scene.arches[0].voussoirs = GetParam();
    scene.arches[0].thickness_m = thickness;
    scene.default_pair->friction = mu;
    dem::Simulation simulation(scene, harness::make_step_solver(scene.solver));
    const std::vector<Eigen::Vector3d> start = simulation.bodies().position;
    while (simulation.time_s() < 2.0 && sinking_m(simulation, start) < kSunk) simulation.step();
    EXPECT_EQ(simulation.summary().unconverged_steps, 0);
    return simulation;
  }

  static double sinking_m(const dem::Simulation& simulation,
                          const std::vector<Eigen::Vector3d>& start) {
    double most = 0.0;
    for (std::size_t i = 0; i < start.size(); ++i) {
      most = std::max(most, start[i].z() - simulation.bodies().position[i].z());
    }
    return most;
  }

  static void expect_falls(const dem::Simulation& simulation) {
    EXPECT_LT(simulation.time_s(), 2.0 - 1e-9);
    EXPECT_GT(dem::kinetic_energy(simulation.bodies()), 0.1);
  }
  static void expect_stands(const dem::Simulation& simulation) {
    EXPECT_GE(simulation.time_s(), 2.0 - 1e-9);
    // Some 200 kg, slower than 1e-8 m/s; the steps are solved to 1e-8 of g h = 1e-2 m/s.
    EXPECT_LT(dem::kinetic_energy(simulation.bodies()), 1e-14);
  }
};
// Of forty stones the limit is Couplet's but for 0.07 %: what stands and falls 0.2 % above and
// below it does so above and below 0.1075.
INSTANTIATE_TEST_SUITE_P(Stones, MasonryArch, testing::Values(8, 9, 25, 40));

TEST_P(MasonryArch, FallsJustBelowItsCriticalThicknessAndStandsJustAbove) {
  const double critical = critical_thickness(GetParam());
  expect_falls(run(0.998 * critical, kRough));
  expect_stands(run(1.002 * critical, kRough));
}

TEST_P(MasonryArch, SlidesJustBelowItsCriticalFrictionAndStandsJustAbove) {
  const double thickness = 0.15, critical = critical_friction({GetParam(), thickness});
  expect_falls(run(thickness, 0.99 * critical));
  expect_stands(run(thickness, 1.01 * critical));
}

}  // namespace
}  // namespace conebench::test
