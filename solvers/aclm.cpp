#include "solvers/aclm.h"

#include <algorithm>
#include <limits>

#include "solvers/anderson.h"
#include "solvers/certificate.h"
#include "solvers/ssnal.h"

namespace conebench::solvers {
namespace {

using problems::Problem;

// An outer step that leaves this multiple of the least residual so far restarts Anderson.
constexpr double kGrowth = 2.0;
// Inner iterations on one t before the next t is tried all the same.
constexpr int kInnerIterations = 60;
// Iterations without a fall of eta to kProgress of what it was, before a proof that there is no
// solution is looked for beside them, one step of the search an iteration.
constexpr int kPatience = 100;
constexpr double kProgress = 0.5;
// eta of one t as a share of that before: a fixed point that contracts less is at its end.
constexpr double kContraction = 0.9;
// Steps of that search.
constexpr int kSearch = 200;

class Aclm final : public Iteration {
 public:
  Aclm(const Problem& problem, std::unique_ptr<ConvexIteration> inner, const AclmSettings& settings)
      : problem_(problem),
        settings_(settings),
        inner_(std::move(inner)),
        anderson_(settings.anderson),
        convex_(std::all_of(problem.cones().begin(), problem.cones().end(),
                            [](const problems::Cone& cone) { return cone.theta == 0.0; })) {}

  void start(const Eigen::VectorXd& r) override {
    best_ = r;
    pose_best();
    measure();
    end_ = State::kRunning;
    search_.reset();
    searched_ = idle_ = 0;
    eta_at_stall_ = std::numeric_limits<double>::infinity();
    eta_before_idling_ = best_eta_;
  }

  State advance() override {
    if (end_ == State::kRunning) end_ = step();
    if (end_ == State::kRunning && !out_of_patience()) return end_;
    if (searched_ == kSearch) return end_;
    if (!search_) search_ = std::make_unique<InfeasibilitySearch>(problem_);
    ++searched_;
    const State found = search_->advance();
    work_s_ += search_->step_work_s();
    if (found == State::kInfeasible) return found;
    if (found != State::kRunning) searched_ = kSearch;
    return searched_ == kSearch ? end_ : State::kRunning;
  }

  const Eigen::VectorXd& r() const override { return best_; }
  double own_eta() const override { return best_eta_; }
  double work_s() const override { return work_s_; }
  std::vector<std::string> notes() const override { return inner_->notes(); }
  Eigen::VectorXd certificate() const override {
    return search_ ? search_->proof() : Eigen::VectorXd();
  }

 private:
  State step() {
    const double tolerance = settings_.inner * std::min(eta_, last_);
    const State state = inner_->advance(tolerance);
    work_s_ += inner_->step_work_s();
    ++inner_iterations_;
    measure();
    if (state != State::kRunning) {
      if (stalled_on_this_shift_only()) {
        next_shift();
      } else if (best_eta_ <= kProgress * last_best_) {
        pose_best();
      } else {
        return state;
      }
    } else if (!convex_ &&
               (inner_->error() <= tolerance || inner_iterations_ >= kInnerIterations)) {
      next_shift();
    }
    return State::kRunning;
  }

  // The inner method stopped at an error well below eta: what eta lacks is the next t, not a better
  // answer for this one. So it may go on for as long as eta falls from one such stop to the next.
  bool stalled_on_this_shift_only() {
    if (convex_ || !(inner_->error() <= kProgress * eta_)) return false;
    if (!(eta_ <= kContraction * eta_at_stall_)) return false;
    eta_at_stall_ = eta_;
    return true;
  }

  // From the best iterate so far, with its own t.
  void pose_best() {
    const Eigen::VectorXd u = problem_.rate(best_);
    shift_ = de_saxce_shift(problem_, u);
    anderson_.restart();
    least_ = std::numeric_limits<double>::infinity();
    last_ = best_eta_ = convex_error(problem_, shift_, best_, u);
    last_best_ = best_eta_;
    inner_->pose(shift_, Eigen::VectorXd(best_));
    inner_iterations_ = 0;
  }

  bool out_of_patience() {
    if (best_eta_ <= kProgress * eta_before_idling_) {
      eta_before_idling_ = best_eta_;
      idle_ = 0;
    }
    return ++idle_ > kPatience;
  }

