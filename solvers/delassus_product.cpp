#include "solvers/delassus_product.h"

namespace conebench::solvers {

DelassusProduct::DelassusProduct(const problems::Problem& problem) : problem_(problem) {
  if (!problem.is_primal() || !problem.inertia().block_diagonal()) return;
  B_ = problem.H() * problem.inertia().inverse_root();
  y_.resize(problem.dofs());
}

void DelassusProduct::apply(const Eigen::VectorXd& r, Eigen::VectorXd& Wr) {
  if (!problem_.is_primal()) {
    Wr.noalias() = problem_.W() * r;
  } else if (y_.size() > 0) {
    y_.noalias() = B_.transpose() * r;
    Wr.noalias() = B_ * y_;
  } else {
    Wr = problem_.apply_delassus(r);
  }
}

void DelassusProduct::rate(const Eigen::VectorXd& r, Eigen::VectorXd& u) {
  apply(r, u);
  u += problem_.q();
}

}  // namespace conebench::solvers
