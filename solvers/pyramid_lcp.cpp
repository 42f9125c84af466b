#include "solvers/pyramid_lcp.h"

#include <cmath>
#include <vector>

namespace conebench::solvers {
namespace {

using problems::Cone;
using problems::Problem;

bool rubs(const Cone& cone) { return cone.mu > 0.0 && cone.dim > 1; }

Eigen::Index variables(const Cone& cone, const PyramidLaw& law) {
  return rubs(cone) ? law.directions(cone.dim).cols() + 2 : 1;
}

// Of r, so that |q| becomes 1 in the units sqrt(lambda_i) of u_i.
double force_scale(const Problem& problem) {
  double largest = 0.0;
  for (int i = 0; i < problem.cone_count(); ++i) {
    const double size =
        problem.q()
            .segment(problem.start(i), problem.cones()[static_cast<std::size_t>(i)].dim)
            .norm();
    largest = std::max(largest, size / std::sqrt(problem.mobility()(i)));
  }
  return largest > 0.0 ? largest : 1.0;
}

}  // namespace

Eigen::Index PyramidLcp::size(const Problem& problem, const PyramidLaw& law) {
  Eigen::Index size = 0;
  for (const Cone& cone : problem.cones()) size += variables(cone, law);
  return size;
}

PyramidLcp::PyramidLcp(const Problem& problem, const PyramidLaw& law)
    : G(problem.rows(), size(problem, law)) {
  const double scale = force_scale(problem);
  std::vector<Eigen::Triplet<double>> entries;
  M = Eigen::MatrixXd::Zero(G.cols(), G.cols());  // S, to begin with
  Eigen::Index z = 0;
  for (int i = 0; i < problem.cone_count(); ++i) {
    const Cone& cone = problem.cones()[static_cast<std::size_t>(i)];
    const double unit = scale / std::sqrt(problem.mobility()(i));
    entries.emplace_back(problem.start(i), static_cast<int>(z), unit);
    const Eigen::Index next = z + variables(cone, law);
    if (rubs(cone)) {
      const Eigen::MatrixXd d = law.directions(cone.dim);
      for (Eigen::Index j = 0; j < d.cols(); ++j) {
        for (Eigen::Index k = 0; k < d.rows(); ++k) {
          entries.emplace_back(problem.start(i) + 1 + static_cast<int>(k),
                               static_cast<int>(z + 1 + j), unit * d(k, j));
        }
      }
      const Eigen::Index gamma = next - 1;
      M(z, gamma) = -(cone.mu - cone.theta);
      M(gamma, z) = cone.mu;
      M.block(z + 1, gamma, d.cols(), 1).setOnes();
      M.block(gamma, z + 1, 1, d.cols()).setConstant(-1.0);
    }
    z = next;
  }
  G.setFromTriplets(entries.begin(), entries.end());
  // u_i in units of scale sqrt(lambda_i) is G^T u / scale^2.
  M += Eigen::MatrixXd(problems::SparseMatrix(G.transpose()) * problem.delassus() * G) /
       (scale * scale);
  q = G.transpose() * problem.q() / (scale * scale);
}

}  // namespace conebench::solvers
