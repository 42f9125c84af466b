#include "dem/row_table.h"

#include <bit>

namespace conebench::dem {

void RowTable::restart(std::size_t rows) {
  keys_.clear();
  slots_.assign(std::bit_ceil(2 * rows + 1), -1);
}

// Where the row is, or the free slot where it would be.
std::size_t RowTable::slot_of(const RowKey& key) const {
  // Odd multipliers spread neighbours; the high bits, which depend on all of a product, come down.
  const auto hash = static_cast<std::uint64_t>(key.level) * 0x165667B19E3779F9u ^
                    static_cast<std::uint64_t>(key.y) * 0x9E3779B97F4A7C15u ^
                    static_cast<std::uint64_t>(key.z) * 0xC2B2AE3D27D4EB4Fu;
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = static_cast<std::size_t>(hash ^ (hash >> 32)) & mask;
  while (slots_[slot] >= 0 && keys_[static_cast<std::size_t>(slots_[slot])] != key) {
    slot = (slot + 1) & mask;
  }
  return slot;
}

int RowTable::number(const RowKey& key) {
  std::int32_t& row = slots_[slot_of(key)];
  if (row < 0) {
    row = static_cast<std::int32_t>(keys_.size());
    keys_.push_back(key);
  }
  return row;
}

}  // namespace conebench::dem
