#include "tests/engine/small_solver.h"

#include <Eigen/Dense>
#include <algorithm>

namespace conebench::test {
namespace {

constexpr int kMostSweeps = 100'000;

// One cone's reaction in place; returns the largest change as a rate.
double relax(const Eigen::MatrixXd& W, const Eigen::VectorXd& q, int start,
             const problems::Cone& cone, Eigen::VectorXd& r) {
  const int tangents = cone.dim - 1;
  double change = 0.0, normal = r[start];
  if (W(start, start) > 0.0) {
    const double u_n = W.row(start).dot(r) + q[start];
    normal = std::max(0.0, r[start] - u_n / W(start, start));
    change = W(start, start) * std::abs(normal - r[start]);
    r[start] = normal;
  }
  if (tangents == 0) return change;
  // The largest sum of a row bounds the largest eigenvalue, and is it where the block is diagonal.
  const double mobility =
      W.block(start + 1, start + 1, tangents, tangents).cwiseAbs().rowwise().sum().maxCoeff();
  if (!(mobility > 0.0)) return change;
  const Eigen::VectorXd before = r.segment(start + 1, tangents);
  Eigen::VectorXd t =
      before - (W.middleRows(start + 1, tangents) * r + q.segment(start + 1, tangents)) / mobility;
  if (const double size = t.norm(); size > cone.mu * normal) t *= cone.mu * normal / size;
  r.segment(start + 1, tangents) = t;
  return std::max(change, mobility * (t - before).norm());
}

}  // namespace

engine::StepSolver small_solver(double tol) {
  return [tol](const problems::Problem& standard, const Eigen::VectorXd& guess) {
    const Eigen::MatrixXd W(standard.delassus());
    const Eigen::VectorXd& q = standard.q();
    engine::StepAnswer answer;
    answer.r = guess;
    const double allowed = tol * std::max(q.cwiseAbs().maxCoeff(), 1e-300);
    while (answer.iterations < kMostSweeps && !answer.converged) {
      double change = 0.0;
      for (int i = 0; i < standard.cone_count(); ++i) {
        const auto& cone = standard.cones()[static_cast<std::size_t>(i)];
        change = std::max(change, relax(W, q, standard.start(i), cone, answer.r));
      }
      ++answer.iterations;
      answer.converged = change <= allowed;
    }
    answer.status = answer.converged ? "converged" : "iteration_limit";
    return answer;
  };
}

}  // namespace conebench::test
