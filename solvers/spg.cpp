#include "solvers/spg.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solvers/cone_vectors.h"
#include "solvers/convex.h"
#include "solvers/delassus_product.h"

namespace conebench::solvers {
namespace {

using problems::Problem;

constexpr double kSufficientDecrease = 1e-4;
constexpr double kLongestStep = 1e10;
// u is updated by W d; recomputed from r this often, since rounding accumulates.
constexpr std::int64_t kIterationsPerRefresh = 100;

enum class Step { kLong, kShort, kAdaptive };

struct Settings {
  std::int64_t memory = 10;
  std::int64_t refresh = 1;
  Step step = Step::kAdaptive;
};

// f_s of past iterates: f_0 and r_n of each, so that it can be evaluated for any s.
class History {
 public:
  explicit History(std::int64_t memory) : memory_(static_cast<std::size_t>(memory)) {}

  void add(double f0, Eigen::VectorXd normals) {
    Entry entry{f0, std::move(normals)};
    if (entries_.size() < memory_) {
      entries_.push_back(std::move(entry));
    } else {
      entries_[oldest_] = std::move(entry);
      oldest_ = (oldest_ + 1) % memory_;
    }
  }

  double largest(const Eigen::VectorXd& theta_s) const {
    double worst = -std::numeric_limits<double>::infinity();
    for (const Entry& entry : entries_) {
      worst = std::max(worst, entry.f0 + theta_s.dot(entry.normals));
    }
    return worst;
  }

 private:
  struct Entry {
    double f0;
    Eigen::VectorXd normals;
  };
  std::size_t memory_, oldest_ = 0;
  std::vector<Entry> entries_;
};

class Spg final : public Iteration {
 public:
  Spg(const Problem& problem, const Settings& settings)
      : problem_(problem),
        settings_(settings),
        product_(problem),
        mobility_(mobility_per_row(problem)) {}

  void start(const Eigen::VectorXd& r) override {
    r_ = r;
    project_on_cones(problem_, r_);
    product_.rate(r_, u_);
    alpha_ = 1.0;
    history_ = History(settings_.memory);
    iterations_ = 0;
    still_ = true;
  }

  State advance() override {
    if (++iterations_ % kIterationsPerRefresh == 0) product_.rate(r_, u_);
    // A subproblem solved to rounding before its time is over is refreshed at once.
    const bool fresh = still_ || iterations_ % settings_.refresh == 0;
    if (fresh) theta_s_ = de_saxce_shift(problem_, u_);
    shift_rate();
    d_ = r_ - alpha_ * gradient_.cwiseQuotient(mobility_);
    project_on_cones(problem_, d_);
    d_ -= r_;
    product_.apply(d_, Wd_);
    const double slope = gradient_.dot(d_), curvature = d_.dot(Wd_);

    const double f0 = 0.5 * r_.dot(u_ + problem_.q());
    history_.add(f0, normals());
    const double f = f0 + theta_s_.dot(normals());
    const double t = line_search(f, slope, curvature);
    r_ += t * d_;
    u_ += t * Wd_;
    if (!r_.allFinite()) return State::kDiverged;
    update_alpha(curvature);
    still_ = t * size_as_rate(problem_, d_) <= kNoProgress * size_as_rate(problem_, r_);
    return still_ && fresh ? State::kStalled : State::kRunning;
  }

  const Eigen::VectorXd& r() const override { return r_; }
  double own_eta() const override {
    return convex_error(problem_, de_saxce_shift(problem_, u_), r_, u_);
  }

 private:
  void shift_rate() {
    gradient_ = u_;
    for (int i = 0; i < problem_.cone_count(); ++i) gradient_(problem_.start(i)) += theta_s_(i);
  }

  Eigen::VectorXd normals() const {
    Eigen::VectorXd n(problem_.cone_count());
    for (int i = 0; i < problem_.cone_count(); ++i) n(i) = r_(problem_.start(i));
    return n;
  }

  // f_s(r + t d) = f + t slope + t^2 curvature / 2, exactly where W is symmetric.
  double line_search(double f, double slope, double curvature) const {
    const double reference = history_.largest(theta_s_);
    double t = 1.0;
    for (int shortening = 0; shortening < 60; ++shortening) {
      const double reached = f + t * (slope + 0.5 * t * curvature);
      if (!(reached > reference + kSufficientDecrease * t * slope)) break;
      const double minimum = curvature > 0.0 ? -slope / curvature : 0.0;
      t = std::clamp(minimum, 0.1 * t, 0.5 * t);
    }
    return t;
  }

  void update_alpha(double curvature) {
    const double metric = d_.cwiseAbs2().dot(mobility_);
    const double dual_metric = Wd_.cwiseAbs2().cwiseQuotient(mobility_).sum();
    const double longest = curvature > 0.0 ? metric / curvature : kLongestStep;
    const double shortest = dual_metric > 0.0 ? curvature / dual_metric : kLongestStep;
    const bool take_short = settings_.step == Step::kShort ||
                            (settings_.step == Step::kAdaptive && shortest < 0.5 * longest);
    alpha_ = std::clamp(take_short ? shortest : longest, 1.0 / kLongestStep, kLongestStep);
  }

  const Problem& problem_;
  Settings settings_;
  DelassusProduct product_;
  Eigen::VectorXd mobility_;  // lambda_i on each row of cone i
  Eigen::VectorXd r_, u_;
  Eigen::VectorXd gradient_, d_, Wd_;
  Eigen::VectorXd theta_s_;  // theta_i |u_it| as last refreshed
  double alpha_ = 1.0;
  History history_{1};
  std::int64_t iterations_ = 0;
  bool still_ = true;  // the last step was rounding, or there was none
};

Solver make(const Method& method, const Values& values) {
  const std::string step = std::get<std::string>(values.at("step"));
  const Settings settings{std::get<std::int64_t>(values.at("memory")),
                          std::get<std::int64_t>(values.at("refresh")),
                          step == "long"    ? Step::kLong
                          : step == "short" ? Step::kShort
                                            : Step::kAdaptive};
  return make_iterative_solver(
      method, values, refuse_zero_delassus,
      [settings](const Problem& problem) { return std::make_unique<Spg>(problem, settings); });
}

}  // namespace

Method spectral_projected_gradient() {
  Method method{
      .name = "spg",
      .kind = Kind::kMethod,
      .summary = "spectral projected gradient, non-monotone, De Saxce term refreshed",
      .source =
          "Birgin, Martinez, Raydan, SIAM J. Optim. 10(4) (2000), Algorithm SPG2 (not checked)",
      .parameters = {{.name = "memory",
                      .fallback = std::int64_t{10},
                      .low = 1,
                      .high = 100,
                      .doc = "iterates that the line search compares with [-]"},
                     {.name = "refresh",
                      .fallback = std::int64_t{1},
                      .low = 1,
                      .high = 10000,
                      .doc = "iterations between two refreshes of the De Saxce term [-]"},
                     {.name = "step",
                      .fallback = std::string("adaptive"),
                      .choices = {"adaptive", "long", "short"},
                      .doc = "which Barzilai-Borwein step length"}},
      .make = {}};
  method.make = [method](const Values& values) { return make(method, values); };
  return method;
}

}  // namespace conebench::solvers
