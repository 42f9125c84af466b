#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

#include "mpm/tensor.h"

namespace conebench::mpm {

/// Where a grid's cells are cut in half along each axis; mesh.h says what that means.
enum class Refine { kNone, kBoundary };

/// A regular grid of cells; velocities and stresses live at its vertices, the nodes.
///
/// In two dimensions everything is per metre of thickness, the third coordinate is 0 and
/// cells[2] = 0. Nodes are numbered along x first, then y, then z.
struct Grid {
  int dim = 2;
  Eigen::Vector3i cells = Eigen::Vector3i::Zero();
  Eigen::Vector3d low_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();
  Refine refine = Refine::kNone;  ///< kBoundary: halves where the heap ends, anew in every step

  /// The grid of the smallest cells, not refined any further: this one, or that of its halves.
  Grid finest() const {
    Grid fine = *this;
    fine.refine = Refine::kNone;
    if (refine != Refine::kNone) fine.cells *= 2;
    return fine;
  }

  double spacing(int axis) const { return size_m[axis] / cells[axis]; }
  double smallest_spacing() const {
    double smallest = spacing(0);
    for (int a = 1; a < dim; ++a) smallest = std::min(smallest, spacing(a));
    return smallest;
  }
  double cell_volume() const {
    double volume = 1.0;
    for (int a = 0; a < dim; ++a) volume *= spacing(a);
    return volume;
  }
  int cell_count() const { return cells.cwiseMax(1).prod(); }
  int cell(const Eigen::Vector3i& at) const {
    return at[0] + cells[0] * (at[1] + cells[1] * at[2]);
  }
  Eigen::Vector3i cell_place(int cell) const {
    const int rest = cell / cells[0];
    return {cell % cells[0], rest % cells[1], rest / cells[1]};
  }
  /// Precondition: the grid contains x. A point on a face between two cells belongs to the upper
  /// one.
  Eigen::Vector3i cell_around(const Eigen::Vector3d& x) const {
    Eigen::Vector3i at = Eigen::Vector3i::Zero();
    for (int a = 0; a < dim; ++a) {
      const double place = (x[a] - low_m[a]) * (cells[a] / size_m[a]);
      at[a] = std::clamp(static_cast<int>(place), 0, cells[a] - 1);
    }
    return at;
  }

  int node_count() const { return (cells[0] + 1) * (cells[1] + 1) * (cells[2] + 1); }

  int node(const Eigen::Vector3i& at) const {
    return at[0] + (cells[0] + 1) * (at[1] + (cells[1] + 1) * at[2]);
  }
  Eigen::Vector3i place(int node) const {
    const int x = node % (cells[0] + 1), rest = node / (cells[0] + 1);
    return {x, rest % (cells[1] + 1), rest / (cells[1] + 1)};
  }
  Eigen::Vector3d position(int node) const {
    const Eigen::Vector3i at = place(node);
    Eigen::Vector3d x = Eigen::Vector3d::Zero();
    for (int a = 0; a < dim; ++a) x[a] = low_m[a] + at[a] * spacing(a);
    return x;
  }
  /// The integral of the node's shape function over the grid [m3, per metre in 2D].
  double node_volume(int node) const {
    const Eigen::Vector3i at = place(node);
    double volume = cell_volume();
    for (int a = 0; a < dim; ++a) {
      if (at[a] == 0 || at[a] == cells[a]) volume *= 0.5;
    }
    return volume;
  }
  bool contains(const Eigen::Vector3d& x) const {
    for (int a = 0; a < dim; ++a) {
      if (!(x[a] >= low_m[a] && x[a] <= low_m[a] + size_m[a])) return false;
    }
    return true;
  }
};

/// The nodes around a point, with the values and gradients of their (bi-, tri-)linear shape
/// functions there. Node k of a cell is its lowest one, moved along axis a where bit a of k is set.
template <int D>
struct Stencil {
  static constexpr int kNodes = 1 << D;
  std::array<int, kNodes> node;
  std::array<double, kNodes> weight;
  std::array<Vec<D>, kNodes> gradient;  ///< [1/m]
  std::array<Vec<D>, kNodes> reach;     ///< x_node - x [m]
};

/// Of the cell around x; precondition: the grid contains x.
template <int D>
Stencil<D> stencil_at(const Grid& grid, const Eigen::Vector3d& x) {
  Eigen::Vector3i cell = Eigen::Vector3i::Zero();
  Vec<D> share, scale;
  for (int a = 0; a < D; ++a) {
    scale[a] = grid.cells[a] / grid.size_m[a];
    const double place = (x[a] - grid.low_m[a]) * scale[a];
    cell[a] = std::clamp(static_cast<int>(place), 0, grid.cells[a] - 1);
    share[a] = place - cell[a];
  }
  const int row = grid.cells[0] + 1, layer = row * (grid.cells[1] + 1);
  const int lowest = grid.node(cell);
  Stencil<D> out;
  for (int k = 0; k < Stencil<D>::kNodes; ++k) {
    const auto slot = static_cast<std::size_t>(k);
    out.node[slot] = lowest + (k & 1) + (k & 2 ? row : 0) + (k & 4 ? layer : 0);
    double weight = 1.0;
    Vec<D> gradient = Vec<D>::Ones(), reach;
    for (int a = 0; a < D; ++a) {
      const bool upper = (k >> a) & 1;
      const double value = upper ? share[a] : 1.0 - share[a];
      reach[a] = (upper ? 1.0 - share[a] : -share[a]) / scale[a];
      weight *= value;
      for (int b = 0; b < D; ++b) gradient[b] *= a == b ? (upper ? scale[a] : -scale[a]) : value;
    }
    out.weight[slot] = weight;
    out.gradient[slot] = gradient;
    out.reach[slot] = reach;
  }
  return out;
}

}  // namespace conebench::mpm
