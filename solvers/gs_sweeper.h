#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <tuple>
#include <vector>

#include "problems/problem.h"
#include "solvers/local/one_cone.h"

namespace conebench::solvers {

/// What went wrong in one-cone problems.
struct LocalFailures {
  std::int64_t stopped = 0;  ///< LocalOutcome::kStopped
  std::int64_t solved = 0;   ///< all one-cone problems taken up
  int unsolvable = -1;       ///< the first cone whose problem has no solution; -1: none

  void add(const LocalFailures& other) {
    stopped += other.stopped;
    solved += other.solved;
    if (unsolvable < 0 || (other.unsolvable >= 0 && other.unsolvable < unsolvable)) {
      unsolvable = other.unsolvable;
    }
  }
};

/// Over the cones visited, as rates: how far reactions moved, and how large they are.
struct SweepSize {
  double change = 0.0;    ///< max lambda_i |dr_i|; infinite if an answer was not finite
  double reaction = 0.0;  ///< max lambda_i |r_i|
  LocalFailures failures{};

  /// The order of calls makes no difference.
  void add(const SweepSize& other) {
    change = std::max(change, other.change);
    reaction = std::max(reaction, other.reaction);
    failures.add(other.failures);
  }
};

// Calls within an update would cost as much as what they do: all are inlined, but not where code is
// instrumented, which would take minutes to compile.
#ifdef __SANITIZE_ADDRESS__
#define CONEBENCH_FLATTEN
#else
#define CONEBENCH_FLATTEN [[gnu::flatten]]
#endif

/// The one-cone solves of Gauss-Seidel over a coupling (gs_coupling.h).
template <class Coupling>
class Sweeper {
 public:
  Sweeper(const problems::Problem& problem, LocalKind kind, double omega, double regularization,
          Coupling coupling)
      : problem_(problem),
        kind_(kind),
        omega_(omega),
        regularization_(regularization),
        coupling_(std::move(coupling)) {
    places_.reserve(static_cast<std::size_t>(problem.cone_count()));
    prepare();
  }

  Coupling& coupling() { return coupling_; }
  /// Takes up the diagonal blocks of the coupling anew.
  void prepare() {
    places_.clear();
    isotropic_.clear();
    std::apply([](auto&... locals) { (locals.clear(), ...); }, locals_);
    for (int i = 0; i < problem_.cone_count(); ++i) prepare(i);
  }

  /// One pass over `cones`, in order or backward. The change of each cone visited goes to
  /// changes[cone], unless that is empty. r stays finite.
  SweepSize sweep(std::span<const int> cones, bool backward, std::span<double> changes,
                  Eigen::VectorXd& r) {
    SweepSize size;
    const std::size_t count = cones.size();
    for (std::size_t k = 0; k < count; ++k) {
      const int i = cones[backward ? count - 1 - k : k];
      const double change = visit(i, r, size);
      if (!changes.empty()) changes[static_cast<std::size_t>(i)] = change;
    }
    return size;
  }

  /// Solves cone i; its change as a rate. Cones that do not feel each other may be visited at the
  /// same time.
  double visit(int i, Eigen::VectorXd& r, SweepSize& size) {
    ++size.failures.solved;
    const Place& place = places_[static_cast<std::size_t>(i)];
    return with_dimension(place.dim, [&]<int D>() {
      if (place.isotropic) return update<D>(i, place, isotropic_[place.index], r, size);
      return update<D>(i, place, locals<D>()[place.index], r, size);
    });
  }

  /// What a sweep over all cones reads or writes, each once, the coupling's part left out. [bytes]
  std::size_t bytes() const {
    std::size_t bytes = 0;
    for (const Place& place : places_) {
      const auto dim = static_cast<std::size_t>(place.dim);
      const std::size_t local =
          place.isotropic ? sizeof(IsotropicCone) : with_dimension(place.dim, [&]<int D>() {
            const std::size_t elsewhere = D == Eigen::Dynamic ? 2 * dim * dim : 0;
            return sizeof(OneCone<D>) + elsewhere * sizeof(double);
          });
      bytes += sizeof(Place) + local + (1 + 2 * dim) * sizeof(double);  // lambda_i, r_i, w_i
    }
    return bytes;
  }

 private:
  // Where cone i is found.
  struct Place {
    int at, dim;          // its first row, its dimension
    std::uint32_t index;  // in isotropic_, or in the list of its dimension
    bool isotropic;
  };

  template <int D>
  std::vector<OneCone<D>>& locals() {
    return std::get<std::vector<OneCone<D>>>(locals_);
  }

  void prepare(int i) {
    const problems::Cone& cone = problem_.cones()[static_cast<std::size_t>(i)];
    with_dimension(cone.dim, [&]<int D>() {
      OneCone<D> local(kind_, coupling_.diagonal_block(i), problem_.mobility()(i), cone,
                       regularization_);
      const auto isotropic = local.isotropic();
      const std::size_t index = isotropic ? isotropic_.size() : locals<D>().size();
      places_.push_back({.at = problem_.start(i),
                         .dim = cone.dim,
                         .index = static_cast<std::uint32_t>(index),
                         .isotropic = isotropic.has_value()});
      if (isotropic) {
        isotropic_.push_back(*isotropic);
      } else {
        locals<D>().push_back(std::move(local));
      }
    });
  }

  template <int D, class Local>
  CONEBENCH_FLATTEN double update(int i, const Place& place, Local& local, Eigen::VectorXd& r,
                                  SweepSize& size) {
    using Vector = Eigen::Matrix<double, D, 1>;
    auto ri = r.template segment<D>(place.at, place.dim);
    if ((ri.array() == 0.0).all() &&
        local.stays_open(coupling_.normal_rate(i, place.at, place.dim))) {
      return 0.0;
    }
    const double lambda = problem_.mobility()(i);
    Vector u(place.dim), next = ri;
    coupling_.rate(i, place.at, u);
    const LocalOutcome outcome = local.solve(u, next);
    if (outcome != LocalOutcome::kDone) note(i, outcome, size.failures);
    if (omega_ != 1.0 && outcome != LocalOutcome::kNoSolution) {
      next = (1.0 - omega_) * Vector(ri) + omega_ * next;
      problems::project(problem_.cones()[static_cast<std::size_t>(i)].mu, next);
    }
    const Vector change = next - ri;
    const double moved = lambda * change.norm();
    if (!std::isfinite(moved)) {
      size.change = std::numeric_limits<double>::infinity();
      return size.change;
    }
    size.reaction = std::max(size.reaction, lambda * next.norm());
    if (moved == 0.0) return 0.0;
    size.change = std::max(size.change, moved);
    ri = next;
    coupling_.moved(i, change);
    return moved;
  }

  static void note(int i, LocalOutcome outcome, LocalFailures& failures) {
    if (outcome == LocalOutcome::kStopped) ++failures.stopped;
    if (outcome == LocalOutcome::kNoSolution) failures.add({.unsolvable = i});
  }

  const problems::Problem& problem_;
  LocalKind kind_;
  double omega_, regularization_;
  Coupling coupling_;
  std::tuple<std::vector<OneCone<1>>, std::vector<OneCone<2>>, std::vector<OneCone<3>>,
             std::vector<OneCone<6>>, std::vector<OneCone<Eigen::Dynamic>>>
      locals_;
  std::vector<IsotropicCone> isotropic_;  // of any dimension
  std::vector<Place> places_;
};

#undef CONEBENCH_FLATTEN

}  // namespace conebench::solvers
