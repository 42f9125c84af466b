#include "harness/ddmin.h"

#include <algorithm>

namespace conebench::harness {
namespace {

using Chunks = std::vector<std::vector<int>>;

std::vector<int> joined_without(const Chunks& chunks, std::size_t left_out) {
  std::vector<int> items;
  for (std::size_t k = 0; k < chunks.size(); ++k) {
    if (k != left_out) items.insert(items.end(), chunks[k].begin(), chunks[k].end());
  }
  return items;
}

std::vector<int> joined(const Chunks& chunks) { return joined_without(chunks, chunks.size()); }

Chunks halved(const Chunks& chunks) {
  Chunks halves;
  for (const std::vector<int>& chunk : chunks) {
    const auto middle = chunk.begin() + std::ssize(chunk) / 2;
    if (middle != chunk.begin()) halves.emplace_back(chunk.begin(), middle);
    halves.emplace_back(middle, chunk.end());
  }
  return halves;
}

bool all_single(const Chunks& chunks) {
  return std::ranges::all_of(chunks, [](const auto& chunk) { return chunk.size() == 1; });
}

}  // namespace

Minimum minimise(const std::vector<int>& items, const StillFails& still_fails) {
  Chunks chunks = {items};
  Minimum found;
  while (!all_single(chunks)) {
    chunks = halved(chunks);
    std::size_t at = 0, untried = chunks.size();
    while (untried > 0 && chunks.size() > 1) {
      at %= chunks.size();
      const std::optional<bool> fails = still_fails(joined_without(chunks, at));
      if (!fails) {
        found.items = joined(chunks);
        return found;
      }
      ++found.tests;
      --untried;
      if (!*fails) {
        ++at;
        continue;
      }
      chunks.erase(chunks.begin() + static_cast<std::ptrdiff_t>(at));
      // What could not be left out before may be now; of larger chunks the next level finds out.
      if (all_single(chunks)) untried = chunks.size();
    }
  }
  found.items = joined(chunks);
  found.complete = true;
  return found;
}

}  // namespace conebench::harness
