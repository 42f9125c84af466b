#include "solvers/auto.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "problems/residual.h"
#include "solvers/aclm.h"
#include "solvers/admm.h"
#include "solvers/apgd.h"
#include "solvers/gs.h"
#include "solvers/ipm.h"
#include "solvers/newton/newton.h"
#include "solvers/prox_newton.h"
#include "solvers/ssnal.h"

namespace conebench::solvers {
namespace {

using problems::Cone;
using problems::Problem;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kTurnGrowth = 0.5;  // a turn, as a share of the work that the lane has done
constexpr int kFirstSweeps = 30;     // of Gauss-Seidel
constexpr int kFirstApgdSteps = 100;
constexpr int kFirstAdmmSteps = 10;
constexpr int kPartialSweeps = 10;   // of Gauss-Seidel, between two full ones
constexpr double kNoPromise = 4.0;   // times the work done, where a turn brought nothing
constexpr double kHesitation = 2.0;  // times what the lane's whole record promises, likewise;
constexpr double kDoubt = 1.0;       // times the work done at least
constexpr double kEarlyDoubt = 5.0;  // times the work promised where the fall of eta says little
constexpr double kLooseTol = 1e-4;   // from here on
constexpr double kProgress = 0.9;    // less of a fall in eta is nothing
constexpr double kRise = 4.0;        // above its least a lane's eta says that it is lost

// One method, its iterate and its record.
struct Lane {
  std::string name;
  MakeIteration make;
  double first_promise;      // work to finish before it has run, in sweeps of Gauss-Seidel
  std::int64_t first_steps;  // of its first turn, at least
  std::int64_t usual_steps;  // of a run that succeeds without trouble
  double handover;           // a start is taken from others when better than its own by this factor
  double believed = kInfinity;  // eta from which on its progress says when it will finish

