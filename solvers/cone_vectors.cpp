#include "solvers/cone_vectors.h"

#include <algorithm>

#include "solvers/with_dimension.h"

namespace conebench::solvers {
namespace {

using problems::Cone;
using problems::Problem;

// function(cone, i, its part of x), the part's size known to the compiler where OneCone's is.
template <class Vector, class Function>
void for_each_part(const Problem& problem, Vector& x, const Function& function) {
  for (int i = 0; i < problem.cone_count(); ++i) {
    const Cone& cone = problem.cones()[static_cast<std::size_t>(i)];
    with_dimension(cone.dim, [&]<int D>() {
      auto part = x.template segment<D>(problem.start(i), cone.dim);
      function(cone, i, part);
    });
  }
}

}  // namespace

Eigen::VectorXd mobility_per_row(const Problem& problem) {
  Eigen::VectorXd mobility(problem.rows());
  for_each_part(problem, mobility,
                [&](const Cone&, int i, auto& part) { part.setConstant(problem.mobility()(i)); });
  return mobility;
}

void project_on_cones(const Problem& problem, Eigen::VectorXd& r) {
  for_each_part(problem, r,
                [](const Cone& cone, int, auto& part) { problems::project(cone.mu, part); });
}

void add_de_saxce(const Problem& problem, Eigen::VectorXd& u) {
  for_each_part(problem, u, [](const Cone& cone, int, auto& part) {
    problems::add_de_saxce(cone.theta, part);
  });
}

double size_as_rate(const Problem& problem, const Eigen::VectorXd& r) {
  double largest = 0.0;
  for_each_part(problem, r, [&](const Cone&, int i, const auto& part) {
    largest = std::max(largest, problem.mobility()(i) * part.norm());
  });
  return largest;
}

}  // namespace conebench::solvers
