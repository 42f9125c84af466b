#include "harness/survey/survey.h"

#include <fmt/format.h>

namespace conebench::harness {

solvers::Stop survey_stop(const problems::Problem& problem) {
  return {.tol = kSurveyTol, .time_limit_s = problem.cone_count() <= 30 ? 1.0 : 5.0};
}

void Faults::add(const solvers::Solver& solver, const std::string& problem,
                 const std::string& what) {
  lines_.push_back(fmt::format("{} on {}: {}", solver.name, problem, what));
}

Attempt Faults::watched_attempt(const solvers::Solver& solver, const problems::Problem& problem,
                                const std::string& name, const solvers::Stop& stop,
                                const Eigen::VectorXd& guess) {
  Attempt tried = attempt(solver, problem, stop, guess);
  const std::string what = fault(tried, problem, stop);
  if (!what.empty()) add(solver, name, what);
  return tried;
}

int Faults::print() const {
  fmt::print("\n## Faults\n\n");
  if (lines_.empty()) fmt::print("None.\n");
  for (const std::string& line : lines_) fmt::print("- {}\n", line);
  return lines_.empty() ? 0 : 1;
}

}  // namespace conebench::harness