  std::unique_ptr<Iteration> iteration{};
  double from = kInfinity;  // eta at its first start
  double eta = kInfinity;   // at the end of its last turn
  double best = kInfinity;  // eta at the end of any turn
  double done_s = 0.0;      // work in this run
  double promise_s = 0.0;   // work that is left
  std::int64_t steps = 0;
  bool over = false;  // diverged or stalled at the iterate it would start from again
};

constexpr GaussSeidelSettings kSkipping{.partial_sweeps = kPartialSweeps};

// Every lane but Gauss-Seidel refuses W = 0.
std::optional<std::string> automatic_refuses(const Problem& problem) {
  const auto zero = refuse_zero_delassus(problem);
  const auto sweeps = gauss_seidel_refuses(problem, kSkipping);
  if (!zero || !sweeps) return std::nullopt;
  return *zero + ", which only gs takes, and gs does not take this problem: " + *sweeps;
}

// Lane::first_promise of each, usual steps of apgd and ipm, Lane::handover of gs, Lane::believed of
// apgd.
struct Expectations {
  double gs, apgd, prox_newton, newton_ac, ipm, aclm;
  std::int64_t apgd_steps = 1000;
  double gs_handover = 0.1;
  double admm = kInfinity;  // never
  double apgd_believed = kInfinity;
  std::int64_t ipm_steps = 30;
};
constexpr double kLooseAdmm = 1000.0;
constexpr Expectations kOnGrid{.gs = 6000.0,
                               .apgd = 0.0,
                               .prox_newton = 3000.0,
                               .newton_ac = 60000.0,
                               .ipm = 3000.0,
                               .aclm = 60000.0,
                               .apgd_steps = 300,
                               .ipm_steps = 15};
// apgd solves the easy ones at once, and never the hard ones. To this tolerance; ipm and the steps
// of apgd in proportion to the decades of another.
constexpr double kPlaneTol = 1e-5;
constexpr Expectations kOnPlaneGrid{.gs = 15000.0,
                                    .apgd = 0.0,
                                    .prox_newton = 2000.0,
                                    .newton_ac = 30000.0,
                                    .ipm = 400.0,
                                    .aclm = 15000.0,
                                    .apgd_steps = 150,
                                    .apgd_believed = 1e-3,
                                    .ipm_steps = 20};
// The guess is right in what sweeps are slow at, which what apgd leaves is not.
constexpr Expectations kLooselyOnGrid{100.0, 0.0, 300.0, 15000.0, 1200.0, 12000.0, 300, 0.0};
constexpr Expectations kLooselyOnPlaneGrid{.gs = 100.0,
                                           .apgd = 0.0,
                                           .prox_newton = 500.0,
                                           .newton_ac = 15000.0,
                                           .ipm = 500.0,
                                           .aclm = 12000.0,
                                           .apgd_steps = 300,
                                           .gs_handover = 0.0,
                                           .ipm_steps = 6};
// Where W is singular for sure, the last three need more and dearer factorisations.
constexpr Expectations kSingular{100.0, 0.0, 1000.0, 15000.0, 20000.0, 15000.0};
constexpr Expectations kOtherwise{100.0, 0.0, 1000.0, 1000.0, 1500.0, 3000.0};
// Of so few, a factorisation costs a few sweeps.
constexpr int kFewCones = 60;
constexpr double kCheapNewton = 0.3;
constexpr std::int64_t kFewApgdSteps = 500;

Expectations expectations(const Problem& problem, double tol) {
  const bool loose = tol >= kLooseTol;
  // Cones of a continuum touch the nodes of their cells, more dofs than two rigid bodies have;
  // their stresses have three entries in the plane, six in space.
  const double entries =
      problem.is_primal() ? static_cast<double>(problem.H().nonZeros()) / problem.rows() : 0.0;
  if (entries > 12.0) {
    const bool in_space =
        std::ranges::any_of(problem.cones(), [](const Cone& cone) { return cone.dim > 3; });
    if (in_space) return loose ? kLooselyOnGrid : kOnGrid;
    if (loose) return kLooselyOnPlaneGrid;
    Expectations expected = kOnPlaneGrid;
    const double decades = std::log(std::max(tol, 1e-12)) / std::log(kPlaneTol);
    expected.ipm *= decades;
    expected.apgd_steps = std::lround(decades * static_cast<double>(expected.apgd_steps));
    return expected;
  }
  const bool singular = problem.is_primal() && problem.rows() > problem.dofs();
  Expectations expected = singular ? kSingular : kOtherwise;
  if (loose) expected.admm = kLooseAdmm;
  if (problem.cone_count() <= kFewCones) {
    expected.newton_ac *= kCheapNewton;
    expected.apgd_steps = kFewApgdSteps;
  }
  return expected;
}

class Automatic final : public Iteration {
 public:
  Automatic(const Problem& problem, double tol) : problem_(problem), tol_(tol) {
    const Expectations expected = expectations(problem, tol);
    if (!gauss_seidel_refuses(problem, kSkipping)) {
      lanes_.push_back({"gs", [](const Problem& p) { return make_gauss_seidel(p, kSkipping); },
                        expected.gs, kFirstSweeps, 0, expected.gs_handover});
    }
    if (refuse_zero_delassus(problem)) return;
    lanes_.push_back({"apgd", make_apgd, expected.apgd, kFirstApgdSteps, expected.apgd_steps, 0.0,
                      expected.apgd_believed});
    if (expected.admm < kInfinity) {
      lanes_.push_back({"admm", make_admm, expected.admm, kFirstAdmmSteps, 300, 0.0});
    }
    lanes_.push_back({"prox-newton", make_proximal_newton, expected.prox_newton, 1, 80, 0.1});
    lanes_.push_back({"newton-ac", [](const Problem& p) { return make_newton(p, {}); },
                      expected.newton_ac, 1, 60, 0.0});
    lanes_.push_back({"ipm", [tol](const Problem& p) { return make_ipm(p, tol); }, expected.ipm, 1,
                      expected.ipm_steps, 0.0});
    lanes_.push_back({"aclm", [](const Problem& p) { return make_aclm(p, make_ssnal(p), {}); },
                      expected.aclm, 1, 60, 0.1});
  }

  void start(const Eigen::VectorXd& r) override {
    guess_ = best_ = r;
    guess_eta_ = best_eta_ = problems::evaluate_eta(problem_, r);
    for (Lane& lane : lanes_) {
      lane.eta = lane.best = kInfinity;
      lane.done_s = 0.0;
      lane.steps = 0;
      lane.over = false;
    }
    begin_turn(first_lane());
  }

  State advance() override {
    Lane& lane = lanes_[current_];
    const double before = lane.iteration->work_s();
    const State state = lane.iteration->advance();
    const double work = lane.iteration->work_s() - before;
    ++lane.steps;
    turn_s_ += work;
    total_s_ += work;
    lane.done_s += work;
    if (state == State::kInfeasible) return state;
    if (state == State::kRunning && !turn_is_over(lane)) return State::kRunning;
    return end_turn(lane, state);
  }

  const Eigen::VectorXd& r() const override { return lanes_[current_].iteration->r(); }
  double own_eta() const override { return lanes_[current_].iteration->own_eta(); }
  double work_s() const override { return total_s_; }
  Eigen::VectorXd certificate() const override { return lanes_[current_].iteration->certificate(); }

  std::vector<std::string> notes() const override {
    std::string text = "turns:";
    for (const Lane& lane : lanes_) {
      if (lane.steps == 0) continue;
      text += fmt::format(" {} {} steps,", lane.name, lane.steps);
    }
    text.back() = ';';
    return {text + " last " + lanes_[current_].name};
  }

 private:
  // Work of one sweep of Gauss-Seidel, roughly.
  double sweep_s() const { return 1e-7 * problem_.cone_count(); }

