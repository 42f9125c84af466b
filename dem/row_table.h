#pragma once

#include <cstdint>
#include <vector>

namespace conebench::dem {

/// A column of space along x: which one, on which level.
struct RowKey {
  std::int64_t level = 0, y = 0, z = 0;
  bool operator==(const RowKey&) const = default;
};

/// Numbers rows from 0 in the order in which they are asked for: an open-addressed hash table, so
/// that only rows with something in them cost anything.
class RowTable {
 public:
  /// Empty, with room for `rows`. Cost: one pass over 8 to 16 bytes a row.
  void restart(std::size_t rows);

  /// The number of a row, a new one if need be. No more than `rows` different ones.
  int number(const RowKey& key);
  /// The number of a row, -1 if it has none.
  int find(const RowKey& key) const { return slots_[slot_of(key)]; }

  const std::vector<RowKey>& keys() const { return keys_; }

 private:
  std::size_t slot_of(const RowKey& key) const;

  std::vector<RowKey> keys_;
  std::vector<std::int32_t> slots_;  // a row's number, or -1; a power of two, at most half full
};

}  // namespace conebench::dem
