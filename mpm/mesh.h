#pragma once

#include <bit>
#include <cstddef>
#include <vector>

#include "mpm/grid.h"

namespace conebench::mpm {

/// The cells of one step: those of a scene's grid, some of them cut in half along each axis.
///
/// Fields are continuous and (bi-, tri-)linear on whole cells and on halves. Nodes have the numbers
/// of grid(), the grid of the halves; where the scene's grid is not refined, of that grid itself.
/// A node that lies on an edge, on a face or in the middle of a whole cell *hangs*: it is none of
/// the unknowns; fields have there the mean of the corners of that edge (2), face (4) or cell (8).
///
/// Cost: a few operations a node of grid() to make; linear in them in memory.
class Mesh {
 public:
  Mesh() = default;

  /// `cut` has an entry a cell of the scene's grid. Where that grid is not refined it is not looked
  /// at, and may be empty.
  Mesh(const Grid& scene_grid, std::vector<bool> cut);

  const Grid& grid() const { return grid_; }
  const std::vector<bool>& cut() const { return cut_; }
  bool regular() const { return hangs_.empty(); }  ///< the scene's grid is not refined
  bool hangs(int node) const { return !regular() && hangs_[static_cast<std::size_t>(node)] != 0; }

  /// Two nodes of one cell are at most this many steps of grid() apart along an axis.
  int reach() const { return regular() ? 1 : 2; }

  /// The next node from one that does not hang, `step` being 1 or -1 along the axis. Precondition:
  /// the node has an even place on the axis, and there is one beyond it.
  int next(int node, int axis, int step) const;

  /// The integral of something over the mesh times the shape function of a node that does not hang;
  /// `f(i)` is that for the shape function of node i on grid(). The one is the sum of the other of
  /// the node and of those that hang on it.
  template <class F>
  double integral(int node, const F& f) const;

  /// The integral of the node's shape function [m3, per metre in 2D].
  double node_volume(int node) const {
    return integral(node, [this](int i) { return grid_.node_volume(i); });
  }

  /// A stencil of grid() made one of the mesh: hanging nodes hand their weights and gradients on,
  /// and the far corner that no other node of the stencil is takes their place.
  template <int D>
  void hand_on(Stencil<D>& s) const;

 private:
  Grid grid_;
  std::vector<bool> cut_;
  std::vector<char> hangs_;  // of every node of grid_; empty: none
};

/// Of a point in a whole cell its corners; in a half, again 2^D nodes, whatever hangs.
template <int D>
Stencil<D> stencil_at(const Mesh& mesh, const Eigen::Vector3d& x) {
  Stencil<D> s = stencil_at<D>(mesh.grid(), x);
  if (!mesh.regular()) mesh.hand_on<D>(s);
  return s;
}

template <class F>
double Mesh::integral(int node, const F& f) const {
  double total = f(node);
  if (regular()) return total;
  const Eigen::Vector3i at = grid_.place(node);
  const bool corner = ((at[0] | at[1] | at[2]) & 1) == 0;
  if (!corner) return total;
  const int around = grid_.dim == 2 ? 9 : 27;
  for (int k = 0; k < around; ++k) {
    const Eigen::Vector3i step(k % 3 - 1, k / 3 % 3 - 1, grid_.dim == 2 ? 0 : k / 9 - 1);
    const Eigen::Vector3i place = at + step;
    if ((place.array() < 0).any() || (place.array() > grid_.cells.array()).any()) continue;
    const int other = grid_.node(place);
    if (hangs(other)) total += f(other) / (1 << step.cwiseAbs().sum());
  }
  return total;
}

// Each half has one vertex that is a corner of its cell. From there, a node that is `away` along
// some axes lies in the middle of the edge, face or cell that these axes span. Where it hangs, so
// do those of fewer of these axes, which come first: each then stands for the corner twice as far.
template <int D>
void Mesh::hand_on(Stencil<D>& s) const {
  const Eigen::Vector3i lowest = grid_.place(s.node[0]);
  const std::array<int, 3> stride = {1, grid_.cells[0] + 1,
                                     (grid_.cells[0] + 1) * (grid_.cells[1] + 1)};
  std::size_t corner = 0;
  for (std::size_t a = 0; a < D; ++a) {
    corner |= static_cast<std::size_t>(lowest[static_cast<Eigen::Index>(a)] & 1) << a;
  }
  for (std::size_t away = 1; away < Stencil<D>::kNodes; ++away) {
    const std::size_t slot = corner ^ away;
    if (!hangs(s.node[slot])) continue;
    const double share = 1.0 / (1 << std::popcount(away));
    s.weight[slot] *= share;
    s.gradient[slot] *= share;
    for (std::size_t part = 0; part < away; ++part) {
      if ((part & away) != part) continue;
      s.weight[corner ^ part] += s.weight[slot];
      s.gradient[corner ^ part] += s.gradient[slot];
    }
    for (std::size_t a = 0; a < D; ++a) {
      if ((away >> a & 1) == 0) continue;
      const int step = (corner >> a & 1) == 0 ? 1 : -1;
      s.node[slot] += step * stride[a];
      s.reach[slot][static_cast<Eigen::Index>(a)] += step * grid_.spacing(static_cast<int>(a));
    }
  }
}

}  // namespace conebench::mpm
