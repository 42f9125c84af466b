#pragma once

#include <optional>
#include <variant>

#include "problems/cone.h"
#include "solvers/local/exact.h"
#include "solvers/local/isotropic.h"
#include "solvers/local/newton_ac.h"
#include "solvers/local/newton_fb.h"
#include "solvers/local/outcome.h"
#include "solvers/local/quartic.h"
#include "solvers/with_dimension.h"

namespace conebench::solvers {

/// How one cone is solved with all others held.
enum class LocalKind {
  kExact,       ///< to rounding (exact.h)
  kProjection,  ///< one projected step, P_K(r - u_hat / lambda)
  kNewtonAc,    ///< Alart-Curnier Newton (newton_ac.h)
  kNewtonFb,    ///< Fischer-Burmeister Newton (newton_fb.h)
  kQuartic,     ///< enumeration (quartic.h)
};

/// One cone of a sweep, ready to be solved many times. Cones of d = 1 have a closed form: there
/// every kind but the projection is the exact one. kQuartic takes d = 1 and 3 only.
///
/// B = sym(W_ii), plus regularization lambda I where its smallest eigenvalue is below
/// regularization lambda. D as in ExactLocal.
/// Memory  d = 3: 224 bytes.
template <int D>
class OneCone {
 public:
  using Vector = Eigen::Matrix<double, D, 1>;
  using Matrix = Eigen::Matrix<double, D, D>;

  OneCone(LocalKind kind, const Matrix& Wii, double lambda, const problems::Cone& cone,
          double regularization);

  /// The same cone in a tenth of the memory, where the exact kind has a closed form.
  std::optional<IsotropicCone> isotropic() const {
    const auto* exact = std::get_if<Exact>(&local_);
    return exact ? exact->solver.isotropic() : std::nullopt;
  }

  /// Whether r_i = 0 stays the answer whatever the tangential rates, where the normal one is un.
  bool stays_open(double un) const {
    const auto* exact = std::get_if<Exact>(&local_);
    return un >= 0.0 && exact && exact->solver.opens_by_normal();
  }

  /// Replaces r_i by the answer for u_i, the rate at r_i: the problem of B and q = u_i - B r_i.
  LocalOutcome solve(const Vector& u, Vector& r) {
    if (auto* exact = std::get_if<Exact>(&local_)) return exact->solve(u, r);  // inlined in sweeps
    return solve_otherwise(u, r);
  }

 private:
  struct Projection {
    double lambda, mu, theta;
  };
  struct Exact {
    LocalOutcome solve(const Vector& u, Vector& r) {
      const Vector q = u - B.lazyProduct(r);
      return solver.solve(q, r, slide_rate) == LocalCase::kNoSolution ? LocalOutcome::kNoSolution
                                                                      : LocalOutcome::kDone;
    }

    ExactLocal<D> solver;
    Matrix B;
    double slide_rate = 0.0;  // of the last slide: the next one's guess
  };

  LocalOutcome solve_otherwise(const Vector& u, Vector& r) const;
  LocalOutcome solve_with(const Projection& local, const Vector& u, Vector& r) const;
  template <class Local>
  LocalOutcome solve_with(const Local& local, const Vector& u, Vector& r) const;

  std::variant<Projection, Exact, NewtonAcLocal<D>, NewtonFbLocal<D>, QuarticLocal> local_;
};

extern template class OneCone<1>;
extern template class OneCone<2>;
extern template class OneCone<3>;
extern template class OneCone<6>;
extern template class OneCone<Eigen::Dynamic>;

}  // namespace conebench::solvers
