// Problems without units are the same whatever the units were.

#include "solvers/dimensionless.h"

#include <gtest/gtest.h>

#include "problems/made_backwards.h"

namespace conebench::solvers {
namespace {

using problems::Problem;
using problems::SparseMatrix;

// Powers of two, so that nothing is rounded; an even one between them, so that roots are exact too.
constexpr double kForce = 0x1p20, kRate = 0x1p10;

Problem made(bool reduced) {
  return problems::make_backwards(
             {.cones = 12, .dims = {3, 1, 6, 2}, .reduced = reduced, .seed = 21})
      .problem;
}

Problem in_other_units(const Problem& problem) {
  std::vector<problems::Cone> cones(problem.cones().begin(), problem.cones().end());
  if (!problem.is_primal()) {
    return Problem(problems::ReducedData{problem.W() * (kRate / kForce), kRate * problem.q()},
                   std::move(cones), {});
  }
  return Problem(problems::PrimalData{problem.M() * (kForce / kRate), problem.H(),
                                      kForce * problem.f(), kRate * problem.w()},
                 std::move(cones), {});
}

void expect_same(const SparseMatrix& A, const SparseMatrix& B) {
  EXPECT_EQ(Eigen::MatrixXd(A), Eigen::MatrixXd(B));
}

TEST(DimensionlessTest, IsTheSameBitForBitInUnitsThatArePowersOfTwo) {
  for (const bool reduced : {false, true}) {
    const Problem problem = made(reduced);
    const Dimensionless here(problem), there(in_other_units(problem));
    EXPECT_EQ(here.force * kForce, there.force);
    EXPECT_EQ(here.rate * kRate, there.rate);
    EXPECT_EQ(here.energy * kForce * kRate, there.energy);
    expect_same(here.W, there.W);
    EXPECT_EQ(here.q, there.q);
    EXPECT_EQ(here.velocity * kRate, there.velocity);
    expect_same(here.M, there.M);
    expect_same(here.H, there.H);
    EXPECT_EQ(here.f, there.f);
    EXPECT_EQ(here.w, there.w);
  }
}

// u = W r + q and v = M^-1 (f + H^T r), written without units.
TEST(DimensionlessTest, KeepsTheProblem) {
  for (const bool reduced : {false, true}) {
    const Problem problem = made(reduced);
    const Dimensionless scaled(problem);
    const Eigen::VectorXd r = Eigen::VectorXd::LinSpaced(problem.rows(), -1.0, 2.0);
    const Eigen::VectorXd without = r.cwiseQuotient(scaled.force);
    const Eigen::VectorXd u = problem.rate(r).cwiseQuotient(scaled.rate);
    if (reduced) {
      EXPECT_LE((scaled.W * without + scaled.q - u).norm(), 1e-12 * u.norm());
      continue;
    }
    const Eigen::VectorXd v = problem.velocity(r).cwiseQuotient(scaled.velocity);
    EXPECT_LE((scaled.H * v + scaled.w - u).norm(), 1e-12 * u.norm());
    const Eigen::VectorXd momentum = scaled.f + scaled.H.transpose() * without;
    EXPECT_LE((scaled.M * v - momentum).norm(), 1e-12 * momentum.norm());
  }
}

}  // namespace
}  // namespace conebench::solvers
