#pragma once

#include <memory>
#include <string>

#include "solvers/iteration.h"

namespace conebench::solvers {

enum class Existence {
  kExists,   ///< a solution exists
  kNone,     ///< none, short of velocities a million times those of the data (kProof)
  kUnknown,  ///< neither is proved
};

/// "exists", "none", "unknown".
std::string_view to_string(Existence existence);

/// What is proved about the existence of a solution, and the proof.
struct Certificate {
  Existence verdict = Existence::kUnknown;
  Eigen::VectorXd r;    ///< kExists: its rate lies inside every K_mu* (margin 0: r is a solution)
  Eigen::VectorXd y;    ///< kNone: see proves_infeasible
  double margin = 0.0;  ///< kExists: interior_margin(r); kNone: infeasibility_margin(y) [-]
  std::string text;     ///< the same in a sentence
};

/// Settles existence by two convex problems, if it can (formulation, section 1):
///
///   H v + w in int K_mu* for some v                    =>  a solution exists;
///   no v has u = H v + w with u_n >= (mu - theta) |u_t|  =>  there is none.
///
/// Both are associated problems, solved by ssnal: the first with w - m e_n for decreasing margins
/// m, the second with friction mu - theta (for Coulomb: the normal rows alone). Where such a
/// problem has no solution its reactions diverge, along the certificate y. Neither may hold. In the
/// reduced form v ranges over M^-1 (f + H^T r), which leaves nothing out. Cohesion changes nothing.
/// Each proof is checked by the functions below, which do not depend on how it was found.
/// Cost  a few solves of a convex problem; `time_limit_s` of wall clock for all together, up to one
///       Newton step and the set-up of the problems.
/// Source  Cadoux (thesis 2009); Acary, Cadoux, Lemarechal, Malick, ZAMM 91(2) (2011) 155-175
///         (neither checked).
Certificate certify(const problems::Problem& problem, double time_limit_s);

/// The second problem alone, one Newton step at a time.
class InfeasibilitySearch {
 public:
  explicit InfeasibilitySearch(const problems::Problem& problem);
  ~InfeasibilitySearch();

  /// kInfeasible with the proof; kStalled when a velocity was found that the second problem allows,
  /// so that there is nothing to prove, or when the method that solves it stalls; kDiverged.
  Iteration::State advance();
  const Eigen::VectorXd& proof() const;  ///< y, proves_infeasible; rows() entries
  double step_work_s() const;            ///< of one advance() (Iteration::work_s)

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// min_i (u_n - mu |u_t| - e_i) / U at u = rate(r), where e_i bounds the rounding in u_i. Above 0
/// it proves that a solution exists. -infinity where W is not symmetric.
double interior_margin(const problems::Problem& problem, const Eigen::VectorXd& r);

/// Velocity that a solution would need, in units of the data's own, if y (rows() entries) is right:
/// with y in K_(mu - theta) and u = H v + w in its dual, 0 <= u.y = v.(H^T y) + w.y, so that
///
///   |v|_M  >=  -w.y / |H^T y|_(M^-1),
///
/// the unit being  (|M^-1 f|_M^2 + sum |P_K(-w_i)|^2 / lambda_i)^(1/2); in the reduced form q for
/// w, y.W y for |H^T y|^2 and M^-1 H^T r for v. Rounding in both products counts against y. 0 where
/// y is outside the cone, not finite or of another length, or -w.y <= 0, and where W is not
/// symmetric (its null space then says nothing). An exact certificate, H^T y = 0, has an infinite
/// margin; in doubles about 1e15 is the most, 1e7 in the reduced form. For Coulomb y is (y_n, 0)
/// cone by cone, with y_n >= 0 and H_n^T y_n = 0.
double infeasibility_margin(const problems::Problem& problem, const Eigen::VectorXd& y);

/// infeasibility_margin(y) of at least this counts as a proof: what is proved is that no solution
/// has smaller velocities, and no step of a simulation makes velocities a million times those it
/// started from.
constexpr double kProof = 1e6;

/// What a claim of Status::kInfeasible is judged by.
bool proves_infeasible(const problems::Problem& problem, const Eigen::VectorXd& y);

}  // namespace conebench::solvers
