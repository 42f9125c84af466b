#include <array>
#include <variant>

#include "dem/narrow_phase.h"
#include "problems/error.h"

namespace conebench::dem {
namespace {

using Eigen::Vector3d;

// Sine of the tilt below which all points of a cylinder's end are as low.
constexpr double kLevel = 1e-9;

// Of one piece at a pose, with the half-space below a plane.
struct PlaneTouches {
  const Pose& pose;
  const Vector3d& at;
  const Vector3d& normal;
  double reach;
  std::vector<Touch>& out;

  // `from_at`: a point of the surface, from the plane's point.
  void add(const Vector3d& from_at) const {
    const double gap = normal.dot(from_at);
    if (gap < reach) out.push_back({at + from_at - 0.5 * gap * normal, normal, gap});
  }

  Vector3d from_at(const Vector3d& local) const {
    return (pose.position - at) + pose.orientation * local;
  }

  void operator()(const Ball& ball) const {
    add(from_at(Vector3d::Zero()) - ball.radius_m * normal);
  }

  void operator()(const Box& box) const {
    for (int k = 0; k < 8; ++k) {
      const Vector3d corner(k & 1 ? 1.0 : -1.0, k & 2 ? 1.0 : -1.0, k & 4 ? 1.0 : -1.0);
      add(from_at(box.half_m.cwiseProduct(corner)));
    }
  }

  void operator()(const Hull& hull) const {
    for (const Vector3d& point : hull.points_m) add(from_at(point));
  }

  void operator()(const Capsule& capsule) const {
    for (const double end : {-capsule.half_length_m, capsule.half_length_m}) {
      add(from_at(end * Vector3d::UnitZ()) - capsule.radius_m * normal);
    }
  }

  void operator()(const Cylinder& cylinder) const {
    const Vector3d axis = pose.orientation * Vector3d::UnitZ();
    Vector3d down = axis * axis.dot(normal) - normal;
    down = down.norm() > kLevel ? down.normalized() : pose.orientation * Vector3d::UnitX();
    const Vector3d quarter = axis.cross(down);
    for (const double end : {-cylinder.half_length_m, cylinder.half_length_m}) {
      const Vector3d middle = from_at(end * Vector3d::UnitZ());
      for (const Vector3d& way : {down, quarter, Vector3d(-down), Vector3d(-quarter)}) {
        add(middle + cylinder.radius_m * way);
      }
    }
  }

  void operator()(const Mesh&) const {
    problems::require(false, "mesh", "a mesh meets a plane, expected a convex piece");
  }
};

}  // namespace

void plane_touches(const Piece& piece, const Pose& pose, const Vector3d& at, const Vector3d& normal,
                   double reach, std::vector<Touch>& out) {
  std::visit(PlaneTouches{pose, at, normal, reach, out}, piece);
}

}  // namespace conebench::dem
