#include "solvers/ipm.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <vector>

#include "solvers/aclm.h"
#include "solvers/gs.h"
#include "solvers/gs_coupling.h"
#include "solvers/interior_point.h"

namespace conebench::solvers {
namespace {

using problems::Problem;
using State = Iteration::State;
using Form = ScaledSystem::Form;

std::unique_ptr<ConvexIteration> make_interior_point(const Problem& problem, Form form) {
  return std::make_unique<InteriorPoint>(problem, form, false);
}

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// How far from the cones' boundaries an attempt begins (InteriorPoint::start_at), the first at the
// guess, the others at r = 0, and its smoothing: other paths, where one is trapped.
struct Attempt {
  double start, smoothing;
};
constexpr Attempt kAttempts[] = {{1.0, 0.1}, {10.0, 0.1}, {1.0, 1.0}};
// An attempt whose gap has not halved in so many iterations is trapped.
constexpr int kPatience = 5;
// A trap below this eta is rounding: there the fixed point goes on.
constexpr double kRounding = 1e-6;
// Sweeps from an iterate take this share of its work, but are at least one and at most so many.
constexpr double kSweepShare = 0.15;
constexpr int kMostSweeps = 20;
// They begin where eta has fallen by this factor since the last ones, whichever attempt's.
constexpr double kSweepFall = 0.25;
// An iterate within so many times the tolerance gets so many rounds of the most sweeps.
constexpr double kWithinReach = 20.0;
constexpr int kLastRounds = 2;

// Not where W would have to be formed for them.
bool can_sweep(const Problem& problem) {
  return !problem.is_primal() || has_velocity_form(problem);
}

class CoulombInteriorPoint final : public Iteration {
 public:
  CoulombInteriorPoint(const Problem& problem, double tol)
      : problem_(problem), tol_(tol), direct_(problem, Form::kAuto, true) {
    if (can_sweep(problem)) sweeps_ = make_gauss_seidel(problem);
  }

  void start(const Eigen::VectorXd& r) override {
    fixed_point_.reset();
    best_ = guess_ = r;
    eta_ = eta_of(r);
    if (std::isnan(eta_)) eta_ = kInfinity;  // of a guess whose squares overflow
    attempt_ = 0;
    swept_eta_ = kInfinity;
    attempt();
  }

  State advance() override {
    if (problem_.cone_count() == 0) return State::kStalled;
    if (fixed_point_) {
      const double before = fixed_point_->work_s();
      const State state = fixed_point_->advance();
      const double eta = fixed_point_->own_eta();
      keep_best(eta, fixed_point_->r());
      if (eta < fixed_point_eta_) sweep(fixed_point_->r(), fixed_point_->work_s() - before);
      fixed_point_eta_ = std::min(fixed_point_eta_, eta);
      return state;
    }
    const State state = direct_.advance(0.0);
    work_s_ += direct_.step_work_s();
    keep_best(direct_.eta(), direct_.r());
    sweep(direct_.r(), direct_.step_work_s());
    if (state == State::kRunning && !trapped()) return state;
    if (++attempt_ < std::size(kAttempts) && eta_ > kRounding) {
      attempt();
    } else {
      fixed_point_ = make_aclm(problem_, make_interior_point(problem_, Form::kAuto), {});
      fixed_point_->start(best_);
      fixed_point_eta_ = kInfinity;
    }
    return State::kRunning;
  }

  const Eigen::VectorXd& r() const override { return best_; }
  double own_eta() const override { return eta_; }
  double work_s() const override { return work_s_ + (fixed_point_ ? fixed_point_->work_s() : 0.0); }
  Eigen::VectorXd certificate() const override {
    return fixed_point_ ? fixed_point_->certificate() : Eigen::VectorXd();
  }
  std::vector<std::string> notes() const override {
    std::vector<std::string> notes{fmt::format("last smoothing eps = {:.2g}", direct_.smoothing())};
    if (attempt_ > 0) notes.push_back("trapped in its first attempt");
    if (fixed_point_) notes.push_back("went on as aclm-ipm from its best iterate");
    return notes;
  }

 private:
  void attempt() {
    direct_.start_at(kAttempts[attempt_].start);
    direct_.smooth(kAttempts[attempt_].smoothing);
    direct_.pose({}, attempt_ == 0 ? guess_ : Eigen::VectorXd::Zero(problem_.rows()).eval());
    gaps_.assign(1, direct_.gap());
  }

  bool trapped() {
    gaps_.push_back(direct_.gap());
    if (gaps_.size() <= kPatience) return false;
    return !(gaps_.back() <= 0.5 * gaps_[gaps_.size() - 1 - kPatience]);
  }

