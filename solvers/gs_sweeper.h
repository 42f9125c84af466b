#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <tuple>
#include <vector>

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
    slot_.reserve(static_cast<std::size_t>(problem.cone_count()));
    prepare();
  }

  Coupling& coupling() { return coupling_; }
  /// Takes up the diagonal blocks of the coupling anew.
  void prepare() {
    slot_.clear();
    std::apply([](auto&... locals) { (locals.clear(), ...); }, locals_);
    for (int i = 0; i < problem_.cone_count(); ++i) prepare(i);
  }

  void refresh(const Eigen::VectorXd& r) { coupling_.refresh(r); }

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
    return with_dimension(cone(i).dim, [&]<int D>() { return update<D>(i, r, size); });
  }

 private:
  const problems::Cone& cone(int i) const { return problem_.cones()[static_cast<std::size_t>(i)]; }

  void prepare(int i) {
    with_dimension(cone(i).dim, [&]<int D>() {
      auto& locals = std::get<std::vector<OneCone<D>>>(locals_);
      slot_.push_back(locals.size());
      locals.emplace_back(kind_, coupling_.diagonal_block(i), problem_.mobility()(i), cone(i),
                          regularization_);
    });
  }

  template <int D>
  double update(int i, Eigen::VectorXd& r, SweepSize& size) {
    using Vector = Eigen::Matrix<double, D, 1>;
    const int at = problem_.start(i), dim = cone(i).dim;
    const double lambda = problem_.mobility()(i);
    auto ri = r.template segment<D>(at, dim);
    auto& local = std::get<std::vector<OneCone<D>>>(locals_)[slot_[static_cast<std::size_t>(i)]];
    if ((ri.array() == 0.0).all() && local.stays_open(coupling_.normal_rate(i, at, dim)))
      return 0.0;
    Vector u(dim), next = ri;
    coupling_.rate(i, at, u);
    const LocalOutcome outcome = local.solve(u, next);
    if (outcome != LocalOutcome::kDone) note(i, outcome, size.failures);
    if (omega_ != 1.0 && outcome != LocalOutcome::kNoSolution) {
      next = (1.0 - omega_) * Vector(ri) + omega_ * next;
      problems::project(cone(i).mu, next);
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
  std::vector<std::size_t> slot_;  // of cone i in the list of its dimension
};

}  // namespace conebench::solvers
