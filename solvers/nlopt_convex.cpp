#include "solvers/nlopt_convex.h"

#include <fmt/format.h>
#include <nlopt.h>

#include <cmath>
#include <exception>
#include <limits>
#include <utility>

#include "solvers/aclm.h"
#include "solvers/dimensionless.h"

namespace conebench::solvers {
namespace {

using problems::Cone;
using problems::Problem;
using Algorithm = NloptSettings::Algorithm;
using ConstVector = Eigen::Map<const Eigen::VectorXd>;
using Vector = Eigen::Map<Eigen::VectorXd>;
using RowMatrix =
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;

constexpr double kEps = 1e-10 * Dimensionless::kRateScale;
constexpr int kEvaluations = 300;
constexpr double kLongestRun_s = 1.0;  // of the algorithm, at whose end the limits are looked at
// A run that does not lower the error by this factor is the last.
constexpr double kProgress = 0.9;
// Of auglag's inner problems.
constexpr int kInnerEvaluations = 100;

nlopt_algorithm code(Algorithm algorithm) {
  switch (algorithm) {
    case Algorithm::kSlsqp:
      return NLOPT_LD_SLSQP;
    case Algorithm::kMma:
      return NLOPT_LD_MMA;
    case Algorithm::kCcsaq:
      return NLOPT_LD_CCSAQ;
    case Algorithm::kAuglag:
      return NLOPT_AUGLAG;
  }
  return NLOPT_LD_SLSQP;
}

int largest_rows(Algorithm algorithm) { return algorithm == Algorithm::kAuglag ? 1000 : 300; }

struct Destroy {
  void operator()(nlopt_opt optimizer) const { nlopt_destroy(optimizer); }
};
using Optimizer = std::unique_ptr<nlopt_opt_s, Destroy>;

class NloptConvex final : public ConvexIteration {
 public:
  NloptConvex(const Problem& problem, const NloptSettings& settings)
      : problem_(problem), scaled_(problem), settings_(settings) {
    for (int i = 0; i < problem.cone_count(); ++i) {
      if (cone(i).dim > 1 && cone(i).mu > 0.0) frictional_.push_back(i);
    }
  }

  void pose(const Eigen::VectorXd& shift, const Eigen::VectorXd& r) override {
    shift_ = shift;
    stalled_ = false;
    take(r);
  }

  Iteration::State advance(double tolerance) override {
    if (error_ <= tolerance) return Iteration::State::kRunning;
    if (stalled_) return Iteration::State::kStalled;
    const double before = error_;
    run(tolerance);
    stalled_ = error_ > kProgress * before;
    return Iteration::State::kRunning;
  }

  const Eigen::VectorXd& r() const override { return r_; }
  const Eigen::VectorXd& u() const override { return u_; }
  double error() const override { return error_; }
  std::vector<std::string> notes() const override { return {"cones smoothed by eps 1e-10 U"}; }

 private:
  const Cone& cone(int i) const { return problem_.cones()[static_cast<std::size_t>(i)]; }

  void take(const Eigen::VectorXd& r) {
    r_ = r;
    project_on_cones(problem_, r_);
    u_ = problem_.rate(r_);
    error_ = convex_error(problem_, shift_, r_, u_);
  }

  void run(double tolerance) {
    Optimizer optimizer = make_optimizer();
    running_ = optimizer.get();
    tolerance_ = tolerance;
    best_error_ = error_;
    best_ = r_;
    Eigen::VectorXd x = r_.cwiseQuotient(scaled_.force);
    double value = 0.0;
    nlopt_optimize(running_, x.data(), &value);  // however it ends, best_ is the best it saw
    if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
    take(best_);
  }

  Optimizer make_optimizer() {
    const auto rows = static_cast<unsigned>(problem_.rows());
    Optimizer optimizer(nlopt_create(code(settings_.algorithm), rows));
    Eigen::VectorXd lower = Eigen::VectorXd::Constant(rows, -HUGE_VAL), upper = -lower;
    for (int i = 0; i < problem_.cone_count(); ++i) {
      const int at = problem_.start(i), tangents = cone(i).dim - 1;
      lower(at) = 0.0;
      if (cone(i).mu > 0.0) continue;
      lower.segment(at + 1, tangents).setZero();
      upper.segment(at + 1, tangents).setZero();
    }
    nlopt_set_lower_bounds(optimizer.get(), lower.data());
    nlopt_set_upper_bounds(optimizer.get(), upper.data());
    nlopt_set_min_objective(optimizer.get(), &NloptConvex::objective, this);
    if (!frictional_.empty()) {
      const Eigen::VectorXd exact = Eigen::VectorXd::Zero(problem_.cone_count());
      nlopt_add_inequality_mconstraint(optimizer.get(), static_cast<unsigned>(frictional_.size()),
                                       &NloptConvex::constraints, this, exact.data());
    }
    nlopt_set_maxeval(optimizer.get(), kEvaluations);
    nlopt_set_maxtime(optimizer.get(), kLongestRun_s);
    if (settings_.algorithm == Algorithm::kAuglag) {
      const Optimizer inner(nlopt_create(NLOPT_LD_LBFGS, rows));
      nlopt_set_maxeval(inner.get(), kInnerEvaluations);
      nlopt_set_ftol_rel(inner.get(), 1e-14);
      nlopt_set_local_optimizer(optimizer.get(), inner.get());
    }
    return optimizer;
  }

