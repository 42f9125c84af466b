#pragma once

#include <string>
#include <vector>

#include "harness/survey/attempt.h"

namespace conebench::harness {

/// What `method_survey` was asked for.
struct Plan {
  bool quick = false;
  std::vector<solvers::Solver> solvers;
};

inline constexpr double kSurveyTol = 1e-8;

/// To kSurveyTol, in a time such that a small problem that needs more is not solved at all.
solvers::Stop survey_stop(const problems::Problem& problem);

/// What went wrong beyond "not solved"; printed at the end.
class Faults {
 public:
  void add(const solvers::Solver& solver, const std::string& problem, const std::string& what);
  /// attempt(), whose fault() is added if there is one.
  Attempt watched_attempt(const solvers::Solver& solver, const problems::Problem& problem,
                          const std::string& name, const solvers::Stop& stop,
                          const Eigen::VectorXd& guess = {});
  /// 1 if there are any, else 0.
  int print() const;

 private:
  std::vector<std::string> lines_;
};

/// The sections of the survey: each solves, notes faults and prints its table.
void odd_problems(const Plan& plan, Faults& faults);
void equivalent_problems(const Plan& plan, Faults& faults);
void several_solutions(const Plan& plan, Faults& faults);
void without_solution(const Plan& plan, Faults& faults);
void ordinary_problems(const Plan& plan, Faults& faults);
void without_guarantee(const Plan& plan, Faults& faults);

}  // namespace conebench::harness
