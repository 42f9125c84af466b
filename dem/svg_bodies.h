#pragma once

#include <set>
#include <string>
#include <vector>

#include "dem/seen_faces.h"
#include "dem/svg_frame.h"

namespace conebench::dem {

/// Balls and solids of a frame as SVG. Internal to svg_frame.cpp.
class BodiesDrawing {
 public:
  /// Keeps references to all but `solids`.
  BodiesDrawing(std::span<const Solid> solids, const Frame& frame, const View& view,
                const engine::Camera& camera);

  /// What lies in the picture, far things first: a circle a ball, strokes that grow lighter a
  /// capsule, a polygon a face.
  std::string bodies() const;

  /// The gradients that bodies() refers to; they belong between <defs> and </defs>.
  std::string gradients() const;

 private:
  static constexpr int kGrey = -1;

  void add_body(int body);
  void add_ball(const Eigen::Vector3d& centre_m, double radius_m, int colour);
  void add_capsule(const Capsule& capsule, const Pose& pose, int colour);
  void add_face(Face face, int colour, bool glass);
  void add(Patch patch, std::string svg);
  int colour_of(int body) const;

  std::vector<Solid> solids_;
  const Frame& frame_;
  const View& view_;
  const engine::Camera& camera_;
  SeenFaces faces_;
  std::vector<Patch> patches_;
  std::vector<std::string> drawn_;  // of each patch
  std::set<int> gradients_;         // colours
};

}  // namespace conebench::dem
