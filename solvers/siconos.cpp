#include "solvers/siconos.h"

#ifdef CONEBENCH_SICONOS

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "solvers/forked.h"
#include "solvers/siconos_numerics.h"

namespace conebench::solvers {
namespace {

using problems::Cone;
using problems::Problem;

struct Entry {
  std::string name, summary;
  SiconosSolver solver;
  Kind kind = Kind::kPeer;
  std::string error{};  ///< default error evaluation of a Gauss-Seidel; empty for the others
};

std::vector<Entry> entries() {
  using S = SiconosSolver;
  return {
      {"siconos:nsgs", "Siconos: Gauss-Seidel, local Newton", S::kNsgs, Kind::kPeer, "full"},
      {"siconos:nsgs-pli", "Siconos: Gauss-Seidel, local projections", S::kNsgsPli, Kind::kPeer,
       "light"},
      {"siconos:nsn-ac", "Siconos: semismooth Newton, Alart-Curnier", S::kNsnAc},
      {"siconos:nsn-fb", "Siconos: semismooth Newton, Fischer-Burmeister", S::kNsnFb},
      {"siconos:vi-eg", "Siconos: extragradient on the variational inequality", S::kViEg},
      {"siconos:prox", "Siconos: proximal point, inner Alart-Curnier Newton", S::kProx},
      {"siconos:aclmfp", "Siconos: fixed point of Acary, Cadoux, Lemarechal, Malick", S::kAclmFp},
      {"siconos:admm", "Siconos: ADMM with restart", S::kAdmm},
      {"siconos:soclcp", "Siconos: second-order cone LCP, the associated law", S::kSoclcp,
       Kind::kModel},
  };
}

int call_in_child(const SiconosProblem& problem, const SiconosSettings& settings,
                  std::span<double> r, SiconosAnswer& answer) {
  if (!std::freopen("/dev/null", "w", stderr)) return kLeftEarly;
  run_siconos(problem, settings, r, answer);
  return 0;
}

std::optional<std::string> refuses(const Entry& entry, const Problem& problem) {
  const int dim = problem.cone_count() > 0 ? problem.cones()[0].dim : 3;
  if (dim != 3 && !(dim == 2 && entry.solver == SiconosSolver::kNsgs)) {
    return fmt::format("a cone has dimension {}, this solver of Siconos takes 3{}", dim,
                       entry.solver == SiconosSolver::kNsgs ? " or 2" : "");
  }
  for (const Cone& cone : problem.cones()) {
    if (cone.dim != dim) return "mixed dimensions, Siconos takes one";
    if (cone.theta != cone.mu && entry.kind != Kind::kModel) {
      return "theta != mu, this solver of Siconos takes Coulomb's law only";
    }
  }
  return std::nullopt;
}

// One call of Siconos, from r and into r.
struct Run {
  ProcessEnd end;
  SiconosAnswer answer;

  bool claims() const { return answer.finished && answer.info == 0; }
  // Some of its solvers do not say so when they find their test met at the start.
  bool stopped_by_own_test() const {
    return claims() || (answer.finished && answer.iterations == 0);
  }
};

Run run_in_child(const SiconosProblem& problem, const SiconosSettings& settings,
                 std::span<double> r, double limit_s) {
  const SharedArray<SiconosAnswer> answer(1);
  const ProcessEnd end =
      run_forked([&] { return call_in_child(problem, settings, r, answer[0]); }, limit_s);
  return {end, answer[0]};
}

Status status_of(const Run& run, int limit, bool own_test_decides) {
  if (run.end.timed_out) return Status::kTimeLimit;
  if (!run.answer.finished) return Status::kDiverged;
  // What it claims of the problem as posed counts only where its own test decides.
  if (run.claims()) return own_test_decides ? Status::kConverged : Status::kStalled;
  return run.answer.iterations >= limit ? Status::kIterationLimit : Status::kStalled;
}

Eigen::VectorXd friction(const Problem& problem) {
  Eigen::VectorXd mu(problem.cone_count());
  std::transform(problem.cones().begin(), problem.cones().end(), mu.begin(),
                 [](const Cone& cone) { return cone.mu; });
  return mu;
}

// Runs Siconos and, with StopTest::kCommon, runs it on with a tighter tolerance for as long as it
// meets its own test and eta is not met.
class Session {
 public:
  Session(const SiconosProblem& problem, const SiconosSettings& settings, const Stop& stop,
          const Eigen::VectorXd& guess, Monitor& monitor)
      : problem_(problem),
        settings_(settings),
        stop_(stop),
        monitor_(monitor),
        r_(static_cast<std::size_t>(guess.size())) {
    std::copy(guess.begin(), guess.end(), r_.all().begin());
    settings_.tol = stop.tol;
    result_.r = guess;
  }

