#include "dem/export.h"

namespace conebench::dem {
namespace {

using problems::Geometry;

Geometry geometry_of(const StepView& view, int dimension) {
  const Bodies& bodies = *view.before;
  const auto cones = static_cast<Eigen::Index>(view.entered.size());
  Geometry geometry;
  geometry.points.resize(cones, 3);
  geometry.frames.resize(cones, 9);
  geometry.bodies_of_cone.resize(cones, 2);
  for (Eigen::Index i = 0; i < cones; ++i) {
    const auto index = static_cast<std::size_t>(view.entered[static_cast<std::size_t>(i)]);
    const Contact& contact = view.contacts->contacts()[index];
    geometry.points.row(i) = contact.point;
    const Eigen::Matrix3d frame = frame_of(contact, dimension);
    for (int k = 0; k < 3; ++k) geometry.frames.row(i).segment(3 * k, 3) = frame.col(k);
    geometry.bodies_of_cone(i, 0) = contact.body;
    geometry.bodies_of_cone(i, 1) = bodies.is_plane(contact.other) ? -1 : contact.other;
  }
  geometry.body_positions.resize(bodies.count(), 3);
  geometry.body_radii.resize(bodies.count());
  for (int i = 0; i < bodies.count(); ++i) {
    const auto b = static_cast<std::size_t>(i);
    geometry.body_positions.row(i) = bodies.position[b];
    geometry.body_radii[i] = bodies.is_ball(i) ? bodies.radius[b] : 0.0;
  }
  return geometry;
}

}  // namespace

problems::Problem make_problem(const Scene& scene, std::int64_t step, Assembly& assembly) {
  return problems::Problem(std::move(assembly.data), std::move(assembly.cones),
                           engine::step_metadata(scene, "dem", step, scene.step_s));
}

void Exporter::operator()(const StepView& view) {
  write_if_selected(view, [&] { return geometry_of(view, view.dimension); });
}

}  // namespace conebench::dem
