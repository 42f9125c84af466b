#pragma once

#include <string>

#include "dem/paint_order.h"
#include "dem/svg_frame.h"

namespace conebench::dem {

/// The planes of a frame as SVG, below what stands on them. Internal to svg_frame.cpp.
class FloorsDrawing {
 public:
  /// Keeps references to all.
  FloorsDrawing(const Placement& start, const Frame& frame, const View& view,
                const engine::Camera& camera);

  /// Floors below what is shown with the shadows of free bodies, in light that falls aslant; and
  /// what is behind planes that are seen edge-on.
  std::string floors() const;

 private:
  struct Floor {
    Eigen::Vector3d point, normal;
  };

  bool is_lit(const Floor& floor) const;
  Eigen::Vector3d cast(const Floor& floor, const Eigen::Vector3d& x) const;
  std::string ground_behind(const Floor& plane) const;
  std::string ground_below(const Floor& floor) const;
  std::string shadow(const Floor& floor, int body) const;
  std::string shadow_of_ball(const Floor& floor, const Eigen::Vector3d& centre_m,
                             double radius_m) const;
  std::string shadow_of_piece(const Floor& floor, const Piece& piece, const Pose& pose) const;

  const Placement& start_;
  const Frame& frame_;
  const View& view_;
  const engine::Camera& camera_;
  Contour picture_;
};

}  // namespace conebench::dem
