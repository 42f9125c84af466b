#include "harness/survey/survey.h"

#include <fmt/format.h>

namespace conebench::harness {

double survey_time_limit_s(const problems::Problem& problem) {
  return problem.cone_count() <= 30 ? 1.0 : 5.0;
}

void Faults::add(const solvers::Solver& solver, const std::string& problem,
                 const std::string& what) {
  lines_.push_back(fmt::format("{} on {}: {}", solver.name, problem, what));
}

void Faults::add_if_any(const solvers::Solver& solver, const Attempt& tried,
                        const problems::Problem& problem, const std::string& name,
                        const solvers::Stop& stop) {
  const std::string what = fault(tried, problem, stop);
  if (!what.empty()) add(solver, name, what);
}

int Faults::print() const {
  fmt::print("\n## Faults\n\n");
  if (lines_.empty()) fmt::print("None.\n");
  for (const std::string& line : lines_) fmt::print("- {}\n", line);
  return lines_.empty() ? 0 : 1;
}

}  // namespace conebench::harness
