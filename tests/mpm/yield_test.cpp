// One cell of sand with a uniform strain rate: the step has a closed form. With grains of density
// rho, a solid volume V and the stress lambda (compression > 0, per solid volume: the bulk carries
// phi lambda), node k at a corner of the cell of length l has the mass rho V / 2^d, feels
// V grad N_k lambda with grad N_k = (+-1) 2 / (2^d l) in the mean, and is at (+-1) l / 2 of the
// centre. So the strain rate changes by A lambda, A = 4 h / (rho l^2), in two and three dimensions,
// and the cell is one material point: D = D0 + A lambda with lambda and D by the law.

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "tests/engine/small_solver.h"
#include "tests/mpm/engine_helper.h"

namespace conebench::test {
namespace {

using Eigen::Vector3d;

template <int D>
using Tensor = Eigen::Matrix<double, D, D>;

template <int D>
Tensor<D> deviator(const Tensor<D>& a) {
  return a - a.trace() / D * Tensor<D>::Identity();
}

struct Strength {
  double mu = 0.0, cohesion_Pa = 0.0;
};
constexpr std::array kStrengths = {Strength{0.4, 0.0}, Strength{0.4, 700.0}, Strength{0.9, 3e3},
                                   Strength{0.05, 20.0}};

// What the step makes of the strain rate D0: stress [Pa] of every node and in the mean, and where
// the nodes slide or open.
template <int D>
struct Answer {
  std::vector<Tensor<D>> stress;  // of the nodes
  std::vector<Tensor<D>> rate;    // integrated strain rate of the nodes
  Tensor<D> mean = Tensor<D>::Zero();
  double unit = 0.0;  // 1 / A: stress of a strain rate of 1 / s
};

constexpr double kStep = 1e-3;

template <int D>
Answer<D> strain_cell(const Strength& strength, const Tensor<D>& rate,
                      const engine::StepSolver& solver) {
  mpm::Scene scene = open_scene(std::vector<int>(D, 1));
  scene.gravity_m_s2.setZero();
  scene.material.friction = strength.mu;
  scene.material.cohesion_Pa = strength.cohesion_Pa;
  add_block(scene, Vector3d::Zero(), Vector3d::Ones());
  mpm::Particles particles = particles_of(scene);
  for (std::size_t p = 0; p < particles.count(); ++p) {
    const Vector3d from_centre = particles.position[p] - 0.5 * scene.grid.size_m;
    particles.velocity[p].head<D>() = rate * from_centre.head<D>();
    particles.affine[p].topLeftCorner<D, D>() = rate;
  }
  Posed posed = pose(scene, particles, kStep);
  const auto law = mpm::make_law(mpm::Law::kMonotone);
  const mpm::LawInput input = posed.assembly.law;
  const problems::Problem base = mpm::make_problem(scene, 0, kStep, posed.assembly);
  const problems::Problem problem = mpm::with_states(base, *law, input, law->classify(input));
  const problems::Problem standard = problem.shifted();
  const auto answer = solver(standard, Eigen::VectorXd::Zero(standard.rows()));

  const Eigen::VectorXd r = answer.r - problem.tip_shift(), u = standard.rate(answer.r);
  Answer<D> out;
  out.unit = 1500.0 * 0.01 / (4.0 * kStep);
  for (int i = 0; i < problem.cone_count(); ++i) {
    const mpm::Sym<D> s = r.segment<mpm::kEntries<D>>(problem.start(i)) / kStep;
    const mpm::Sym<D> e = u.segment<mpm::kEntries<D>>(problem.start(i)) / 2.0;
    out.stress.push_back(mpm::to_tensor<D>(s));
    out.rate.push_back(mpm::to_tensor<D>(e));
    out.mean += out.stress.back() / (1 << D);
  }
  return out;
}

// The law of one material point, D = D0 + lambda / unit.
template <int D>
Tensor<D> known_stress(const Strength& strength, const Tensor<D>& rate, double unit) {
  const Tensor<D> I = Tensor<D>::Identity();
  const double p = -unit * rate.trace() / D;
  const double tip = strength.cohesion_Pa / strength.mu;
  if (p <= -tip) return -tip * I;
  const Tensor<D> stick = -unit * deviator<D>(rate);
  const double root_J2 = stick.norm() / std::sqrt(2.0);
  const double allowed = strength.mu * p + strength.cohesion_Pa;
  return p * I + std::min(1.0, allowed / root_J2) * stick;
}

// Directions of strain: uniaxial, biaxial or triaxial with and against pressure, shears.
template <int D>
std::vector<Tensor<D>> directions() {
  std::vector<Tensor<D>> out;
  Tensor<D> uniaxial = Tensor<D>::Zero(), triaxial = Tensor<D>::Identity();
  uniaxial(0, 0) = 1.0;
  triaxial(D - 1, D - 1) = -0.7;
  Tensor<D> shear = Tensor<D>::Zero();
  shear(0, D - 1) = shear(D - 1, 0) = 1.0;
  Tensor<D> oblique = Tensor<D>::Zero();
  for (int i = 0; i < D; ++i) {
    for (int j = 0; j <= i; ++j) oblique(i, j) = oblique(j, i) = std::cos(1.0 + 2.0 * i + 3.0 * j);
  }
  for (const Tensor<D>& a : {uniaxial, triaxial, shear, oblique}) {
    out.push_back(a);
    out.emplace_back(-a);
  }
  return out;
}

template <class Dimension>
class Yield : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(Yield, Dimensions);

// Bound of the tests below, met or not, whatever the solver says of its end: the solver's 1e-12 of
// the largest rate, times 100 for the condition of W, of the stress that stops the strain at once.
constexpr double kExact = 1e-10;

TYPED_TEST(Yield, SlidingNodesAreOnTheYieldSurfaceAndNoneIsBeyondIt) {
  constexpr int D = TypeParam::value;
  int sliding = 0, sticking = 0;
  for (const Strength& strength : kStrengths) {
    for (const Tensor<D>& direction : directions<D>()) {
      // From pure shear to mostly compression; 0.5 / s stops at about 2 kPa.
      for (const double compression : {0.0, 0.2, 1.0, 5.0}) {
        const Tensor<D> rate = 0.5 * (direction - compression * Tensor<D>::Identity());
        const auto answer = strain_cell<D>(strength, rate, step_solver("gs", 1e-12));
        const double scale = answer.unit * rate.norm() + strength.cohesion_Pa / strength.mu;
        for (std::size_t i = 0; i < answer.stress.size(); ++i) {
          const double p = answer.stress[i].trace() / D;
          const double root_J2 = deviator<D>(answer.stress[i]).norm() / std::sqrt(2.0);
          const double excess = root_J2 - strength.mu * p - strength.cohesion_Pa;
          EXPECT_LT(excess, kExact * scale);
          // The integral of the strain rate over the node's part of the cell, if it is > 1e-6 of
          // what it was: the node slides.
          const double volume = 0.6 * std::pow(0.1, D) / (1 << D);
          if (deviator<D>(answer.rate[i]).norm() < 1e-6 * volume * rate.norm()) {
            ++sticking;
            continue;
          }
          ++sliding;
          EXPECT_NEAR(excess, 0.0, kExact * scale);
        }
      }
    }
  }
  EXPECT_GT(sliding, 100);
  EXPECT_GT(sticking, 20);
}

// The stress is unique in the mean only: opposite changes at neighbouring nodes do no work.
TYPED_TEST(Yield, MeanStressIsThatOfTheMaterialPoint) {
  constexpr int D = TypeParam::value;
  for (const Strength& strength : kStrengths) {
    for (const Tensor<D>& direction : directions<D>()) {
      for (const double compression : {-3.0, 0.0, 0.2, 1.0, 5.0}) {
        const Tensor<D> rate = 0.5 * (direction - compression * Tensor<D>::Identity());
        for (const auto& solver : {step_solver("gs", 1e-12), small_solver(1e-12)}) {
          const auto answer = strain_cell<D>(strength, rate, solver);
          const Tensor<D> expected = known_stress<D>(strength, rate, answer.unit);
          const double scale = answer.unit * rate.norm() + strength.cohesion_Pa / strength.mu;
          EXPECT_LT((answer.mean - expected).norm(), kExact * scale)
              << "mu " << strength.mu << ", c " << strength.cohesion_Pa << ", rate\n"
              << rate << "\nfound\n"
              << answer.mean << "\nexpected\n"
              << expected;
        }
      }
    }
  }
}

TYPED_TEST(Yield, HydrostaticTensionStopsAtCOverMu) {
  constexpr int D = TypeParam::value;
  for (const Strength& strength : kStrengths) {
    // Opening at 10 / s would take 37.5 kPa to stop.
    const Tensor<D> rate = 10.0 * Tensor<D>::Identity();
    const auto answer = strain_cell<D>(strength, rate, step_solver("gs", 1e-12));
    const double tip = strength.cohesion_Pa / strength.mu;
    ASSERT_GT(answer.unit * 10.0, tip);
    for (const Tensor<D>& stress : answer.stress) {
      EXPECT_LT((stress + tip * Tensor<D>::Identity()).norm(), 1e-12 * answer.unit * 10.0);
    }
  }
}

TYPED_TEST(Yield, CohesionHoldsATensionBelowCOverMu) {
  constexpr int D = TypeParam::value;
  const Strength strength{0.4, 900.0};  // tip at 2250 Pa
  const Tensor<D> rate = 0.5 * Tensor<D>::Identity();
  const auto answer = strain_cell<D>(strength, rate, step_solver("gs", 1e-12));
  const double tension = answer.unit * 0.5;
  ASSERT_LT(tension, 2250.0);
  EXPECT_LT((answer.mean + tension * Tensor<D>::Identity()).norm(), kExact * 2250.0);
  for (const Tensor<D>& e : answer.rate) EXPECT_LT(e.norm(), 1e-12 * std::pow(0.1, D));
}

// Strain at sliding keeps the volume: no dilatancy.
TYPED_TEST(Yield, SlidingKeepsTheVolume) {
  constexpr int D = TypeParam::value;
  for (const Tensor<D>& direction : directions<D>()) {
    const Tensor<D> rate = 0.5 * (direction - Tensor<D>::Identity() * 1.5);
    const auto answer = strain_cell<D>({0.05, 0.0}, rate, step_solver("gs", 1e-12));
    double most = 0.0;
    for (const Tensor<D>& e : answer.rate) {
      EXPECT_LT(std::abs(e.trace()), 1e-11 * std::pow(0.1, D));
      most = std::max(most, e.norm());
    }
    EXPECT_GT(most, 1e-3 * std::pow(0.1, D)) << "nothing slides";
  }
}

// Without friction the stress is a pressure: one component a node, and no shear strength.
TYPED_TEST(Yield, WithoutFrictionThereIsOnlyPressure) {
  constexpr int D = TypeParam::value;
  mpm::Scene scene = open_scene(std::vector<int>(D, 1));
  scene.material.friction = 0.0;
  add_block(scene, Vector3d::Zero(), Vector3d::Ones());
  const Posed posed = pose(scene, particles_of(scene), kStep);
  EXPECT_EQ(posed.assembly.data.H.rows(), 1 << D);
  for (const problems::Cone& cone : posed.assembly.cones) EXPECT_EQ(cone.dim, 1);
}

}  // namespace
}  // namespace conebench::test
