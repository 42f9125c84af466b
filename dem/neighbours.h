#pragma once

#include <span>
#include <vector>

#include "dem/bodies.h"
#include "dem/hierarchical_grid.h"
#include "dem/narrow_phase.h"
#include "dem/placement.h"

namespace conebench::dem {

/// A contact point of two bodies, or of a body and a plane.
struct Near {
  int body = 0;
  int other = 0;  ///< > body
  Touch touch;    ///< normal from `other` towards `body`
};

/// Finds what touches: broad phase over balls and boxes about pieces, then balls by hand and the
/// rest by NarrowPhase.
///
/// In two dimensions touches lie in the plane y = 0: those that face along y are none, and those
/// that differ in y alone are one.
///
/// Cost: linear in bodies and pairs; each plane looks at every body.
class Neighbours {
 public:
  Neighbours(const Placement& placement, int dimension);

  /// Replaces `found` by all touches with gap < reach at `time_s` (planes go at their time) of
  /// which at least one body is free; ordered by body, then other.
  void find(const Bodies& bodies, double reach_m, double time_s, std::vector<Near>& found);

 private:
  struct Proxy {
    int body = 0;
    int part = 0;
  };

  void bound_parts(const Bodies& bodies);
  void add_ball_pairs(const Bodies& bodies, double reach, std::vector<Near>& found);
  void add_ball_parts(const Bodies& bodies, double reach, std::vector<Near>& found);
  void add_part_pairs(const Bodies& bodies, double reach, std::vector<Near>& found);
  void add_planes(const Bodies& bodies, double reach, double time_s, std::vector<Near>& found);
  void append(int body, int other, std::vector<Near>& found);
  const Solid& solid_of(const Bodies& bodies, int body) const;
  Pose part_pose(const Bodies& bodies, const Proxy& proxy) const;
  int piece_of(const Bodies& bodies, const Proxy& proxy) const;

  std::vector<Solid> solids_;
  std::vector<double> until_s_;  // of each plane
  int dimension_;
  NarrowPhase narrow_;
  HierarchicalGrid grid_;
  std::vector<Proxy> proxies_;  // one a part of all bodies that are not balls
  std::vector<Bounds> bounds_;
  Candidates candidates_;
  std::vector<Touch> touches_;
};

}  // namespace conebench::dem
