#pragma once

#include <deque>
#include <functional>
#include <optional>

namespace conebench::solvers {

enum class LineSearch {
  kNone,            ///< t = 1, if m(1) is finite
  kArmijo,          ///< m(t) <= m(0) + 1e-4 t m'(0), halving t
  kGoldsteinPrice,  ///< m(0) + 0.9 t m'(0) <= m(t) <= m(0) + 0.1 t m'(0), by bisection
  kNonMonotone,     ///< Armijo against the largest of the last 10 merits (Grippo, Lampariello,
                    ///< Lucidi, SIAM J. Numer. Anal. 23(4), 1986)
};

/// Step lengths along one direction after another, for a merit function m >= 0.
class StepLength {
 public:
  explicit StepLength(LineSearch kind) : kind_(kind) {}

  void restart() { merits_.clear(); }

  /// t for merit(t), of value `merit0` and slope `slope0` < 0 at 0; nothing when no t was
  /// acceptable. Where it finds one, `merit0` enters the memory.
  std::optional<double> find(const std::function<double(double)>& merit, double merit0,
                             double slope0);

 private:
  std::optional<double> non_monotone(const std::function<double(double)>& merit, double merit0,
                                     double slope0);

  LineSearch kind_;
  std::deque<double> merits_;  // kNonMonotone: of earlier iterates
};

}  // namespace conebench::solvers
