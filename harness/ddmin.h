#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace conebench::harness {

/// Whether a set of items, in their order, still fails; nothing: the search shall end here.
using StillFails = std::function<std::optional<bool>(const std::vector<int>&)>;

/// What a search came down to.
struct Minimum {
  std::vector<int> items;  ///< the smallest set seen to fail, in the order given
  std::size_t tests = 0;   ///< calls of the oracle that said yes or no
  bool complete = false;   ///< without any one of `items` the rest does not fail, nothing is left
                           ///< to try; false: the search was ended
};

/// Delta debugging: leaves out chunks of the items, in halves, quarters and so on down to single
/// ones, as long as what is left fails. The result is minimal in that no single item can be left
/// out; other sets that fail may be smaller. At least one item is kept, and the empty set is never
/// asked for. The same oracle gives the same answer by the same calls.
///
/// Precondition: `items` is not empty and fails; it is not asked for.
/// Cost    about 2 m log2(n / m) calls where m of n items matter; n^2 / 2 at worst.
/// Source  Zeller, Hildebrandt, IEEE Trans. Softw. Eng. 28(2) (2002), without the tests of single
///         chunks, which at halves are those of the complements (not checked).
Minimum minimise(const std::vector<int>& items, const StillFails& still_fails);

}  // namespace conebench::harness
