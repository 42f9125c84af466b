#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace conebench::dem {

struct BodyPair {
  int first = 0;  ///< < second
  int second = 0;
  auto operator<=>(const BodyPair&) const = default;
};

/// Finds neighbours among spheres: a uniform grid of cells as wide as the largest reach, hashed
/// into a table, so that space costs nothing and bodies may be anywhere.
///
/// Cost    O(n + pairs) for radii of one magnitude, sort of the pairs included for bounded
///         neighbour counts; many small spheres in one cell of a large one cost their square.
/// Memory  arrays are kept from call to call; no allocation once they have grown.
class CellList {
 public:
  /// Replaces `pairs` by all pairs with gap = |x_i - x_j| - R_i - R_j < margin, in increasing
  /// order. `margin` >= 0 [m].
  void find_pairs(std::span<const Eigen::Vector3d> positions, std::span<const double> radii,
                  double margin, std::vector<BodyPair>& pairs);

 private:
  using Cell = Eigen::Matrix<std::int64_t, 3, 1>;

  void fill_table(std::span<const Eigen::Vector3d> positions, double width);
  std::size_t bucket_of(const Cell& cell) const;

  std::vector<Cell> cell_of_;          // one a body
  std::vector<std::size_t> bucket_;    // one a body
  std::vector<std::int32_t> begin_;    // first member of each bucket, and the end
  std::vector<std::int32_t> members_;  // bodies, bucket by bucket
};

}  // namespace conebench::dem