  bool turn_is_over(const Lane& lane) const {
    if (lane.steps < lane.first_steps) return false;
    return turn_s_ >= kTurnGrowth * (lane.done_s - turn_s_);
  }

  std::size_t first_lane() const {
    const auto first = std::min_element(
        lanes_.begin(), lanes_.end(),
        [](const Lane& a, const Lane& b) { return a.first_promise < b.first_promise; });
    return static_cast<std::size_t>(first - lanes_.begin());
  }

  void begin_turn(std::size_t next) {
    current_ = next;
    Lane& lane = lanes_[next];
    turn_s_ = 0.0;
    if (!lane.iteration) lane.iteration = lane.make(problem_);
    if (lane.steps == 0) {
      lane.from = lane.handover > 0.0 ? best_eta_ : guess_eta_;
      lane.iteration->start(lane.handover > 0.0 ? best_ : guess_);
    } else if (best_eta_ < lane.handover * lane.eta) {
      lane.iteration->start(best_);
    }
    turn_from_ = std::min(lane.eta, best_eta_);
  }

  State end_turn(Lane& lane, State state) {
    lane.eta = problems::evaluate_eta(problem_, lane.iteration->r());
    lane.best = std::min(lane.best, lane.eta);
    if (lane.eta < best_eta_) {
      best_eta_ = lane.eta;
      best_ = lane.iteration->r();
    }
    if (state != State::kRunning) {
      if (lane.eta <= tol_) return state;  // at a solution: no other lane takes over
      lane.over = true;
      lane.promise_s = kInfinity;
    } else if (lane.eta <= kProgress * turn_from_) {
      lane.promise_s = at_the_rate(turn_s_, turn_from_, lane.eta);
    } else if (lane.eta > kRise * lane.best) {
      lane.promise_s = kNoPromise * lane.done_s;
    } else {
      lane.promise_s = std::clamp(kHesitation * at_the_rate(lane.done_s, lane.from, lane.best),
                                  kDoubt * lane.done_s, kNoPromise * lane.done_s);
    }
    if (state == State::kRunning && lane.steps < lane.usual_steps) {
      const double usual = static_cast<double>(lane.usual_steps) / static_cast<double>(lane.steps);
      lane.promise_s = std::min(lane.promise_s, (usual - 1.0) * lane.done_s);
    }
    if (lane.eta > lane.believed) lane.promise_s *= kEarlyDoubt;
    return choose();
  }

  // The work to the tolerance of a lane that took eta down from one value to the other in `done_s`.
  double at_the_rate(double done_s, double from, double to) const {
    const double fall = std::log(std::min(from, 1e3) / to);
    return done_s * std::max(std::log(to / tol_), 0.0) / std::max(fall, 1e-3);
  }

  State choose() {
    std::size_t chosen = lanes_.size();
    double least = kInfinity;
    for (std::size_t k = 0; k < lanes_.size(); ++k) {
      const Lane& lane = lanes_[k];
      // What stopped may start again from a better iterate.
      const bool stuck = lane.over && !(best_eta_ < lane.handover * lane.eta);
      if (stuck) continue;
      const double promise = lane.steps == 0 ? lane.first_promise * sweep_s()
                             : lane.over     ? kNoPromise * lane.done_s
                                             : lane.promise_s;
      if (promise < least) {
        least = promise;
        chosen = k;
      }
    }
    if (chosen == lanes_.size()) return State::kStalled;
    lanes_[chosen].over = false;
    if (chosen != current_ || best_eta_ < lanes_[chosen].handover * lanes_[chosen].eta) {
      begin_turn(chosen);
    } else {
      turn_s_ = 0.0;
      turn_from_ = lanes_[chosen].eta;
    }
    return State::kRunning;
  }

  const Problem& problem_;
  double tol_;
  std::vector<Lane> lanes_;
  std::size_t current_ = 0;
  Eigen::VectorXd guess_, best_;
  double guess_eta_ = kInfinity, best_eta_ = kInfinity;
  double turn_s_ = 0.0, turn_from_ = kInfinity, total_s_ = 0.0;
};

}  // namespace

Method automatic() {
  Method method{.name = "auto",
                .kind = Kind::kMethod,
                .summary =
                    "apgd, gs, admm, prox-newton, newton-ac, ipm, aclm in turns; the one that gets "
                    "on goes on",
                .source = "ours",
                .parameters = {},
                .make = {}};
  method.make = [method](const Values& values) {
    auto run = [](const Problem& problem, const Stop& stop, const Eigen::VectorXd& guess,
                  Monitor& monitor) {
      Automatic iteration(problem, stop.tol);
      return drive(iteration, problem, stop, guess, monitor);
    };
    return make_checked_solver(method, values, automatic_refuses, run);
  };
  return method;
}

}  // namespace conebench::solvers
