#include "solvers/ipopt_convex.h"

#include <limits>

#include "solvers/aclm.h"
#include "solvers/dimensionless.h"
#include "solvers/ipopt_runs.h"

namespace conebench::solvers {
namespace {

using problems::Cone;
using problems::Problem;
using problems::SparseMatrix;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kRunIterations = 100;

SparseMatrix lower_of(const SparseMatrix& matrix) { return matrix.triangularView<Eigen::Lower>(); }

// [M, -H^T], dofs x (dofs + rows).
SparseMatrix momentum(const Dimensionless& scaled) {
  const int dofs = static_cast<int>(scaled.M.rows()), rows = static_cast<int>(scaled.H.rows());
  std::vector<Eigen::Triplet<double, int>> entries;
  for (int i = 0; i < dofs; ++i) {
    for (SparseMatrix::InnerIterator it(scaled.M, i); it; ++it) {
      entries.emplace_back(i, static_cast<int>(it.col()), it.value());
    }
  }
  for (int k = 0; k < rows; ++k) {
    for (SparseMatrix::InnerIterator it(scaled.H, k); it; ++it) {
      entries.emplace_back(static_cast<int>(it.col()), dofs + k, -it.value());
    }
  }
  SparseMatrix A(dofs, dofs + rows);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

SparseMatrix quadratic(const Problem& problem, const Dimensionless& scaled) {
  if (!problem.is_primal()) {
    return lower_of(0.5 * (scaled.W + SparseMatrix(scaled.W.transpose())));
  }
  SparseMatrix Q = lower_of(scaled.M);
  const Eigen::Index size = problem.dofs() + problem.rows();
  Q.conservativeResize(size, size);
  Q.makeCompressed();
  return Q;
}

void constrain(const Cone& cone, int r, ConeProgram& program) {
  program.lower(r) = 0.0;
  const int tangents = cone.dim - 1;
  if (tangents > 0 && cone.mu > 0.0) {
    program.cones.push_back({r, r + 1, tangents, cone.mu});
    return;
  }
  program.lower.segment(r + 1, tangents).setZero();
  program.upper.segment(r + 1, tangents).setZero();
}

class IpoptConvex final : public ConvexIteration {
 public:
  explicit IpoptConvex(const Problem& problem)
      : problem_(problem), scaled_(problem), dofs_(problem.is_primal() ? problem.dofs() : 0) {
    const int size = dofs_ + problem.rows();
    program_ = {.Q = quadratic(problem, scaled_),
                .c = Eigen::VectorXd::Zero(size),
                .A = problem.is_primal() ? momentum(scaled_) : SparseMatrix(0, size),
                .b = scaled_.f,
                .lower = Eigen::VectorXd::Constant(size, -kInfinity),
                .upper = Eigen::VectorXd::Constant(size, kInfinity),
                .eps = kIpoptEps};
    for (int i = 0; i < problem.cone_count(); ++i) {
      constrain(cone(i), dofs_ + problem.start(i), program_);
    }
  }

  void pose(const Eigen::VectorXd& shift, const Eigen::VectorXd& r) override {
    shift_ = shift;
    program_.c.tail(problem_.rows()) = problem_.is_primal() ? scaled_.w : scaled_.q;
    for (int i = 0; i < problem_.cone_count(); ++i) {
      const int at = problem_.start(i);
      program_.c(dofs_ + at) += shift(i) / scaled_.rate(at);
    }
    point_ = {};
    point_.x.resize(program_.variables());
    point_.x.tail(problem_.rows()) = r.cwiseQuotient(scaled_.force);
    if (dofs_ > 0) point_.x.head(dofs_) = problem_.velocity(r).cwiseQuotient(scaled_.velocity);
    runs_ = IpoptRuns(kRunIterations);
    take(r);
  }

  Iteration::State advance(double tolerance) override {
    if (error_ <= tolerance) return Iteration::State::kRunning;
    runs_.aim_at(tolerance);
    if (runs_.over()) return Iteration::State::kStalled;
    runs_.run(program_, point_, [](const Eigen::VectorXd&) { return true; });
    if (!point_.x.allFinite()) return Iteration::State::kDiverged;
    take(point_.x.tail(problem_.rows()).cwiseProduct(scaled_.force));
    return Iteration::State::kRunning;
  }

  const Eigen::VectorXd& r() const override { return r_; }
  const Eigen::VectorXd& u() const override { return u_; }
  double error() const override { return error_; }
  std::vector<std::string> notes() const override { return {"cones smoothed by eps 1e-14 U"}; }

 private:
  const Cone& cone(int i) const { return problem_.cones()[static_cast<std::size_t>(i)]; }

  void take(const Eigen::VectorXd& r) {
    r_ = r;
    project_on_cones(problem_, r_);
    u_ = problem_.rate(r_);
    error_ = convex_error(problem_, shift_, r_, u_);
  }

  const Problem& problem_;
  Dimensionless scaled_;
  int dofs_;
  ConeProgram program_;
  ProgramPoint point_;
  IpoptRuns runs_{kRunIterations};
  Eigen::VectorXd shift_, r_, u_;
  double error_ = kInfinity;
};

}  // namespace

std::unique_ptr<ConvexIteration> make_ipopt_convex(const Problem& problem) {
  return std::make_unique<IpoptConvex>(problem);
}

Method aclm_ipopt() {
  Method method = make_aclm_method(
      "aclm-ipopt", "fixed point on the De Saxce term; inner Ipopt on the convex cone program", {},
      [](const Values&) { return MakeConvex(make_ipopt_convex); },
      [](const Values&) { return Refuses(refuse_zero_delassus); });
  method.source +=
      "; inner: Ipopt, Waechter, Biegler, Math. Program. 106(1) (2006) 25-57 (not checked)";
  return method;
}

}  // namespace conebench::solvers