  // The iterate balances forces everywhere and smooths the law of every cone; sweeps sharpen it,
  // eta to a tenth and less. More of them only spoil it again.
  void sweep(const Eigen::VectorXd& r, double work_s) {
    if (!sweeps_ || !r.allFinite()) return;
    const double eta = eta_of(r);
    const bool within_reach = eta <= kWithinReach * tol_;
    if (!within_reach && !(eta <= kSweepFall * swept_eta_)) return;
    swept_eta_ = eta;
    const double affordable = kSweepShare * work_s / gauss_seidel_sweep_work_s(problem_);
    const int count = within_reach
                          ? kMostSweeps
                          : static_cast<int>(std::clamp(affordable, 1.0, double{kMostSweeps}));
    const double before = sweeps_->work_s();
    sweeps_->start(r);
    for (int round = 0; round < (within_reach ? kLastRounds : 1) && eta_ > tol_; ++round) {
      for (int k = 0; k < count; ++k) {
        if (sweeps_->advance() != State::kRunning) break;
      }
      keep_best(eta_of(sweeps_->r()), sweeps_->r());
    }
    work_s_ += sweeps_->work_s() - before;
  }

  double eta_of(const Eigen::VectorXd& r) const {
    const Eigen::VectorXd u = problem_.rate(r);
    return convex_error(problem_, de_saxce_shift(problem_, u), r, u);
  }

  void keep_best(double eta, const Eigen::VectorXd& r) {
    if (!(eta < eta_)) return;
    eta_ = eta;
    best_ = r;
  }

  const Problem& problem_;
  double tol_;
  InteriorPoint direct_;
  std::unique_ptr<Iteration> sweeps_;       // where they need no W
  std::unique_ptr<Iteration> fixed_point_;  // once the direct method is trapped
  Eigen::VectorXd guess_, best_;
  double eta_ = 0.0, fixed_point_eta_ = kInfinity;  // the least of either
  double swept_eta_ = kInfinity;                    // of the iterate last swept from
  double work_s_ = 0.0;                             // of the direct method and the sweeps
  std::size_t attempt_ = 0;
  std::vector<double> gaps_;  // of this attempt
};

Form form_of(const Values& values) {
  const std::string form = std::get<std::string>(values.at("form"));
  return form == "kkt" ? Form::kKkt : form == "normal" ? Form::kNormal : Form::kAuto;
}

std::vector<Parameter> form_parameter() {
  return {{.name = "form",
           .fallback = std::string("auto"),
           .choices = {"auto", "normal", "kkt"},
           .doc = "linear system: normal equations, quasidefinite, or the sparser of the two"}};
}

}  // namespace

std::unique_ptr<Iteration> make_ipm(const Problem& problem, double tol) {
  return std::make_unique<CoulombInteriorPoint>(problem, tol);
}

Method interior_point() {
  Method method{.name = "ipm",
                .kind = Kind::kMethod,
                .summary = "primal-dual interior point, the De Saxce term as an unknown",
                .source =
                    "Nesterov, Todd, SIAM J. Optim. 8(2) (1998); Mehrotra, SIAM J. Optim. 2(4) "
                    "(1992); the De Saxce term as an unknown: an idea of Acary, Armand, Nguyen, "
                    "Shpakovych (2022) (none checked; smoothing and globalisation are ours)",
                .parameters = {},
                .make = {}};
  method.make = [method](const Values& values) {
    auto run = [](const Problem& problem, const Stop& stop, const Eigen::VectorXd& guess,
                  Monitor& monitor) {
      CoulombInteriorPoint iteration(problem, stop.tol);
      return drive(iteration, problem, stop, guess, monitor);
    };
    return make_checked_solver(method, values, refuse_zero_delassus, run);
  };
  return method;
}

Method aclm_interior_point() {
  Method method = make_aclm_method(
      "aclm-ipm", "fixed point on the De Saxce term; inner primal-dual interior point",
      form_parameter(),
      [](const Values& values) -> MakeConvex {
        return [form = form_of(values)](const Problem& problem) {
          return make_interior_point(problem, form);
        };
      },
      [](const Values& values) -> Refuses {
        return [form = form_of(values)](const Problem& problem) -> std::optional<std::string> {
          if (form == Form::kKkt && !problem.is_primal()) return "form=kkt needs M and H";
          return refuse_zero_delassus(problem);
        };
      });
  method.source +=
      "; inner: Nesterov, Todd, SIAM J. Optim. 8(2) (1998); Mehrotra, SIAM J. Optim. 2(4) (1992) "
      "(neither checked)";
  return method;
}

}  // namespace conebench::solvers
