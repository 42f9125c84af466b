#include "solvers/ppa.h"

#include <algorithm>
#include <limits>

#include "solvers/convex.h"
#include "solvers/gs.h"
#include "solvers/ppa_inner.h"

namespace conebench::solvers {
namespace {

using problems::Problem;
using State = Iteration::State;

constexpr double kLeastAlpha = 1e-10, kLargestAlpha = 1e3;
constexpr int kEasy = 4, kSlow = 12, kMostIterations = 40, kMostFailures = 8;
constexpr double kFastFall = 0.2, kFall = 0.5, kRise = 4.0;

struct Settings {
  double weight = 1e-3;
  double accuracy = 0.1;
};

class ProximalPoint final : public Iteration {
 public:
  ProximalPoint(const Problem& problem, std::unique_ptr<ProximalInner> inner,
                const Settings& settings)
      : problem_(problem), inner_(std::move(inner)), settings_(settings) {}

  void start(const Eigen::VectorXd& r) override {
    best_ = r;
    best_eta_ = eta_of(r, problem_.rate(r));
    alpha_ = settings_.weight;
    failures_ = 0;
    pose(best_);
  }

  State advance() override {
    const bool advanced = inner_->advance();
    work_s_ += inner_->step_work_s();
    if (!advanced) return fail();
    ++iterations_;
    keep_best();
    if (solved()) {
      next_centre();
      return State::kRunning;
    }
    return iterations_ < kMostIterations ? State::kRunning : fail();
  }

  const Eigen::VectorXd& r() const override { return best_; }
  double own_eta() const override { return best_eta_; }
  double work_s() const override { return work_s_; }

 private:
  double eta_of(const Eigen::VectorXd& r, const Eigen::VectorXd& u) const {
    return convex_error(problem_, de_saxce_shift(problem_, u), r, u);
  }

  void pose(const Eigen::VectorXd& centre) {
    centre_ = centre;
    inner_->pose(centre_, alpha_);
    iterations_ = 0;
  }

  void keep_best() {
    const double eta = eta_of(inner_->r(), inner_->u());
    if (!(eta < best_eta_)) return;
    best_eta_ = eta;
    best_ = inner_->r();
  }

  // F <= accuracy D, in the letters of ppa.h.
  bool solved() const {
    Eigen::VectorXd pull = inner_->r() - centre_;
    double longest = 0.0;
    for (int i = 0; i < problem_.cone_count(); ++i) {
      auto part =
          pull.segment(problem_.start(i), problem_.cones()[static_cast<std::size_t>(i)].dim);
      part *= alpha_ * problem_.mobility()(i);
      longest = std::max(longest, part.norm());
    }
    if (problem_.rate_scale() > 0.0) longest /= problem_.rate_scale();
    return eta_of(inner_->r(), inner_->u() + pull) <= settings_.accuracy * longest;
  }

  void next_centre() {
    if (iterations_ <= kSlow) {
      alpha_ = std::max((iterations_ <= kEasy ? kFastFall : kFall) * alpha_, kLeastAlpha);
    }
    failures_ = 0;
    pose(Eigen::VectorXd(inner_->r()));
  }

  State fail() {
    alpha_ = std::min(kRise * alpha_, kLargestAlpha);
    pose(best_);
    return ++failures_ < kMostFailures ? State::kRunning : State::kStalled;
  }

  const Problem& problem_;
  std::unique_ptr<ProximalInner> inner_;
  Settings settings_;
  double alpha_ = 0.0;
  Eigen::VectorXd centre_, best_;
  double best_eta_ = std::numeric_limits<double>::infinity();
  int iterations_ = 0;  // from this centre
  int failures_ = 0;    // proximal steps in a row that were not solved
  double work_s_ = 0.0;
};

std::unique_ptr<ProximalInner> make_inner(const std::string& name, const Problem& problem) {
  using Function = NewtonSettings::Function;
  if (name == "gs") return make_proximal_gauss_seidel(problem);
  return make_proximal_newton_inner(
      problem, name == "fb" ? Function::kFischerBurmeister : Function::kAlartCurnier);
}

Solver make(const Method& method, const Values& values) {
  const std::string inner = std::get<std::string>(values.at("inner"));
  const Settings settings{std::get<double>(values.at("weight")),
                          std::get<double>(values.at("accuracy"))};
  const auto refuses = [inner](const Problem& problem) -> std::optional<std::string> {
    if (auto why = refuse_zero_delassus(problem)) return why;
    return inner == "gs" ? gauss_seidel_refuses(problem, {}) : std::nullopt;
  };
  const auto iteration = [inner, settings](const Problem& problem) {
    return std::make_unique<ProximalPoint>(problem, make_inner(inner, problem), settings);
  };
  return make_iterative_solver(method, values, refuses, iteration);
}

}  // namespace

Method proximal_point() {
  Method method{
      .name = "ppa",
      .kind = Kind::kMethod,
      .summary = "proximal point outside, Newton or Gauss-Seidel inside",
      .source =
          "Rockafellar, SIAM J. Control Optim. 14(5) (1976), criterion (B); PPA-NSN of Acary, "
          "Bremond, Huber, RR-9118 (2017) (neither checked); the weight's rules are ours",
      .parameters = {{.name = "inner",
                      .fallback = std::string("ac"),
                      .choices = {"ac", "fb", "gs"},
                      .doc = "Alart-Curnier Newton, Fischer-Burmeister Newton, or sweeps "
                             "of Gauss-Seidel"},
                     {.name = "weight",
                      .fallback = Settings{}.weight,
                      .low = 1e-10,
                      .high = 1e3,
                      .doc = "first weight alpha, as a share of lambda_i [-]"},
                     {.name = "accuracy",
                      .fallback = Settings{}.accuracy,
                      .low = 1e-6,
                      .high = 0.9,
                      .doc = "inner tolerance, as a share of the step made [-]"}},
      .make = {}};
  method.make = [method](const Values& values) { return make(method, values); };
  return method;
}

}  // namespace conebench::solvers