  Result run() {
    const std::int64_t limit =
        std::min<std::int64_t>(settings_.max_iterations, stop_.max_iterations);
    double setup_s = monitor_.setup_s(), drive_s = 0.0;
    int runs = 0;
    while (true) {
      settings_.max_iterations = static_cast<int>(limit - result_.iterations);
      const Run run =
          run_in_child(problem_, settings_, r_.all(), stop_.time_limit_s - monitor_.elapsed_s());
      if (runs++ == 0) setup_s += run.answer.build_s;
      drive_s += run.answer.drive_s;
      if (run.answer.finished) monitor_.set_clock(setup_s, drive_s);
      judge(run);
      if (!may_go_on(run)) {
        add_note(run, runs);
        return result_;
      }
      const double share = stop_.tol / monitor_.curve().back().eta;
      settings_.tol *= std::clamp(0.5 * share, kLargestCut, kSmallestCut);
    }
  }

 private:
  // One more run asks for a tolerance between these shares of the last.
  static constexpr double kLargestCut = 1e-3, kSmallestCut = 0.1;
  // Below this, Siconos' error is rounding in any of its norms.
  static constexpr double kTightest = 1e-18;

  void judge(const Run& run) {
    result_.iterations += run.answer.iterations;
    result_.status = Status::kDiverged;
    const Eigen::Map<const Eigen::VectorXd> reached(r_.all().data(), result_.r.size());
    if (!reached.allFinite()) return;
    result_.r = reached;
    result_.status = monitor_.conclude(status_of(run, settings_.max_iterations, own_test_decides()),
                                       result_.iterations, result_.r);
  }

  // A model's claim is one of its own problem, whatever eta says.
  bool own_test_decides() const {
    return stop_.test == StopTest::kOwn || settings_.solver == SiconosSolver::kSoclcp;
  }

  bool may_go_on(const Run& run) const {
    return !own_test_decides() && result_.status == Status::kStalled && run.stopped_by_own_test() &&
           settings_.tol > kTightest && settings_.max_iterations > run.answer.iterations;
  }

  void add_note(const Run& run, int runs) {
    if (!run.answer.finished) {
      result_.notes.push_back("Siconos: " + describe(run.end) +
                              (run.end.timed_out ? "; r is as far as it got" : ""));
    } else if (stop_.test == StopTest::kCommon) {
      result_.notes.push_back(fmt::format("Siconos' own test ({}) at {:.1e}, after {} run{}",
                                          run.claims() ? "met" : "not met", settings_.tol, runs,
                                          runs > 1 ? "s, each from the last r" : ""));
    }
  }

  SiconosProblem problem_;
  SiconosSettings settings_;
  Stop stop_;
  Monitor& monitor_;
  SharedArray<double> r_;
  Result result_;
};

Result iterate(const SiconosSettings& settings, const Problem& problem, const Stop& stop,
               const Eigen::VectorXd& guess, Monitor& monitor) {
  const problems::SparseMatrix W = problem.delassus();
  const Eigen::VectorXd mu = friction(problem);
  monitor.setup_done();
  Result result;
  result.r = guess;
  if (problem.rows() == 0 || monitor.check(0, guess) == Verdict::kStop) {
    result.status = problem.rows() == 0 ? Status::kConverged : monitor.status();
    return result;
  }
  return Session({W, problem.q(), mu, problem.cones()[0].dim}, settings, stop, guess, monitor)
      .run();
}

Solver make(const Method& method, const Entry& entry, const Values& values) {
  SiconosSettings settings;
  settings.solver = entry.solver;
  settings.max_iterations = static_cast<int>(std::get<std::int64_t>(values.at("max_iterations")));
  if (!entry.error.empty() && std::get<std::string>(values.at("error")) == "light") {
    settings.error = SiconosError::kLight;
  }
  auto run = [settings](const Problem& problem, const Stop& stop, const Eigen::VectorXd& guess,
                        Monitor& monitor) {
    return iterate(settings, problem, stop, guess, monitor);
  };
  return make_checked_solver(
      method, values, [entry](const Problem& problem) { return refuses(entry, problem); }, run);
}

Method method_of(const Entry& entry) {
  Method method{.name = entry.name,
                .kind = entry.kind,
                .summary = entry.summary,
                .source = "Siconos Numerics 4.4, a library of its own",
                .parameters = {{.name = "max_iterations",
                                .fallback = std::int64_t{1'000'000},
                                .low = 1,
                                .high = 2e9,
                                .doc = "of Siconos' outermost loop; its own default is 200 to "
                                       "20000 [-]"}},
                .make = {}};
  if (!entry.error.empty()) {
    method.parameters.push_back(
        {.name = "error",
         .fallback = entry.error,
         .choices = {"full", "light"},
         .doc = "when Siconos' error is computed: every sweep, or (light) once the change of r is "
                "small"});
  }
  method.make = [method, entry](const Values& values) { return make(method, entry, values); };
  return method;
}

}  // namespace

std::vector<Method> siconos_methods() {
  std::vector<Method> methods;
  for (const Entry& entry : entries()) methods.push_back(method_of(entry));
  return methods;
}

}  // namespace conebench::solvers

#else

namespace conebench::solvers {

std::vector<Method> siconos_methods() { return {}; }

}  // namespace conebench::solvers

#endif
