#include "dem/pair_list.h"

#include <algorithm>
#include <numeric>
#include <span>

namespace conebench::dem {

void PairList::put_smaller_first() {
  for (BodyPair& pair : std::span(pairs_).first(count_)) {
    pair = {std::min(pair.first, pair.second), std::max(pair.first, pair.second)};
  }
}

void PairList::write(std::size_t firsts, std::vector<BodyPair>& out) {
  out.resize(count_);
  if (count_ == 0) return;
  const auto pairs = std::span(pairs_).first(count_);
  begin_.assign(firsts + 1, 0);
  for (const BodyPair& pair : pairs) ++begin_[static_cast<std::size_t>(pair.first) + 1];
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  // Filling moves the beginning of a first's pairs to their end.
  for (const BodyPair& pair : pairs) {
    out[static_cast<std::size_t>(begin_[static_cast<std::size_t>(pair.first)]++)] = pair;
  }
  int begin = 0;
  for (const int end : std::span(begin_).first(firsts)) {
    std::sort(out.begin() + begin, out.begin() + end);
    begin = end;
  }
}

}  // namespace conebench::dem
