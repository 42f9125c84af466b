#include "solvers/newton/proximal_equation.h"

#include "solvers/newton/alart_curnier.h"
#include "solvers/newton/fischer_burmeister.h"

namespace conebench::solvers {
namespace {

using problems::Problem;

constexpr double kSecondsPerRow = 5e-7;  // of a step without its linear system (work_s)

std::unique_ptr<const ConeFunction> make_function(const NewtonSettings& settings) {
  switch (settings.function) {
    case NewtonSettings::Function::kAlartCurnier:
      return std::make_unique<AlartCurnier>(AlartCurnier::Radius::kAlartCurnier, settings.rho);
    case NewtonSettings::Function::kJeanMoreau:
      return std::make_unique<AlartCurnier>(AlartCurnier::Radius::kJeanMoreau, settings.rho);
    case NewtonSettings::Function::kFischerBurmeister:
      return std::make_unique<FischerBurmeister>();
  }
  return nullptr;
}

Eigen::VectorXd mobility_per_row(const Problem& problem) {
  Eigen::VectorXd lambda(problem.rows());
  for (int i = 0; i < problem.cone_count(); ++i) {
    const int dim = problem.cones()[static_cast<std::size_t>(i)].dim;
    lambda.segment(problem.start(i), dim).setConstant(problem.mobility()(i));
  }
  return lambda;
}

}  // namespace

ProximalEquation::ProximalEquation(const Problem& problem, const NewtonSettings& settings)
    : problem_(problem),
      function_(make_function(settings)),
      lambda_(mobility_per_row(problem)),
      system_(problem, settings.form),
      A_(problem),
      B_(problem),
      regularised_(problem) {}

void ProximalEquation::start(const Eigen::VectorXd& r, double alpha) {
  centre_ = r;
  alpha_ = alpha;
  move_to(r);
}

void ProximalEquation::recentre() {
  centre_ = r_;
  pulled_ = u_;
  evaluate(p_, pulled_, phi_);
}

std::optional<double> ProximalEquation::step(StepLength& lengths) {
  if (!find_direction()) return std::nullopt;
  const auto merit_at = [&](double t) {
    evaluate(p_ + t * dp_, pulled_ + t * du_, trial_);
    return 0.5 * trial_.squaredNorm();
  };
  const auto t = lengths.find(merit_at, merit(), slope_);
  if (t) move_to(r_ + *t * dr_);
  return t;
}

void ProximalEquation::move_to(const Eigen::VectorXd& r) {
  r_ = r;
  p_ = lambda_.cwiseProduct(r_);
  u_ = problem_.rate(r_);
  pulled_ = u_ + alpha_ * lambda_.cwiseProduct(r_ - centre_);
  phi_.resize(r_.size());
  trial_.resize(r_.size());
  evaluate(p_, pulled_, phi_);
}

void ProximalEquation::evaluate(const Eigen::VectorXd& p, const Eigen::VectorXd& u,
                                Eigen::VectorXd& phi) const {
  for (int i = 0; i < problem_.cone_count(); ++i) {
    const int at = problem_.start(i), dim = cone(i).dim;
    function_->value(cone(i), p.segment(at, dim), u.segment(at, dim), phi.segment(at, dim));
  }
}

void ProximalEquation::linearise() {
  for (int i = 0; i < problem_.cone_count(); ++i) {
    const int at = problem_.start(i), dim = cone(i).dim;
    const double lambda = problem_.mobility()(i);
    function_->jacobian(cone(i), p_.segment(at, dim), pulled_.segment(at, dim), A_[i], B_[i]);
    A_[i] *= lambda;
    regularised_[i] = A_[i] + alpha_ * lambda * B_[i];
  }
}

// False when the matrix is singular or the direction is not one of descent.
bool ProximalEquation::find_direction() {
  linearise();
  const bool factorised = system_.factorize(regularised_, B_);
  work_s_ = system_.work_s() + kSecondsPerRow * static_cast<double>(problem_.rows());
  if (!factorised) return false;
  dr_ = system_.solve(-phi_);
  dp_ = lambda_.cwiseProduct(dr_);
  du_ = problem_.apply_delassus(dr_) + alpha_ * dp_;
  slope_ = phi_.dot(A_ * dr_ + B_ * du_);
  return slope_ < 0.0;  // false for a NaN too
}

}  // namespace conebench::solvers
