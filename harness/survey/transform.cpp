#include "harness/survey/transform.h"

#include <Eigen/QR>
#include <algorithm>
#include <numeric>
#include <random>

namespace conebench::harness {
namespace {

using problems::Cone;
using problems::PrimalData;
using problems::Problem;
using problems::SparseMatrix;

using Entries = std::vector<Eigen::Triplet<double, int>>;

std::vector<Cone> cones_of(const Problem& problem) {
  return {problem.cones().begin(), problem.cones().end()};
}

SparseMatrix matrix(int rows, int columns, const Entries& entries) {
  SparseMatrix A(rows, columns);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

SparseMatrix scaled_identity(int rows, double value) {
  SparseMatrix A(rows, rows);
  A.setIdentity();
  return A * value;
}

// u_twin = E u, hence H^T r = H_twin^T r_twin for r = E^T r_twin. E^T E = copies I.
Twin with_rows(const Problem& original, const SparseMatrix& E, std::vector<Cone> cones,
               double copies) {
  const SparseMatrix back = E.transpose();
  return {Problem(PrimalData{original.M(), E * original.H(), original.f(), E * original.w()},
                  std::move(cones), original.metadata()),
          back, back / copies};
}

Eigen::MatrixXd random_orthogonal(int n, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  Eigen::MatrixXd A(n, n);
  for (double& x : A.reshaped()) x = normal(random);
  return Eigen::HouseholderQR<Eigen::MatrixXd>(A).householderQ();
}

}  // namespace

Twin in_units(const Problem& original, double force, double rate) {
  std::vector<Cone> cones = cones_of(original);
  for (Cone& cone : cones) cone.kappa *= force;
  return {Problem(PrimalData{original.M() * (force / rate), original.H(), original.f() * force,
                             original.w() * rate},
                  std::move(cones), original.metadata()),
          scaled_identity(original.rows(), 1.0 / force),
          scaled_identity(original.rows(), 1.0 / rate)};
}

Twin with_turned_tangents(const Problem& original, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  Entries turn;
  for (int i = 0; i < original.cone_count(); ++i) {
    const int start = original.start(i);
    const int tangents = original.cones()[static_cast<std::size_t>(i)].dim - 1;
    turn.emplace_back(start, start, 1.0);
    if (tangents == 0) continue;
    const Eigen::MatrixXd Q =
        tangents == 1 ? -Eigen::MatrixXd::Identity(1, 1) : random_orthogonal(tangents, random);
    for (int row = 0; row < tangents; ++row) {
      for (int column = 0; column < tangents; ++column) {
        turn.emplace_back(start + 1 + row, start + 1 + column, Q(row, column));
      }
    }
  }
  return with_rows(original, matrix(original.rows(), original.rows(), turn), cones_of(original),
                   1.0);
}

Twin in_random_order(const Problem& original, std::uint64_t seed) {
  std::vector<int> order(static_cast<std::size_t>(original.cone_count()));
  std::iota(order.begin(), order.end(), 0);
  std::mt19937_64 random(seed);
  std::shuffle(order.begin(), order.end(), random);
  std::vector<Cone> cones;
  Entries moves;
  int row = 0;
  for (const int i : order) {
    cones.push_back(original.cones()[static_cast<std::size_t>(i)]);
    for (int k = 0; k < cones.back().dim; ++k, ++row) {
      moves.emplace_back(row, original.start(i) + k, 1.0);
    }
  }
  return with_rows(original, matrix(row, row, moves), std::move(cones), 1.0);
}

Twin with_cones_twice(const Problem& original) {
  std::vector<Cone> cones = cones_of(original);
  for (Cone& cone : cones) cone.kappa *= 0.5;
  cones.insert(cones.end(), cones.begin(), cones.begin() + original.cone_count());
  Entries copies;
  for (int row = 0; row < original.rows(); ++row) {
    copies.emplace_back(row, row, 1.0);
    copies.emplace_back(original.rows() + row, row, 1.0);
  }
  return with_rows(original, matrix(2 * original.rows(), original.rows(), copies), std::move(cones),
                   2.0);
}

Problem alone(const problems::MadeProblem& made, int cone) {
  const Problem& whole = made.problem;
  const int start = whole.start(cone), dim = whole.cones()[static_cast<std::size_t>(cone)].dim;
  Eigen::VectorXd others = made.solutions.at(0) - whole.tip_shift();
  others.segment(start, dim).setZero();
  return Problem(
      PrimalData{whole.M(), whole.H().middleRows(start, dim),
                 whole.f() + whole.H().transpose() * others, whole.w().segment(start, dim)},
      {whole.cones()[static_cast<std::size_t>(cone)]}, whole.metadata());
}

Problem with_strength(const Problem& problem, double kappa) {
  std::vector<Cone> cones = cones_of(problem);
  for (Cone& cone : cones) cone.kappa = kappa;
  return Problem(PrimalData{problem.M(), problem.H(), problem.f(), problem.w()}, std::move(cones),
                 problem.metadata());
}

Problem with_prescribed_rate(const Problem& problem, int cone, const Eigen::VectorXd& rate) {
  const int start = problem.start(cone);
  PrimalData data{problem.M(), problem.H(), problem.f(), problem.w()};
  data.H.prune([&](Eigen::Index row, Eigen::Index, double) {
    return row < start || row >= start + rate.size();
  });
  data.w.segment(start, rate.size()) = rate;
  return Problem(std::move(data), cones_of(problem), problem.metadata());
}

}  // namespace conebench::harness
