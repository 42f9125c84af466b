#include "harness/survey/attempt.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <cstring>
#include <limits>

#include "problems/error.h"
#include "problems/residual.h"
#include "solvers/forked.h"

namespace conebench::harness {
namespace {

using problems::Problem;
using solvers::Status;

// What the child leaves behind, beside r.
struct Trace {
  Attempt::End end;  // kDied until it says otherwise
  Status status;
  std::int64_t iterations;
  Eigen::Index r_size;
  double wall_s;
  char text[160];
};

void solve_in_child(const solvers::Solver& solver, const Problem& standard,
                    const solvers::Request& request, Trace& trace, std::span<double> r) {
  const auto start = std::chrono::steady_clock::now();
  auto threw = [&](Attempt::End end, const char* text) {
    std::strncpy(trace.text, text, sizeof trace.text - 1);
    trace.end = end;
  };
  try {
    const solvers::Result result = solver.solve(standard, request);
    trace.status = result.status;
    trace.iterations = result.iterations;
    trace.r_size = result.r.size();
    if (result.r.size() == standard.rows()) std::copy(result.r.begin(), result.r.end(), r.begin());
    trace.end = Attempt::End::kReturned;
  } catch (const problems::InputError& error) {
    threw(Attempt::End::kInputError, error.what());
  } catch (const std::exception& error) {
    threw(Attempt::End::kThrew, error.what());
  } catch (...) {
    threw(Attempt::End::kThrew, "not a std::exception");
  }
  trace.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

Attempt attempt(const solvers::Solver& solver, const Problem& problem, const solvers::Stop& stop,
                const Eigen::VectorXd& guess) {
  const Problem standard = problem.shifted();
  Attempt result;
  if (!solver.supports(standard)) {
    result.end = Attempt::End::kRefused;
    return result;
  }
  const solvers::SharedArray<Trace> shared(1);
  const solvers::SharedArray<double> r(static_cast<std::size_t>(standard.rows()) + 1);
  Trace& trace = shared[0];
  trace.end = Attempt::End::kDied;
  const solvers::ProcessEnd end = solvers::run_forked(
      [&] {
        solve_in_child(solver, standard, {stop, guess, nullptr}, trace, r.all());
        return 0;
      },
      stop.time_limit_s + Attempt::kPatience_s);
  result.end = trace.end;
  result.status = trace.status;
  result.iterations = trace.iterations;
  result.wall_s = trace.wall_s;
  result.text = trace.end == Attempt::End::kDied ? describe(end) : trace.text;
  if (trace.end != Attempt::End::kReturned) return result;
  if (trace.r_size != standard.rows()) {
    result.eta = std::numeric_limits<double>::infinity();
    return result;
  }
  result.r = Eigen::Map<const Eigen::VectorXd>(r.all().data(), standard.rows());
  result.eta = problems::evaluate_eta(standard, result.r);
  return result;
}

std::string fault(const Attempt& attempt, const Problem& problem, const solvers::Stop& stop) {
  switch (attempt.end) {
    case Attempt::End::kRefused:
      return "";
    case Attempt::End::kInputError:
    case Attempt::End::kThrew:
      return "threw: " + attempt.text;
    case Attempt::End::kDied:
      return "died: " + attempt.text;
    case Attempt::End::kReturned:
      break;
  }
  if (attempt.r.size() != problem.rows()) return "r has the wrong length";
  if (!attempt.r.allFinite()) return "r is not finite";
  if (attempt.wall_s > stop.time_limit_s + Attempt::kGrace_s) {
    return fmt::format("took {:.1f} s of {:.1f} s", attempt.wall_s, stop.time_limit_s);
  }
  const bool claims = attempt.status == Status::kConverged;
  if (stop.test == solvers::StopTest::kCommon && claims != (attempt.eta <= stop.tol)) {
    return fmt::format("says {} at eta = {:.3g}", to_string(attempt.status), attempt.eta);
  }
  return "";
}

}  // namespace conebench::harness
