#include "solvers/method.h"

#include <fmt/format.h>

#include "problems/error.h"
#include "solvers/linear/threads.h"

namespace conebench::solvers {
namespace {

using problems::Problem;
using problems::require;

Eigen::VectorXd starting_point(const Problem& problem, const Eigen::VectorXd& guess) {
  if (guess.size() == 0) return Eigen::VectorXd::Zero(problem.rows());
  require(guess.size() == problem.rows(), problem.name(), "the guess has ", guess.size(),
          " entries, expected ", problem.rows(), " or none");
  require(guess.allFinite(), problem.name(), "the guess holds a NaN or an infinity");
  return guess;
}

Result unsupported(const Problem& problem, std::string why) {
  Result result;
  result.r = Eigen::VectorXd::Zero(problem.rows());
  result.notes.push_back(std::move(why));
  return result;
}

void note_asymmetry(const Problem& problem, Result& result) {
  const double asymmetry = problems::asymmetry(problem.W());
  if (asymmetry <= 1e-12) return;
  result.notes.push_back(fmt::format(
      "|W - W^T| / |W| = {:.2g}: u = W r + q as given, symmetric parts within a cone", asymmetry));
}

}  // namespace

std::optional<std::string> refuse_zero_delassus(const Problem& problem) {
  if (problem.cone_count() > 0 && !(problem.mobility().minCoeff() > 0.0)) return "W is zero";
  return std::nullopt;
}

Solver make_checked_solver(const Method& method, const Values& values, Refuses refuses,
                           Iterate iterate) {
  auto solve = [refuses, iterate = std::move(iterate)](const Problem& problem,
                                                       const Request& request) {
    require(problem.is_standard(), problem.name(), "kappa > 0, expected the standard problem");
    request.stop.check();
    pin_library_threads();
    if (auto why = refuses(problem)) return unsupported(problem, std::move(*why));
    std::optional<Monitor> own;
    Monitor& monitor = request.monitor ? *request.monitor : own.emplace(problem, request.stop);
    Result result = iterate(problem, request.stop, starting_point(problem, request.guess), monitor);
    result.setup_s = monitor.setup_s();
    result.solve_s = monitor.elapsed_s() - monitor.setup_s();
    if (monitor.best().size() > 0 || problem.rows() == 0) result.r = monitor.best();
    if (!problem.is_primal()) note_asymmetry(problem, result);
    return result;
  };
  return {identity(method, values), method.kind, method.parameters, std::move(refuses),
          std::move(solve)};
}

}  // namespace conebench::solvers
