#pragma once

#include <span>
#include <vector>

#include "solvers/gs_coupling.h"

namespace conebench::solvers {

/// Lists of cones, one after another: cones[begin[s]] to cones[begin[s + 1]].
struct Stretches {
  std::vector<int> cones, begin{0};

  int count() const { return static_cast<int>(begin.size()) - 1; }
  std::span<const int> stretch(int s) const {
    const auto at = static_cast<std::size_t>(s);
    return std::span(cones).subspan(static_cast<std::size_t>(begin[at]),
                                    static_cast<std::size_t>(begin[at + 1] - begin[at]));
  }
  /// Ends the stretch of the cones added since the last one, unless there are none.
  void close() {
    const auto end = static_cast<int>(cones.size());
    if (end > begin.back()) begin.push_back(end);
  }
};

/// An order of the cones for several threads. It is cut into stretches, and the stretches into
/// colours: what a cone changes, no cone of another stretch of its colour reads. So the stretches
/// of a colour may be solved at the same time, with the same numbers whatever the count of threads.
///
/// Slabs    the order of the problem, which in every engine is that of its bodies or nodes, falls
///          into 4 to 128 slabs of neighbours. The cones of a slab that feel none of an earlier
///          slab's are one stretch, and all these the first colour; the others, at the cut, are
///          another stretch. Memory is read almost as in the order itself, and two or three colours
///          are enough where slabs are thicker than what a cone feels.
/// Pieces   where that does not divide the work well, because the order is another one or the cones
///          are few: pieces of 256 cones, or half as many and so on down to single ones.
/// Choice   what kThreads threads finish first, of all these, by the number of cones in sequence.
///          Colours are given first fit. Last, by one thread, come colours that are not worth
///          waking the others for and the cones of a hub, a body or node felt by more than kHub of
///          them (with W, cones that it couples to more than that).
class Colouring {
 public:
  static constexpr int kHub = 64;
  static constexpr int kThreads = 4;
  static constexpr int kBarrier = 100;  ///< what waking threads costs, in cones solved meanwhile

  using Colour = Stretches;

  /// Two cones clash where they share a run of dofs. Cost: linear in the runs, for each cut tried.
  template <class Products>
  Colouring(const problems::Problem& problem, const VelocityCoupling<Products>& coupling) {
    colour_by_runs(problem.cone_count(), coupling.rows());
  }
  /// Two cones clash where W couples one to the other. Cost: likewise, in the blocks of W.
  Colouring(const problems::Problem& problem, const DelassusCoupling& coupling);

  std::span<const Colour> parallel() const { return parallel_; }
  /// All other cones.
  std::span<const int> serial() const { return serial_; }

 private:
  struct Footprints;

  void colour_by_runs(int cones, const BlockedRows& rows);
  void arrange(const std::vector<int>& regular, const Footprints& footprints);

  std::vector<Colour> parallel_;
  std::vector<int> serial_;
};

}  // namespace conebench::solvers