  // 1/2 r.W r + (q + t e_n).r, less its value at r_, where the run started: written in r - r_, it
  // does not cancel near the solution. The gradient in r is u + t e_n.
  static double objective(unsigned rows, const double* values, double* gradient, void* self) {
    auto& convex = *static_cast<NloptConvex*>(self);
    try {
      return convex.evaluate(ConstVector(values, rows), gradient);
    } catch (...) {
      convex.failure_ = std::current_exception();
      nlopt_force_stop(convex.running_);
      return 0.0;
    }
  }

  double evaluate(const ConstVector& x, double* gradient) {
    const Eigen::VectorXd r = x.cwiseProduct(scaled_.force);
    Eigen::VectorXd u = problem_.rate(r);
    watch(r, u);
    double value = 0.5 * (r - r_).dot(u + u_);
    for (int i = 0; i < problem_.cone_count(); ++i) {
      const int at = problem_.start(i);
      value += shift_(i) * (r(at) - r_(at));
      u(at) += shift_(i);
    }
    if (gradient != nullptr) Vector(gradient, x.size()) = u.cwiseQuotient(scaled_.rate);
    return value / scaled_.energy;
  }

  void watch(const Eigen::VectorXd& r, const Eigen::VectorXd& u) {
    const double error = convex_error(problem_, shift_, r, u);
    if (!(error < best_error_)) return;
    best_error_ = error;
    best_ = r;
    if (error <= 0.5 * tolerance_) nlopt_force_stop(running_);
  }

  static void constraints(unsigned, double* result, unsigned rows, const double* values,
                          double* gradient, void* self) noexcept {
    const auto& convex = *static_cast<NloptConvex*>(self);
    const ConstVector x(values, rows);
    const auto count = static_cast<Eigen::Index>(convex.frictional_.size());
    if (gradient != nullptr) RowMatrix(gradient, count, rows).setZero();
    for (Eigen::Index k = 0; k < count; ++k) {
      const int i = convex.frictional_[static_cast<std::size_t>(k)];
      const int at = convex.problem_.start(i);
      const auto t = x.segment(at + 1, convex.cone(i).dim - 1);
      const double root = std::sqrt(t.squaredNorm() + kEps * kEps), mu = convex.cone(i).mu;
      result[k] = t.squaredNorm() / (root + kEps) - mu * x(at);
      if (gradient == nullptr) continue;
      RowMatrix jacobian(gradient, count, rows);
      jacobian(k, at) = -mu;
      jacobian.row(k).segment(at + 1, t.size()) = t.transpose() / root;
    }
  }

  const Problem& problem_;
  Dimensionless scaled_;
  NloptSettings settings_;
  std::vector<int> frictional_;  // cones with a tangential constraint
  Eigen::VectorXd shift_, r_, u_;
  double error_ = 0.0;
  bool stalled_ = false;
  // Of the run in progress.
  nlopt_opt running_ = nullptr;
  double tolerance_ = 0.0, best_error_ = 0.0;
  Eigen::VectorXd best_;
  std::exception_ptr failure_;
};

NloptSettings settings_from(const Values& values) {
  const auto& name = std::get<std::string>(values.at("algorithm"));
  return {name == "mma"      ? Algorithm::kMma
          : name == "ccsaq"  ? Algorithm::kCcsaq
          : name == "auglag" ? Algorithm::kAuglag
                             : Algorithm::kSlsqp};
}

Refuses refuses(const NloptSettings& settings) {
  return [limit = largest_rows(settings.algorithm)](
             const Problem& problem) -> std::optional<std::string> {
    if (problem.rows() <= limit) return refuse_zero_delassus(problem);
    return fmt::format("{} rows, expected at most {} (NLopt's matrices are dense)", problem.rows(),
                       limit);
  };
}

}  // namespace

std::unique_ptr<ConvexIteration> make_nlopt_convex(const Problem& problem,
                                                   const NloptSettings& settings) {
  return std::make_unique<NloptConvex>(problem, settings);
}

Method nlopt() {
  Method method = make_aclm_method(
      "nlopt", "fixed point on the De Saxce term; inner NLopt on the reduced convex problem",
      {{.name = "algorithm",
        .fallback = std::string("slsqp"),
        .choices = {"slsqp", "mma", "ccsaq", "auglag"},
        .doc = "of NLopt; auglag takes at most 1000 rows, the others 300"}},
      [](const Values& values) -> MakeConvex {
        return [settings = settings_from(values)](const Problem& problem) {
          return make_nlopt_convex(problem, settings);
        };
      },
      [](const Values& values) { return refuses(settings_from(values)); });
  method.source +=
      "; inner: NLopt; Kraft 1988 (slsqp); Svanberg, SIAM J. Optim. 12(2) (2002) 555-573 (mma, "
      "ccsaq); Birgin, Martinez, Optim. Methods Softw. 23(2) (2008) (auglag) (none checked)";
  return method;
}

}  // namespace conebench::solvers
