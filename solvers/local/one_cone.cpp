#include "solvers/local/one_cone.h"

#include <type_traits>

namespace conebench::solvers {
namespace {

// The alternatives that solve_with takes; OneCone's constructor makes no other for D.
template <class Local, int D>
constexpr bool kSolves = D != 1 && (std::is_same_v<Local, NewtonAcLocal<D>> ||
                                    std::is_same_v<Local, NewtonFbLocal<D>> ||
                                    (D == 3 && std::is_same_v<Local, QuarticLocal>));

}  // namespace

template <int D>
OneCone<D>::OneCone(LocalKind kind, const Matrix& Wii, double lambda, const problems::Cone& cone,
                    double regularization) {
  if (kind == LocalKind::kProjection) {
    local_ = Projection{lambda, cone.mu, cone.theta};
    return;
  }
  Exact exact;
  exact.B = 0.5 * (Wii + Wii.transpose());
  exact.solver.set(exact.B, lambda, cone.mu, cone.theta);
  if (exact.solver.least_eigenvalue() < regularization * lambda) {
    exact.B.diagonal().array() += regularization * lambda;
    exact.solver.set(exact.B, lambda, cone.mu, cone.theta);
  }
  if constexpr (D != 1) {
    if (kind == LocalKind::kNewtonAc) {
      local_.template emplace<NewtonAcLocal<D>>().set(exact.B, lambda, cone.mu, cone.theta);
      return;
    }
    if (kind == LocalKind::kNewtonFb) {
      local_.template emplace<NewtonFbLocal<D>>().set(exact.B, lambda, cone.mu, cone.theta);
      return;
    }
  }
  if constexpr (D == 3) {
    if (kind == LocalKind::kQuartic) {
      local_.template emplace<QuarticLocal>().set(exact.B, lambda, cone.mu);
      return;
    }
  }
  local_ = std::move(exact);
}

template <int D>
LocalOutcome OneCone<D>::solve_otherwise(const Vector& u, Vector& r) const {
  return std::visit([&](const auto& local) { return solve_with(local, u, r); }, local_);
}

template <int D>
LocalOutcome OneCone<D>::solve_with(const Projection& local, const Vector& u, Vector& r) const {
  Vector u_hat = u;
  problems::add_de_saxce(local.theta, u_hat);
  r -= u_hat / local.lambda;
  problems::project(local.mu, r);
  return LocalOutcome::kDone;
}

template <int D>
template <class Local>
LocalOutcome OneCone<D>::solve_with(const Local& local, const Vector& u, Vector& r) const {
  if constexpr (kSolves<Local, D>) {
    Vector q = u;
    q.noalias() -= local.W() * r;
    if (local.solve(q, r)) return LocalOutcome::kDone;
  }
  return LocalOutcome::kStopped;
}

template class OneCone<1>;
template class OneCone<2>;
template class OneCone<3>;
template class OneCone<6>;
template class OneCone<Eigen::Dynamic>;

}  // namespace conebench::solvers
