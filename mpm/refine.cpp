#include "mpm/refine.h"

namespace conebench::mpm {
namespace {

// Marks what is marked itself or touches, if only with a corner, a cell that is.
std::vector<bool> widened(const Grid& grid, const std::vector<bool>& marked) {
  std::vector<bool> out(marked.size(), false);
  const Eigen::Vector3i last = grid.cells.cwiseMax(1) - Eigen::Vector3i::Ones();
  for (int cell = 0; cell < grid.cell_count(); ++cell) {
    if (!marked[static_cast<std::size_t>(cell)]) continue;
    const Eigen::Vector3i at = grid.cell_place(cell);
    const Eigen::Vector3i low = (at - Eigen::Vector3i::Ones()).cwiseMax(0);
    const Eigen::Vector3i high = (at + Eigen::Vector3i::Ones()).cwiseMin(last);
    for (int z = low[2]; z <= high[2]; ++z) {
      for (int y = low[1]; y <= high[1]; ++y) {
        for (int x = low[0]; x <= high[0]; ++x) {
          out[static_cast<std::size_t>(grid.cell({x, y, z}))] = true;
        }
      }
    }
  }
  return out;
}

}  // namespace

std::vector<bool> boundary_cells(const Scene& scene, const Particles& particles) {
  const Grid& grid = scene.grid;
  const auto count = static_cast<std::size_t>(grid.cell_count());
  std::vector<double> solid(count, 0.0);
  std::vector<bool> sandy(count, false), open(count, false);
  for (std::size_t p = 0; p < particles.count(); ++p) {
    const auto cell = static_cast<std::size_t>(grid.cell(grid.cell_around(particles.position[p])));
    solid[cell] += particles.volume[p];
    sandy[cell] = true;
  }
  const double least = kOpenShare * scene.material.phi_max * grid.cell_volume();
  for (std::size_t cell = 0; cell < count; ++cell) open[cell] = solid[cell] < least;
  std::vector<bool> boundary = widened(grid, sandy);
  const std::vector<bool> near_open = widened(grid, open);
  for (std::size_t cell = 0; cell < count; ++cell) {
    boundary[cell] = boundary[cell] && near_open[cell];
  }
  return boundary;
}

Mesh mesh_for(const Scene& scene, const Particles& particles) {
  if (scene.grid.refine == Refine::kNone) return Mesh(scene.grid, {});
  return Mesh(scene.grid, boundary_cells(scene, particles));
}

}  // namespace conebench::mpm
