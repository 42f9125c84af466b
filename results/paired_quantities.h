#pragma once

#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "results/bootstrap.h"
#include "results/record.h"

namespace conebench::results {

/// Two rows of one task.
struct RowPair {
  const Record* base;
  const Record* fresh;
  double base_s, fresh_s;  ///< time to the verified tolerance; infinite: not solved in time
  std::size_t scene = 0;   ///< number of the problem's scene

  bool base_solved() const { return std::isfinite(base_s); }
  bool fresh_solved() const { return std::isfinite(fresh_s); }
  bool both_solved() const { return base_solved() && fresh_solved(); }
};

/// A number of NEW against the same of BASE, over the pairs.
struct Quantity {
  std::string name;
  /// Both sides, in their unit; nothing where there is none (no pair that both solve).
  std::optional<double> base{}, fresh{};
  /// NEW over BASE; of a count the count itself. Nothing where undefined: one side missing, or both
  /// infinite. Infinite where only NEW is.
  std::optional<double> value{};
  std::optional<Interval> interval{};  ///< of `value`, 95 %, from a bootstrap over scenes
};

/// The quantities of a comparison but "missing", in the order of quantity_names() in compare.h,
/// which says what they are.
std::vector<Quantity> quantities_of(std::span<const RowPair> pairs, std::size_t scenes);

}  // namespace conebench::results
