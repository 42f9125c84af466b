#include "dem/svg_frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "dem/svg_bodies.h"
#include "dem/svg_floors.h"

namespace conebench::dem {
namespace {

using Eigen::Vector3d;

constexpr double kMuchLarger = 3.0;  // than the room of the free bodies
constexpr double kAtRest = 1e-4;     // of the speed of a fall through the picture: seen as rest
constexpr double kRoom = 0.04;       // beside what is shown, of its larger side

std::size_t at(int i) { return static_cast<std::size_t>(i); }

// In the frame of the eye.
Eigen::AlignedBox3d box_of(std::span<const Solid> solids, const Bodies& bodies, int body,
                           const View& view) {
  const Pose eye{Vector3d::Zero(), Eigen::Quaterniond(view.axes)};
  const Pose pose = eye * bodies.pose(body);
  if (bodies.is_ball(body)) {
    const Vector3d reach = Vector3d::Constant(bodies.radius[at(body)]);
    return {pose.position - reach, pose.position + reach};
  }
  Eigen::AlignedBox3d box;
  for (const Part& part : solids[at(bodies.solid[at(body)])].parts) {
    const Bounds bounds = bounds_of(part.piece, pose * part.pose);
    box.extend(Eigen::AlignedBox3d(bounds.low, bounds.high));
  }
  return box;
}

template <class Visit>
void for_each_body(std::span<const Frame> frames, bool free, const Visit& visit) {
  for (const Frame& frame : frames) {
    for (int i = 0; i < frame.bodies.count(); ++i) {
      if (frame.bodies.is_free(i) == free) visit(frame.bodies, i);
    }
  }
}

void fit_window(std::span<const Solid> solids, std::span<const Frame> frames, View& view) {
  Eigen::AlignedBox3d shown;
  for_each_body(frames, true, [&](const Bodies& bodies, int i) {
    shown.extend(box_of(solids, bodies, i, view));
  });
  const double much = kMuchLarger * shown.sizes().maxCoeff();
  for_each_body(frames, false, [&](const Bodies& bodies, int i) {
    if (bodies.is_ball(i)) return;
    const Eigen::AlignedBox3d box = box_of(solids, bodies, i, view);
    if (box.sizes().maxCoeff() < much) shown.extend(box);
  });
  const double room = kRoom * shown.sizes().maxCoeff();
  view.low = shown.min().array() - room;
  view.high = shown.max().array() + room;
  view.widen();
}

void find_middle_and_fastest(const Vector3d& gravity, std::span<const Frame> frames, View& view) {
  double fastest = 0.0, count = 0.0;
  for_each_body(frames, true, [&](const Bodies& bodies, int i) {
    fastest = std::max(fastest, bodies.velocity[at(i)].norm());
    view.middle += bodies.position[at(i)];
    count += 1.0;
  });
  view.middle /= count;
  const double fall = std::sqrt(2.0 * gravity.norm() * (view.high[1] - view.low[1]));
  view.fastest_m_s = std::max(fastest, kAtRest * fall);
  if (view.fastest_m_s == 0.0) view.fastest_m_s = 1.0;
}

// Whether a part between the eye and the middle hides the centre of a free body.
bool hides(const std::vector<Face>& faces, const Bodies& bodies, const engine::Camera& camera) {
  for (const auto& [patch, seamless, before] : faces) {
    if (!before) continue;
    for (int i = 0; i < bodies.count(); ++i) {
      if (!bodies.is_free(i)) continue;
      const Vector3d place = camera.place(bodies.position[at(i)]);
      if (patch.is_before(place) && !clipped({place.head<2>()}, patch.contour).empty()) return true;
    }
  }
  return false;
}

void find_glass(std::span<const Solid> solids, std::span<const Frame> frames, View& view) {
  const engine::Camera camera(view);
  const SeenFaces faces(solids, camera.scale());
  view.glass.assign(at(frames[0].bodies.count()), false);
  for_each_body(frames, false, [&](const Bodies& bodies, int i) {
    if (bodies.is_ball(i) || view.glass[at(i)]) return;
    const std::vector<Face> seen =
        faces.of(bodies.solid[at(i)], bodies.pose(i), camera, view.middle);
    view.glass[at(i)] = hides(seen, bodies, camera);
  });
}

std::string caption(const Scene& scene, const Placement& start, double time_s, const View& view) {
  const bool held = std::any_of(start.planes.begin(), start.planes.end(), [&](const Plane& plane) {
    return std::isfinite(plane.until_s) && time_s < plane.until_s;
  });
  return engine::caption(
      {.title = scene.name,
       .moment = fmt::format("t = {:.3f} s{}", time_s, held ? ", held by walls" : ""),
       .meaning = "speed",
       .end = fmt::format("{:.2g} m/s", view.fastest_m_s)});
}

}  // namespace

View fit_view(const Scene& scene, std::span<const Solid> solids, std::span<const Frame> frames) {
  View view;
  view.axes = scene.dimension == 2 ? engine::level_axes(scene.gravity_m_s2)
                                   : engine::oblique_axes(scene.gravity_m_s2);
  fit_window(solids, frames, view);
  find_middle_and_fastest(scene.gravity_m_s2, frames, view);
  find_glass(solids, frames, view);
  return view;
}

std::string draw_svg(const Scene& scene, const Placement& start, const Frame& frame,
                     const View& view) {
  const engine::Camera camera(view);
  const BodiesDrawing bodies(start.solids, frame, view, camera);
  return engine::svg_start(camera.height_px()) + "<defs>\n" + bodies.gradients() +
         engine::scale_gradient() + "</defs>\n" +
         FloorsDrawing(start, frame, view, camera).floors() + bodies.bodies() +
         caption(scene, start, frame.time_s, view) + "</svg>\n";
}

}  // namespace conebench::dem
