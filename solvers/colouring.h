#pragma once

#include <span>
#include <vector>

#include "solvers/gs_coupling.h"

namespace conebench::solvers {

/// An order of the cones for several threads. It is cut into short stretches, and the stretches
/// into colours: what a cone changes, no cone of another stretch of its colour reads. So the
/// stretches of a colour may be solved at the same time, with the same numbers whatever the count
/// of threads.
///
/// Stretches are of neighbours in the order of the problem, so that a thread reads memory almost as
/// a sweep in that order does; the problem's order is that of its bodies in every engine, but may
/// be any. Stretches start long and are halved until at most kMostSerial of the cones are left over
/// below; the length that leaves least is taken. Colours are given greedily, each the first that is
/// free. What is not worth waking a thread for comes last, to be solved in sequence: the cones of a
/// hub, a body or node felt by more than kHub of them (with W, cones that it couples to more than
/// that), and colours of fewer than kLeastParallel cones or kLeastStretches stretches.
class Colouring {
 public:
  static constexpr int kLongest = 256;  ///< cones of a stretch
  static constexpr int kHub = 64;
  static constexpr int kLeastParallel = 64;
  static constexpr int kLeastStretches = 8;
  static constexpr double kMostSerial = 0.05;

  /// The stretches of one colour, one after another: cones[begin[s]] to cones[begin[s + 1]].
  struct Colour {
    std::vector<int> cones, begin{0};

    int stretches() const { return static_cast<int>(begin.size()) - 1; }
    std::span<const int> stretch(int s) const {
      const auto at = static_cast<std::size_t>(s);
      return std::span(cones).subspan(static_cast<std::size_t>(begin[at]),
                                      static_cast<std::size_t>(begin[at + 1] - begin[at]));
    }
  };

  /// Two cones clash where they share a run of dofs. Cost: linear in the runs, times colours / 64,
  /// once for each length of stretches tried.
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
  void colour_by_runs(int cones, const BlockedRows& rows);
  // colours(length) gives each stretch of so many `regular` cones its colour.
  template <class Colours>
  void cut(const std::vector<int>& regular, const Colours& colours);

  std::vector<Colour> parallel_;
  std::vector<int> serial_;
};

}  // namespace conebench::solvers
