#pragma once

#include <span>
#include <vector>

#include "dem/pair_list.h"
#include "dem/row_order.h"
#include "dem/row_table.h"
#include "dem/shape.h"

namespace conebench::dem {

/// Pairs that may touch, each once and in increasing order.
struct Candidates {
  std::vector<BodyPair> balls;     ///< first < second
  std::vector<BodyPair> ball_box;  ///< first: the ball, second: the box
  std::vector<BodyPair> boxes;     ///< first < second
};

/// Finds neighbours among things of any mix of sizes, anywhere in space.
///
/// Things of one size (within a factor of 2) are a level. A level cuts space into rows: columns
/// along x, as wide as its largest thing and the margin. Rows that hold something are kept in a
/// hash table; a thing lies in the row of its centre, and a row is in order of x. What a thing may
/// touch is then in the 3 x 3 rows around it, in a window of x: each row is swept against itself
/// and half of the rows around it on its own level, and against those around it on each coarser
/// one. A long or flat box is on the level of its longest side, and is tested by its own bounds
/// against the rows below it, so that it meets only what is beside it.
///
/// Cost    O(n log n + n levels + pairs). Boxes of one level see each other as cubes of their
///         longest side would. `build/broad_phase_benchmark` measures it.
/// Memory  92 to 108 bytes a ball, 32 a row, and, when they grow, 8 to 16 a pair, beside the
///         results. Arrays are kept from call to call: no allocation once they have grown.
class HierarchicalGrid {
 public:
  /// Replaces `out`.
  ///
  /// balls     pairs with gap = |x_i - x_j| - R_i - R_j < margin [m]. A body with radius < 0 is no
  ///           ball and is passed over, wherever its centre is.
  /// ball_box  pairs where the box around the ball is closer to the box than margin on each axis.
  /// boxes     pairs of boxes that are closer than margin on each axis.
  ///
  /// Precondition: as many centres as radii.
  /// Errors: InputError for a margin that is negative or not finite, and naming a ball or a box
  /// that is not finite or is 1e100 m away, or a box with low > high.
  void find_pairs(std::span<const Eigen::Vector3d> centres, std::span<const double> radii,
                  std::span<const Bounds> boxes, double margin, Candidates& out);

 private:
  struct Ball {
    Eigen::Vector3d centre;
    double radius;
    int index;

    double x() const { return centre.x(); }
  };
  struct Box {
    Bounds bounds;
    int index;

    double x() const { return 0.5 * bounds.low.x() + 0.5 * bounds.high.x(); }
  };
  static Bounds around(const Ball& ball) {
    return {ball.centre.array() - ball.radius, ball.centre.array() + ball.radius};
  }
  static const Bounds& around(const Box& box) { return box.bounds; }

  double size_of(double extent, const Eigen::Vector3d& centre) const;
  void measure();
  void choose_levels();
  int row_of(double size, const Eigen::Vector3d& centre);
  void place_things();

  void sweep_level(int row);
  void sweep_coarser(int row, std::size_t level);
  template <class A, class B>
  void sweep(std::span<const A> as, std::span<const B> bs, double width);
  template <class Thing>
  void sweep_itself(std::span<const Thing> things, double width);
  template <class Small, class Large>
  void sweep_sizes(const RowKey& row, std::span<const Small> small, std::span<const Large> large,
                   double large_width);
  template <class Thing>
  Bounds reach_of(const Thing& thing, double width) const;

  void meet(const Ball& a, const Ball& b);
  void meet(const Ball& a, const Box& b);
  void meet(const Box& a, const Ball& b) { meet(b, a); }
  void meet(const Box& a, const Box& b);

  // What find_pairs was called with.
  std::span<const Eigen::Vector3d> centres_;
  std::span<const double> radii_;
  std::span<const Bounds> boxes_;
  double margin_ = 0.0;

  std::vector<double> sizes_;  // of all bodies, then of the boxes
  std::vector<double> width_;  // of each level's rows, decreasing
  RowTable rows_;
  RowOrder<Ball> balls_in_rows_;
  RowOrder<Box> boxes_in_rows_;
  PairList ball_pairs_, ball_box_pairs_, box_pairs_;
};

}  // namespace conebench::dem