  void measure() {
    mapped_ = de_saxce_shift(problem_, inner_->u());
    eta_ = convex_error(problem_, mapped_, inner_->r(), inner_->u());
    if (!(eta_ < best_eta_)) return;
    best_eta_ = eta_;
    best_ = inner_->r();
  }

  void next_shift() {
    const double residual = (mapped_ - shift_).norm();
    if (residual > kGrowth * least_) {
      anderson_.restart();
      least_ = residual;
      shift_ = mapped_;
    } else {
      least_ = std::min(least_, residual);
      shift_ = anderson_.next(shift_, mapped_).cwiseMax(0.0);
    }
    last_ = eta_;
    last_best_ = best_eta_;
    const Eigen::VectorXd r = inner_->r();
    inner_->pose(shift_, r);
    inner_iterations_ = 0;
  }

  const Problem& problem_;
  AclmSettings settings_;
  std::unique_ptr<ConvexIteration> inner_;
  Anderson anderson_;
  Eigen::VectorXd shift_, mapped_;           // t, and theta |u_t| of the inner iterate
  double eta_ = 0.0, last_ = 0.0;            // of the inner iterate; at the last change of t
  double best_eta_ = 0.0, last_best_ = 0.0;  // of best_; at the last change of t
  Eigen::VectorXd best_;
  double eta_at_stall_ = 0.0;  // at the inner method's last stop that only t could mend
  bool convex_;                // t is 0 for good
  double least_ = 0.0;         // least |mapped - shift| since Anderson restarted
  int inner_iterations_ = 0;
  double work_s_ = 0.0;
  State end_ = State::kRunning;  // how the fixed point ended
  int idle_ = 0, searched_ = 0;  // iterations without progress; steps of the search
  double eta_before_idling_ = 0.0;
  std::unique_ptr<InfeasibilitySearch> search_;
};

}  // namespace

std::unique_ptr<Iteration> make_aclm(const Problem& problem, std::unique_ptr<ConvexIteration> inner,
                                     const AclmSettings& settings) {
  return std::make_unique<Aclm>(problem, std::move(inner), settings);
}

Method make_aclm_method(std::string name, std::string summary, std::vector<Parameter> parameters,
                        std::function<MakeConvex(const Values&)> make_inner,
                        std::function<Refuses(const Values&)> refuses) {
  parameters.push_back({.name = "anderson",
                        .fallback = std::int64_t{10},
                        .low = 0,
                        .high = 100,
                        .doc = "depth of Anderson acceleration of t; 0 is the plain fixed point"});
  parameters.push_back({.name = "inner",
                        .fallback = 0.1,
                        .low = 1e-6,
                        .high = 0.9,
                        .doc = "tolerance of the convex problem, as a share of eta [-]"});
  Method method{.name = std::move(name),
                .kind = Kind::kMethod,
                .summary = std::move(summary),
                .source =
                    "Acary, Cadoux, Lemarechal, Malick, ZAMM 91(2) (2011) 155-175 (not checked); "
                    "Anderson acceleration of t: ours",
                .parameters = std::move(parameters),
                .make = {}};
  method.make = [method, make_inner = std::move(make_inner),
                 refuses = std::move(refuses)](const Values& values) {
    const AclmSettings settings{static_cast<int>(std::get<std::int64_t>(values.at("anderson"))),
                                std::get<double>(values.at("inner"))};
    auto make = [settings, inner = make_inner(values)](const Problem& problem) {
      return make_aclm(problem, inner(problem), settings);
    };
    return make_iterative_solver(method, values, refuses(values), make);
  };
  return method;
}

Method aclm() {
  Method method = make_aclm_method(
      "aclm", "fixed point on the De Saxce term; inner semismooth Newton, augmented Lagrangian", {},
      [](const Values&) { return MakeConvex(make_ssnal); },
      [](const Values&) -> Refuses { return refuse_zero_delassus; });
  method.source +=
      "; inner: Rockafellar, Math. Oper. Res. 1(2) (1976) 97-116; Zhao, Sun, Toh, SIAM J. Optim. "
      "20(4) (2010) 1737-1765 (neither checked)";
  return method;
}

}  // namespace conebench::solvers
