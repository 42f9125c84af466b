// Blocks of H F: what spheres allow to leave out, and what is a sphere.

#include "solvers/blocked_rows.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <random>

#include "solvers/delassus_product.h"
#include "solvers/gs_coupling.h"

namespace conebench::solvers {
namespace {

using problems::Cone;
using problems::PrimalData;
using problems::Problem;
using problems::SparseMatrix;

// What spoils the structure, and by how much.
struct Flaw {
  double arm = 0.0;      // of one contact, off the normal [m]
  double inertia = 0.0;  // of one body, about one axis [-]
};

// Spheres of many sizes touching in random directions, each the next one and every third the
// ground: rows of H from the velocity of a body at a point, v + omega x (p - x).
Problem spheres(int bodies, Flaw flaw) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0.3, 2.0);
  std::normal_distribution<double> normal;
  std::vector<double> radius;
  std::vector<Eigen::Triplet<double, int>> H, M;
  for (int b = 0; b < bodies; ++b) {
    radius.push_back(uniform(random));
    const double mass = uniform(random), inertia = 0.4 * mass * radius.back() * radius.back();
    for (int k = 0; k < 6; ++k) M.emplace_back(6 * b + k, 6 * b + k, k < 3 ? mass : inertia);
  }
  M[6 * 4 + 5] = {6 * 4 + 5, 6 * 4 + 5, M[6 * 4 + 5].value() * (1.0 + flaw.inertia)};
  int row = 0;
  const auto add_body = [&](const Eigen::Matrix3d& frame, int body, const Eigen::Vector3d& arm,
                            double sign) {
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d direction = frame.row(k), turn = arm.cross(direction);
      for (int axis = 0; axis < 3; ++axis) {
        H.emplace_back(row + k, 6 * body + axis, sign * direction(axis));
        H.emplace_back(row + k, 6 * body + 3 + axis, sign * turn(axis));
      }
    }
  };
  for (int b = 0; b < bodies; ++b) {
    const Eigen::Vector3d n = Eigen::Vector3d(normal(random), normal(random), normal(random));
    Eigen::Matrix3d frame;
    frame.row(0) = n.normalized();
    frame.row(1) = frame.row(0).unitOrthogonal();
    frame.row(2) = frame.row(0).cross(frame.row(1));
    Eigen::Vector3d arm = -radius[static_cast<std::size_t>(b)] * frame.row(0);
    if (b == 7) arm += flaw.arm * frame.row(1).transpose();
    add_body(frame, b, arm, 1.0);
    if (b % 3 != 0) {
      const int other = (b + 1) % bodies;
      add_body(frame, other, radius[static_cast<std::size_t>(other)] * frame.row(0), -1.0);
    }
    row += 3;
  }
  SparseMatrix jacobian(row, 6 * bodies), mass(6 * bodies, 6 * bodies);
  jacobian.setFromTriplets(H.begin(), H.end());
  mass.setFromTriplets(M.begin(), M.end());
  return Problem(PrimalData{mass, jacobian, Eigen::VectorXd::LinSpaced(6 * bodies, -1.0, 1.0),
                            Eigen::VectorXd::LinSpaced(row, 0.2, -0.1)},
                 std::vector<Cone>(static_cast<std::size_t>(bodies), Cone::coulomb(3, 0.5)), {});
}

void expect_right_products(const Problem& problem) {
  const Eigen::VectorXd r = Eigen::VectorXd::LinSpaced(problem.rows(), -1.0, 2.0);
  Eigen::VectorXd u;
  DelassusProduct(problem).rate(r, u);
  const Eigen::VectorXd expected = problem.rate(r);
  EXPECT_LE((u - expected).norm(), 1e-14 * expected.norm());
  const BlockedRows rows(problem);
  const Eigen::MatrixXd W = problem.delassus();
  for (int i = 0; i < problem.cone_count(); ++i) {
    const Eigen::Matrix3d block = W.block<3, 3>(problem.start(i), problem.start(i));
    EXPECT_LE((rows.diagonal_block(i, 3) - block).norm(), 1e-14 * block.norm()) << i;
  }
}

TEST(BlockedRows, OfSpheresAreAThird) {
  const Problem problem = spheres(30, {});
  const BlockedRows rows(problem);
  EXPECT_TRUE(rows.of_spheres());
  EXPECT_EQ(rows.numbers(), 30 * 9 + 2 * (30 + 20));
  expect_right_products(problem);
}

// A reaction moved in Gauss-Seidel changes every rate by W's column, in vectors of either kind.
template <class Vector>
void expect_felt(const Problem& problem, bool velocity) {
  Eigen::VectorXd r = Eigen::VectorXd::LinSpaced(problem.rows(), -1.0, 2.0);
  with_coupling(problem, velocity, [&](auto coupling) {
    refresh(coupling, problem, r);
    const Vector change = Eigen::Vector3d(0.3, -0.2, 0.5);
    coupling.moved(11, change);
    r.segment<3>(problem.start(11)) += change;
    const Eigen::VectorXd expected = problem.rate(r);
    for (int i = 0; i < problem.cone_count(); ++i) {
      Vector u(3);
      coupling.rate(i, problem.start(i), u);
      EXPECT_LE((u - expected.segment<3>(problem.start(i))).norm(), 1e-14 * expected.norm()) << i;
      const double normal = coupling.normal_rate(i, problem.start(i), 3);
      EXPECT_NEAR(normal, expected(problem.start(i)), 1e-14 * expected.norm()) << i;
    }
    return 0;
  });
}

TEST(BlockedRows, FeelWhatMoves) {
  for (const Flaw& flaw : {Flaw{}, Flaw{.arm = 1e-2}}) {
    const Problem problem = spheres(30, flaw);
    for (const bool velocity : {true, false}) {
      expect_felt<Eigen::Vector3d>(problem, velocity);
      expect_felt<Eigen::VectorXd>(problem, velocity);
    }
  }
}

TEST(BlockedRows, TakeNothingElseForSpheres) {
  for (const Flaw& flaw : {Flaw{.arm = 1e-9}, Flaw{.inertia = 1e-9}}) {
    const Problem problem = spheres(30, flaw);
    EXPECT_FALSE(BlockedRows(problem).of_spheres());
    expect_right_products(problem);
  }
}

}  // namespace
}  // namespace conebench::solvers
