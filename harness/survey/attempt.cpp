#include "harness/survey/attempt.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <cstring>

#include "problems/error.h"
#include "problems/residual.h"
#include "solvers/certificate.h"
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
  Eigen::Index r_size, certificate_size;
  double wall_s;
  char text[160];
};

void solve_in_child(const solvers::Solver& solver, const Problem& standard,
                    const solvers::Request& request, Trace& trace, std::span<double> r,
                    std::span<double> certificate) {
  const auto start = std::chrono::steady_clock::now();
  auto threw = [&](Attempt::End end, const char* text) {
    std::strncpy(trace.text, text, sizeof trace.text - 1);
    trace.end = end;
  };
  try {
    const solvers::Result result = solver.solve(standard, request);
    trace.status = result.status;
    trace.iterations = result.iterations;
    auto keep = [&](const Eigen::VectorXd& x, std::span<double> kept) {
      if (x.size() == standard.rows()) std::copy(x.begin(), x.end(), kept.begin());
      return x.size();
    };
    trace.r_size = keep(result.r, r);
    trace.certificate_size = keep(result.certificate, certificate);
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
  const auto rows = static_cast<std::size_t>(standard.rows());
  const solvers::SharedArray<double> r(rows + 1), certificate(rows + 1);  // never empty
  Trace& trace = shared[0];
  trace.end = Attempt::End::kDied;
  const solvers::ProcessEnd end = solvers::run_forked(
      [&] {
        solve_in_child(solver, standard, {stop, guess, nullptr}, trace, r.all(), certificate.all());
        return 0;
      },
      stop.time_limit_s + Attempt::kPatience_s);
  result.end = trace.end;
  result.wall_s = trace.wall_s;
  result.text = trace.end == Attempt::End::kDied ? describe(end) : trace.text;
  if (trace.end != Attempt::End::kReturned) return result;
  result.status = trace.status;
  result.iterations = trace.iterations;
  auto kept = [&](const solvers::SharedArray<double>& array, Eigen::Index size) {
    return size == standard.rows() ? Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(
                                         array.all().data(), standard.rows()))
                                   : Eigen::VectorXd();
  };
  result.r = kept(r, trace.r_size);
  result.certificate = kept(certificate, trace.certificate_size);
  if (trace.r_size == standard.rows()) result.eta = problems::evaluate_eta(standard, result.r);
  return result;
}

std::string ending(const Attempt& attempt) {
  switch (attempt.end) {
    case Attempt::End::kReturned:
      return std::string(to_string(attempt.status));
    case Attempt::End::kInputError:
      return "InputError";
    case Attempt::End::kThrew:
      return "threw";
    case Attempt::End::kDied:
      return "died";
    case Attempt::End::kRefused:
      return "refused";
  }
  return "unknown";
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
  if (attempt.status == Status::kInfeasible &&
      !solvers::proves_infeasible(problem.shifted(), attempt.certificate)) {
    return "says infeasible without a proof";
  }
  return "";
}

}  // namespace conebench::harness
