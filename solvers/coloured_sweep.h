#pragma once

#include <omp.h>

#include "solvers/colouring.h"
#include "solvers/gs_sweeper.h"
#include "solvers/work_shares.h"

namespace conebench::solvers {

/// A sweep over all cones colour by colour, each colour by several threads. The numbers do not
/// depend on how many. Cost beyond the cones': one barrier a colour.
template <class Coupling>
class ColouredSweep {
 public:
  /// `threads` 0: as many as OpenMP has been told to use.
  ColouredSweep(const problems::Problem& problem, const Coupling& coupling, int threads)
      : colouring_(problem, coupling),
        threads_(threads > 0 ? threads : omp_get_max_threads()),
        shares_(threads_) {}

  SweepSize sweep(Sweeper<Coupling>& sweeper, Eigen::VectorXd& r) {
    SweepSize size;
    if (colouring_.parallel().empty()) {
      for (const int i : colouring_.serial()) sweeper.visit(i, r, size);
      return size;
    }
    const LevelsForOne levels;
#pragma omp parallel num_threads(threads_)
    {
      SweepSize mine;
      const int thread = omp_get_thread_num(), threads = omp_get_num_threads();
      for (const Colouring::Colour& colour : colouring_.parallel()) {
        shares_.deal(thread, threads, colour.count());
        for (int s = shares_.take(thread); s >= 0; s = shares_.take(thread)) {
          for (const int i : colour.stretch(s)) sweeper.visit(i, r, mine);
        }
#pragma omp barrier
      }
#pragma omp master
      for (const int i : colouring_.serial()) sweeper.visit(i, r, mine);
#pragma omp critical
      size.add(mine);
    }
    return size;
  }

 private:
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
