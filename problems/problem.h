#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "problems/cone.h"
#include "problems/inertia.h"
#include "problems/sparse.h"

namespace conebench::problems {

struct Features;
struct Island;

/// Where a problem comes from and in which units it speaks. Free text is kept as it was given.
struct Metadata {
  std::string name = "unnamed";  ///< unique in a collection, e.g. "column-dry_000420"
  std::string engine{};          ///< "dem", "mpm", or the program that made the file
  std::string scene{};
  std::int64_t step = 0;
  double step_size_s = 0.0;        ///< 0 when unknown
  std::string force_unit = "N s";  ///< unit of r and kappa
  std::string rate_unit = "m/s";   ///< unit of u and w
  std::string origin{};            ///< e.g. the file it was imported from
  double sampling_weight = 1.0;    ///< how many steps of its scene it stands for
};

/// The primal form: M v = f + H^T r, u = H v + w.
struct PrimalData {
  SparseMatrix M;     ///< dofs x dofs, symmetric positive definite
  SparseMatrix H;     ///< rows x dofs
  Eigen::VectorXd f;  ///< dofs
  Eigen::VectorXd w;  ///< rows
};

/// The reduced (Delassus) form: u = W r + q.
struct ReducedData {
  SparseMatrix W;     ///< rows x rows, positive semidefinite, symmetric up to kLargestAsymmetry
  Eigen::VectorXd q;  ///< rows
};

/// The one problem that everything here reads, writes, solves and judges: one time step of a
/// granular simulation. Find r such that
///
///   M v = f + H^T r,   u = H v + w   (or u = W r + q),
///   K_mu* contains u_i + theta_i |u_it| e_n,  orthogonal to  r_i + kappa_i e_n  in K_mu.
///
/// Shapes  cone i owns rows [start(i), start(i) + cones()[i].dim), normal first, in order.
/// Units   r in force_unit, u in rate_unit, W in rate_unit / force_unit (metadata()).
/// Cost    construction factorises M once; copies and shifted() share matrices and factor.
/// Errors  InputError naming the problem when a size, sign, value or symmetry is wrong, so that
///         no solver has to check. That W is positive semidefinite is not checked beyond its
///         diagonal. Immutable afterwards; safe to read from several threads.
class Problem {
 public:
  /// |W - W^T|_F / |W|_F above which W is refused. Real files of capsules reach 0.012.
  static constexpr double kLargestAsymmetry = 0.05;

  /// `rate_scale`: the value that a file carries, when its kappa was already shifted away.
  Problem(PrimalData data, std::vector<Cone> cones, Metadata metadata,
          std::optional<double> rate_scale = {});
  Problem(ReducedData data, std::vector<Cone> cones, Metadata metadata,
          std::optional<double> rate_scale = {});

  const std::string& name() const { return metadata_.name; }
  const Metadata& metadata() const { return metadata_; }
  Problem with_metadata(Metadata metadata) const;
  /// The same matrices and f under other laws: cones of the same dims, and another w. Primal only.
  /// Cost: one product with H; nothing is factorised. Throws InputError as the constructor.
  Problem with_laws(std::vector<Cone> cones, Eigen::VectorXd w) const;

  std::span<const Cone> cones() const { return cones_; }
  int cone_count() const { return static_cast<int>(cones_.size()); }
  int start(int cone) const { return operators_->start[static_cast<std::size_t>(cone)]; }
  int rows() const { return operators_->start.back(); }
  int dofs() const { return static_cast<int>(operators_->M.rows()); }

  /// True in the primal form. M(), H(), f(), w(), inertia() exist only then, W() only otherwise.
  bool is_primal() const { return operators_->inertia != nullptr; }
  const SparseMatrix& M() const;
  const SparseMatrix& H() const;
  const Eigen::VectorXd& f() const;
  const Eigen::VectorXd& w() const;
  const Inertia& inertia() const;
  const SparseMatrix& W() const;

  /// The rate at r = 0: H M^-1 f + w, or the file's q. [rate_unit]
  const Eigen::VectorXd& q() const { return q_; }

