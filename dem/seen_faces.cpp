#include "dem/seen_faces.h"

#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <optional>

namespace conebench::dem {
namespace {

using Eigen::Vector3d;

constexpr double kRoundness_px = 0.25;  // how far facets lie inside a circle, about
constexpr double kLeast = 12.0, kMost = 64.0;
// A face that is turned away by this angle from the plane of the picture is its own edge.
constexpr double kEdgeOn_rad = 1e-4;

int facets_around(double radius_px) {
  const double count = std::numbers::pi * std::sqrt(0.5 * radius_px / kRoundness_px);
  return 4 * static_cast<int>(std::ceil(0.25 * std::clamp(count, kLeast, kMost)));
}

// What a flat polygon covers of the picture, where its front, or any side of it, is to be seen.
std::optional<Patch> seen_patch(std::vector<Vector3d> corners, bool both_sides) {
  Vector3d normal = Vector3d::Zero();  // to the eye: z < 0, as y goes downwards
  for (std::size_t k = 2; k < corners.size(); ++k) {
    normal += (corners[k - 1] - corners[0]).cross(corners[k] - corners[0]);
  }
  if (std::abs(normal[2]) <= kEdgeOn_rad * normal.norm()) return {};
  if (normal[2] > 0.0) {
    if (!both_sides) return {};
    std::reverse(corners.begin(), corners.end());
  }
  Patch patch;
  patch.slope << -normal[0] / normal[2], -normal[1] / normal[2], normal.dot(corners[0]) / normal[2];
  patch.farthest = std::numeric_limits<double>::infinity();
  patch.nearest = -patch.farthest;
  for (const Vector3d& corner : corners) {
    patch.contour.push_back(corner.head<2>());
    patch.farthest = std::min(patch.farthest, corner[2]);
    patch.nearest = std::max(patch.nearest, corner[2]);
  }
  return patch;
}

// Cosine between its normal and the direction to the eye.
double facing(const Patch& patch) { return 1.0 / std::hypot(1.0, patch.slope[0], patch.slope[1]); }

}  // namespace

SeenFaces::SeenFaces(std::span<const Solid> solids, double scale_px_m) {
  for (const Solid& solid : solids) {
    std::vector<Surface>& surfaces = surfaces_.emplace_back();
    for (const Part& part : solid.parts) {
      if (std::holds_alternative<Ball>(part.piece)) continue;
      if (std::holds_alternative<Capsule>(part.piece)) continue;
      const auto* cylinder = std::get_if<Cylinder>(&part.piece);
      const int around = facets_around(cylinder ? scale_px_m * cylinder->radius_m : 0.0);
      Surface surface{facets(part.piece, around), std::holds_alternative<Mesh>(part.piece),
                      cylinder != nullptr};
      for (Vector3d& vertex : surface.polyhedron.vertices) vertex = part.pose * vertex;
      surfaces.push_back(std::move(surface));
    }
  }
}

std::vector<Face> SeenFaces::of(int solid, const Pose& pose, const engine::Camera& camera,
                                const Vector3d& middle_m) const {
  std::vector<Face> out;
  for (const Surface& surface : surfaces_[static_cast<std::size_t>(solid)]) {
    std::vector<Face> faces = seen(surface, pose, camera, middle_m);
    std::move(faces.begin(), faces.end(), std::back_inserter(out));
  }
  return out;
}

std::vector<Face> SeenFaces::seen(const Surface& surface, const Pose& pose,
                                  const engine::Camera& camera, const Vector3d& middle_m) {
  std::vector<Vector3d> places;
  for (const Vector3d& x : surface.polyhedron.vertices) places.push_back(camera.place(pose * x));
  const Vector3d middle = camera.place(middle_m);
  std::vector<Face> out;
  double before = 0.0;  // area
  for (const std::vector<int>& face : surface.polyhedron.faces) {
    std::vector<Vector3d> corners;
    for (const int k : face) corners.push_back(places[static_cast<std::size_t>(k)]);
    auto patch = seen_patch(std::move(corners), surface.mesh);
    if (!patch) continue;
    const bool seamless = surface.mesh || (surface.cylinder && face.size() == 4);
    const bool is_before = patch->is_before(middle);
    before += (is_before ? 1.0 : -1.0) * area(patch->contour) / facing(*patch);
    out.push_back({*std::move(patch), seamless, is_before});
  }
  if (!surface.mesh) {
    for (Face& face : out) face.before = before > 0.0;
  }
  return out;
}

}  // namespace conebench::dem
