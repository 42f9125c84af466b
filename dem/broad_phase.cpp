#include "dem/broad_phase.h"

#include <algorithm>
#include <bit>
#include <numeric>

namespace conebench::dem {

std::size_t CellList::bucket_of(const Cell& cell) const {
  // Odd multipliers spread neighbouring cells; the table's size is a power of two.
  const auto hash = static_cast<std::uint64_t>(cell[0]) * 0x9E3779B97F4A7C15u ^
                    static_cast<std::uint64_t>(cell[1]) * 0xC2B2AE3D27D4EB4Fu ^
                    static_cast<std::uint64_t>(cell[2]) * 0x165667B19E3779F9u;
  return static_cast<std::size_t>(hash ^ (hash >> 32)) & (begin_.size() - 2);
}

void CellList::fill_table(std::span<const Eigen::Vector3d> positions, double width) {
  const std::size_t count = positions.size();
  const std::size_t buckets = std::bit_ceil(2 * count + 1);
  begin_.assign(buckets + 1, 0);
  cell_of_.resize(count);
  bucket_.resize(count);
  members_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    cell_of_[i] = (positions[i] / width).array().floor().cast<std::int64_t>();
    bucket_[i] = bucket_of(cell_of_[i]);
    ++begin_[bucket_[i]];
  }
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  // Now begin_[b] is the end of bucket b; filling it backwards makes it the beginning, and leaves
  // the members in increasing order.
  for (std::size_t i = count; i-- > 0;) {
    members_[static_cast<std::size_t>(--begin_[bucket_[i]])] = static_cast<std::int32_t>(i);
  }
}

void CellList::find_pairs(std::span<const Eigen::Vector3d> positions, std::span<const double> radii,
                          double margin, std::vector<BodyPair>& pairs) {
  pairs.clear();
  if (positions.empty()) return;
  const double largest = *std::max_element(radii.begin(), radii.end());
  fill_table(positions, 2.0 * largest + margin);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    for (int k = 0; k < 27; ++k) {
      const Cell cell = cell_of_[i] + Cell(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
      const std::size_t bucket = bucket_of(cell);
      for (auto m = begin_[bucket]; m < begin_[bucket + 1]; ++m) {
        const auto j = static_cast<std::size_t>(members_[static_cast<std::size_t>(m)]);
        if (j <= i || cell_of_[j] != cell) continue;
        const double reach = radii[i] + radii[j] + margin;
        if ((positions[i] - positions[j]).squaredNorm() >= reach * reach) continue;
        pairs.push_back({static_cast<int>(i), static_cast<int>(j)});
      }
    }
  }
  std::sort(pairs.begin(), pairs.end());
}

}  // namespace conebench::dem