  /// M^-1 (f + H^T r): velocities at the end of the step. Primal only.
  Eigen::VectorXd velocity(const Eigen::VectorXd& r) const;
  /// u = H velocity(r) + w, or W r + q. One pass over the matrices; W is never formed.
  Eigen::VectorXd rate(const Eigen::VectorXd& r) const;
  /// W r.
  Eigen::VectorXd apply_delassus(const Eigen::VectorXd& r) const;
  /// W itself: H M^-1 H^T, or the file's. For methods that need it; can be far larger than H.
  SparseMatrix delassus() const;

  /// lambda_i = |W_ii|_2, floored at 1e-12 max_j lambda_j. Where M has components of more than
  /// Inertia::kLargestBlock dofs, W_ii uses the diagonal of M there. [rate_unit / force_unit]
  const Eigen::VectorXd& mobility() const { return operators_->mobility; }

  /// U: the violation at r = 0 that eta is measured against, from the unshifted data. Kept by
  /// shifted() and by islands(). [rate_unit]
  double rate_scale() const { return rate_scale_; }
  /// False when the data as they stand (a shifted problem's, an island's) would give another U; a
  /// file then carries U, and it counts as content.
  /// Cost: one pass over the matrices.
  bool rate_scale_is_of_data() const { return rate_scale_ == compute_rate_scale(); }

  /// True when every kappa is 0.
  bool is_standard() const;
  /// kappa e_n, stacked: r' = r + tip_shift(). [force_unit]
  Eigen::VectorXd tip_shift() const;
  /// The standard problem for r' = r + kappa e_n: same H, M, w, mu, theta, u, v; kappa = 0 and
  /// f' = f - H^T kappa e_n (q' = q - W kappa e_n).
  Problem shifted() const;

  /// The connected components, each a problem of its own; dofs without a cone are left out.
  /// Cost: one copy; nothing is checked or factorised again where M is block diagonal.
  std::vector<Island> islands() const;
  /// How many there are. Cost: one pass over H, or W.
  int island_count() const;
  Features features() const;

 private:
  struct Operators {
    std::vector<int> start;                  // cone_count + 1
    SparseMatrix M, H, W;                    // M, H in the primal form, W in the reduced one
    std::shared_ptr<const Inertia> inertia;  // null in the reduced form
    Eigen::VectorXd mobility;
  };

  /// The parts of a checked problem: taken as they are.
  Problem(std::shared_ptr<const Operators> operators, std::vector<Cone> cones, Metadata metadata,
          double rate_scale);

  void check_rows(Eigen::Index rows) const;
  double compute_rate_scale() const;
  void set_rate_scale(std::optional<double> given);
  Island island(std::vector<int> cones, std::vector<int> dofs, int label,
                std::vector<int>& position) const;

  std::shared_ptr<const Operators> operators_;
  Eigen::VectorXd f_, w_, q_;
  std::vector<Cone> cones_;
  Metadata metadata_;
  double rate_scale_ = 0.0;
};

/// A connected component of a problem.
struct Island {
  Problem problem;
  std::vector<int> cones;  ///< of the whole problem, in increasing order
  std::vector<int> dofs;   ///< likewise; empty in the reduced form
};

/// What can be said of a problem without solving it. Ranges are {smallest, largest}, 0 if empty.
struct Features {
  int cones = 0, rows = 0, dofs = 0;
  bool primal = false;
  std::vector<std::pair<int, int>> cones_of_dim;  ///< (dim, count), dims increasing
  std::pair<double, double> mu, kappa, theta, mobility;
  double cohesive_share = 0.0;  ///< of cones with kappa > 0
  bool coulomb = true;          ///< theta = mu everywhere
  std::int64_t nonzeros_M = 0, nonzeros_H = 0, nonzeros_W = 0;
  double asymmetry = 0.0;               ///< of the file's W; 0 in the primal form
  bool block_diagonal_mass = false;     ///< M's components have at most 12 dofs
  int islands = 0, largest_island = 0;  ///< count; cones of the largest
  double rows_per_dof = 0.0;            ///< > 1 proves that W is singular; 0 in the reduced form
  double rate_scale = 0.0;
};

}  // namespace conebench::problems
