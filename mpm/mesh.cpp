#include "mpm/mesh.h"

#include <utility>

namespace conebench::mpm {

Mesh::Mesh(const Grid& scene_grid, std::vector<bool> cut) : grid_(scene_grid.finest()) {
  if (scene_grid.refine == Refine::kNone) return;
  cut_ = std::move(cut);
  hangs_.assign(static_cast<std::size_t>(grid_.node_count()), 0);
  const int places = grid_.dim == 2 ? 9 : 27;  // of the halves' nodes on a cell
  for (int cell = 0; cell < scene_grid.cell_count(); ++cell) {
    if (cut_[static_cast<std::size_t>(cell)]) continue;
    const Eigen::Vector3i lowest = 2 * scene_grid.cell_place(cell);
    for (int k = 0; k < places; ++k) {
      const Eigen::Vector3i step(k % 3, k / 3 % 3, k / 9);
      if (((step[0] | step[1] | step[2]) & 1) == 0) continue;
      hangs_[static_cast<std::size_t>(grid_.node(lowest + step))] = 1;
    }
  }
}

int Mesh::next(int node, int axis, int step) const {
  Eigen::Vector3i at = grid_.place(node);
  at[axis] += step;
  if (hangs(grid_.node(at))) at[axis] += step;
  return grid_.node(at);
}

}  // namespace conebench::mpm
