#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace conebench::dem {

struct BodyPair {
  int first = 0;
  int second = 0;
  auto operator<=>(const BodyPair&) const = default;
};

/// Takes pairs in any order and gives them in increasing order.
///
/// Cost    O(pairs + firsts) for a bounded number of pairs of one first.
/// Memory  8 bytes a pair and 4 a first, kept from use to use.
class PairList {
 public:
  void restart() { count_ = 0; }

  /// Adds a pair if it is `close`. Writes in any case: a branch that nobody can foresee would cost
  /// more.
  void add_if(bool close, int first, int second) {
    if (count_ == pairs_.size()) pairs_.resize(2 * count_ + 64);
    pairs_[count_] = {first, second};
    count_ += close;
  }

  /// Turns the pairs round that have first > second. All at once, since in the search that is one
  /// more branch that nobody can foresee.
  void put_smaller_first();

  /// Replaces `out`; all firsts are from 0 to `firsts` - 1.
  void write(std::size_t firsts, std::vector<BodyPair>& out);

 private:
  std::vector<BodyPair> pairs_;  // as many as there is room for
  std::size_t count_ = 0;
  std::vector<int> begin_;
};

}  // namespace conebench::dem
