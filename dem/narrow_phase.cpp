#include "dem/narrow_phase.h"

#include <algorithm>
#include <variant>

#include "dem/closest_points.h"
#include "dem/manifold.h"
#include "dem/mesh_touches.h"
#include "dem/point_distance.h"
#include "dem/surface_mesh.h"
#include "problems/error.h"

namespace conebench::dem {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Prepared = std::variant<Convex, SurfaceMesh>;

Prepared prepare(const Piece& piece) {
  if (const auto* mesh = std::get_if<Mesh>(&piece)) return SurfaceMesh(*mesh);
  return make_convex(piece);
}

bool is_ball(const Prepared& prepared) {
  const auto* convex = std::get_if<Convex>(&prepared);
  return convex != nullptr && convex->points.size() == 1;
}

Vector3d centre_of(const Convex& convex, const Pose& pose) { return pose * convex.centre; }

// From the second's place to the first's, without the digits that they share.
Vector3d apart(const Convex& first, const Pose& first_pose, const Convex& second,
               const Pose& second_pose) {
  return (first_pose.position - second_pose.position) +
         (first_pose.orientation * first.centre - second_pose.orientation * second.centre);
}

void turn_round(std::vector<Touch>& touches, std::size_t begin) {
  for (std::size_t k = begin; k < touches.size(); ++k) touches[k].normal = -touches[k].normal;
}

}  // namespace

class NarrowPhase::Library {
 public:
  explicit Library(std::span<const Piece> pieces) {
    for (const Piece& piece : pieces) pieces_.push_back(prepare(piece));
  }

  MeshTouches& with_mesh() { return with_mesh_; }
  const Prepared& piece(int index) const { return pieces_[static_cast<std::size_t>(index)]; }

  void convex_touches(const Convex& first, const Pose& first_pose, const Convex& second,
                      const Pose& second_pose, double reach, std::vector<Touch>& out) {
    const Vector3d way = apart(first, first_pose, second, second_pose);
    if (way.norm() - first.extent - second.extent >= reach) return;
    const double unit = std::min(first.extent, second.extent);
    first_.place(first, way / unit, first_pose.orientation.toRotationMatrix(), unit);
    second_.place(second, Vector3d::Zero(), second_pose.orientation.toRotationMatrix(), unit);
    const std::size_t begin = out.size();
    manifold_.add(first_, second_, closest_points(first_, second_), reach / unit, nullptr, out);
    const Vector3d origin = centre_of(second, second_pose);
    for (std::size_t k = begin; k < out.size(); ++k) {
      out[k].point = origin + unit * out[k].point;
      out[k].gap *= unit;
    }
  }

  void ball_convex_touch(const Vector3d& centre, double radius, const Convex& second,
                         const Pose& second_pose, double reach, std::vector<Touch>& out) const {
    const Matrix3d turn = second_pose.orientation.toRotationMatrix();
    const Vector3d from_second = centre - second_pose.position;
    const PointDistance nearest =
        point_distance(second, turn.transpose() * from_second - second.centre);
    const double gap = nearest.distance - radius;
    if (!(gap < reach)) return;
    const Vector3d normal = turn * nearest.normal;
    out.push_back({centre - (radius + 0.5 * gap) * normal, normal, gap});
  }

 private:
  std::vector<Prepared> pieces_;
  Placed first_, second_;
  Manifold manifold_;
  MeshTouches with_mesh_;
};

NarrowPhase::NarrowPhase(std::span<const Piece> pieces)
    : library_(std::make_unique<Library>(pieces)) {}
NarrowPhase::~NarrowPhase() = default;
NarrowPhase::NarrowPhase(NarrowPhase&&) noexcept = default;
NarrowPhase& NarrowPhase::operator=(NarrowPhase&&) noexcept = default;

void NarrowPhase::touches(int first, const Pose& first_pose, int second, const Pose& second_pose,
                          double reach, std::vector<Touch>& out) {
  const Prepared &a = library_->piece(first), &b = library_->piece(second);
  const auto *convex_a = std::get_if<Convex>(&a), *convex_b = std::get_if<Convex>(&b);
  problems::require(convex_a != nullptr || convex_b != nullptr, "narrow phase", "pieces ", first,
                    " and ", second, " are meshes, expected at most one");
  const std::size_t begin = out.size();
  if (is_ball(a)) {
    ball_touches(centre_of(*convex_a, first_pose), convex_a->radius, second, second_pose, reach,
                 out);
  } else if (is_ball(b)) {
    ball_touches(centre_of(*convex_b, second_pose), convex_b->radius, first, first_pose, reach,
                 out);
    turn_round(out, begin);
  } else if (convex_a == nullptr) {
    library_->with_mesh().add(*convex_b, second_pose, std::get<SurfaceMesh>(a), first_pose, reach,
                              out);
    turn_round(out, begin);
  } else if (convex_b == nullptr) {
    library_->with_mesh().add(*convex_a, first_pose, std::get<SurfaceMesh>(b), second_pose, reach,
                              out);
  } else {
    library_->convex_touches(*convex_a, first_pose, *convex_b, second_pose, reach, out);
  }
}

void NarrowPhase::ball_touches(const Vector3d& centre, double radius, int second,
                               const Pose& second_pose, double reach, std::vector<Touch>& out) {
  const Prepared& piece = library_->piece(second);
  if (const auto* convex = std::get_if<Convex>(&piece)) {
    library_->ball_convex_touch(centre, radius, *convex, second_pose, reach, out);
  } else {
    library_->with_mesh().add_ball(centre, radius, std::get<SurfaceMesh>(piece), second_pose, reach,
                                   out);
  }
}

}  // namespace conebench::dem
