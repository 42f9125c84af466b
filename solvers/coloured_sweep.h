#pragma once

#include <omp.h>

#include "solvers/colouring.h"
#include "solvers/gs_sweeper.h"
#include "solvers/work_shares.h"

namespace conebench::solvers {

/// Sweeps over all cones, and what brings velocities to their reactions, colour by colour, each
/// colour by several threads. The numbers do not depend on how many. Cost beyond the cones': one
/// barrier a colour.
template <class Coupling>
class ColouredSweep {
 public:
  /// `threads` 0: as many as OpenMP has been told to use.
  ColouredSweep(const problems::Problem& problem, const Coupling& coupling, int threads)
      : colouring_(problem, coupling),
        threads_(threads > 0 ? threads : omp_get_max_threads()),
        shares_(threads_) {}

  SweepSize sweep(Sweeper<Coupling>& sweeper, Eigen::VectorXd& r) {
    return over_cones([&](std::span<const int> cones, SweepSize& size) {
      for (const int i : cones) sweeper.visit(i, r, size);
    });
  }

  /// As solvers::refresh (gs_coupling.h).
  void refresh(Coupling& coupling, const problems::Problem& problem, const Eigen::VectorXd& r) {
    coupling.clear();
    over_cones([&](std::span<const int> cones, SweepSize&) {
      for (const int i : cones) add_reaction(coupling, problem, i, r);
    });
  }

 private:
  // Calls visit(cones, size) for every stretch, at the same time for those of a colour. Each thread
  // has a `size` of its own; returns their sum.
  template <class Visit>
  SweepSize over_cones(const Visit& visit) {
    SweepSize all;
    if (colouring_.parallel().empty()) {
      visit(colouring_.serial(), all);
      return all;
    }
    const LevelsForOne levels;
#pragma omp parallel num_threads(threads_)
    {
      SweepSize mine;
      const int thread = omp_get_thread_num(), threads = omp_get_num_threads();
      for (const Colouring::Colour& colour : colouring_.parallel()) {
        shares_.deal(thread, threads, colour.count());
        for (int s = shares_.take(thread); s >= 0; s = shares_.take(thread)) {
          visit(colour.stretch(s), mine);
        }
#pragma omp barrier
      }
#pragma omp master
      visit(colouring_.serial(), mine);
#pragma omp critical
      all.add(mine);
    }
    return all;
  }

  // One level of parallel regions while it lives: elsewhere libraries are kept from opening any.
  class LevelsForOne {
   public:
    LevelsForOne() { omp_set_max_active_levels(1); }
    ~LevelsForOne() { omp_set_max_active_levels(before_); }
    LevelsForOne(const LevelsForOne&) = delete;
    LevelsForOne& operator=(const LevelsForOne&) = delete;

   private:
    int before_ = omp_get_max_active_levels();
  };

  Colouring colouring_;
  int threads_;
  WorkShares shares_;
};

}  // namespace conebench::solvers
