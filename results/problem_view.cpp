#include "results/problem_view.h"

#include <algorithm>

#include "problems/cone.h"
#include "problems/residual.h"

namespace conebench::results {
namespace {

// Below this share of U a force or a rate is rounding, however small eta is.
constexpr double kLeastShare = 1e-12;

ContactState state_of(const problems::Problem& standard, int i, const Eigen::VectorXd& r,
                      const Eigen::VectorXd& u, double eta) {
  const int start = standard.start(i), dim = standard.cones()[static_cast<std::size_t>(i)].dim;
  const double seen = std::max(eta, kLeastShare) * standard.rate_scale();
  if (standard.mobility()(i) * r.segment(start, dim).norm() <= seen) return ContactState::kOpen;
  const double sliding = problems::tangential_norm(u.segment(start, dim));
  return sliding > 10.0 * seen ? ContactState::kSlide : ContactState::kStick;
}

AnswerView answer_view(const problems::Problem& problem, const problems::Problem& standard,
                       const Answer& answer) {
  const problems::Residual residual = problems::evaluate_residual(standard, answer.r);
  const Eigen::VectorXd u = standard.rate(answer.r);
  AnswerView view{.solver = answer.solver,
                  .eta = residual.eta.max,
                  .force = Eigen::VectorXd(problem.cone_count()),
                  .normal_force = Eigen::VectorXd(problem.cone_count()),
                  .eta_of_cone = residual.eta.per_cone,
                  .penetration = residual.penetration_rate.per_cone,
                  .cone_violation = residual.cone_violation.per_cone,
                  .work = residual.work.per_cone,
                  .misalignment = residual.misalignment.per_cone,
                  .state = {}};
  for (int i = 0; i < problem.cone_count(); ++i) {
    const problems::Cone& cone = problem.cones()[static_cast<std::size_t>(i)];
    const int start = problem.start(i);
    view.force(i) = answer.r.segment(start, cone.dim).norm();
    view.normal_force(i) = answer.r(start) - cone.kappa;
    view.state.push_back(state_of(standard, i, answer.r, u, residual.eta.max));
  }
  return view;
}

Eigen::VectorXd norms(const problems::Problem& problem, const Eigen::VectorXd& stacked) {
  Eigen::VectorXd result(problem.cone_count());
  for (int i = 0; i < problem.cone_count(); ++i) {
    const problems::Cone& cone = problem.cones()[static_cast<std::size_t>(i)];
    result(i) = stacked.segment(problem.start(i), cone.dim).norm();
  }
  return result;
}

}  // namespace

ProblemView view_of(const problems::ProblemFile& file, const std::vector<Answer>& answers) {
  const problems::Problem& problem = file.problem;
  const problems::Problem standard = problem.shifted();
  ProblemView view;
  view.name = problem.name();
  view.content_sha256 = problems::content_sha256(problem);
  view.force_unit = problem.metadata().force_unit;
  view.rate_unit = problem.metadata().rate_unit;
  view.geometry = *file.geometry;
  for (const problems::Cone& cone : problem.cones()) view.cohesive.push_back(cone.kappa > 0.0);
  for (std::size_t a = 0; a < std::min<std::size_t>(2, answers.size()); ++a) {
    view.answers.push_back(answer_view(problem, standard, answers[a]));
  }
  if (answers.size() >= 2) {
    const Eigen::VectorXd difference = answers[0].r - answers[1].r;
    view.force_difference = norms(problem, difference);
    view.rate_difference = norms(problem, problem.apply_delassus(difference));
  }
  return view;
}

}  // namespace conebench::results
