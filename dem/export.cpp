#include "dem/export.h"

#include <fmt/format.h>

#include "problems/engine/text_file.h"
#include "problems/problem_file.h"
#include "problems/residual.h"

namespace conebench::dem {
namespace {

using problems::Geometry;

Geometry geometry_of(const StepView& view) {
  const auto cones = static_cast<Eigen::Index>(view.entered.size());
  Geometry geometry;
  geometry.points.resize(cones, 3);
  geometry.frames.resize(cones, 9);
  geometry.bodies_of_cone.resize(cones, 2);
  for (Eigen::Index i = 0; i < cones; ++i) {
    const auto index = static_cast<std::size_t>(view.entered[static_cast<std::size_t>(i)]);
    const Contact& contact = view.contacts->contacts()[index];
    geometry.points.row(i) = contact.point;
    for (int k = 0; k < 3; ++k) geometry.frames.row(i).segment(3 * k, 3) = contact.frame.col(k);
    geometry.bodies_of_cone(i, 0) = contact.body;
    geometry.bodies_of_cone(i, 1) = contact.with_plane() ? -1 : contact.other;
  }
  const Spheres& spheres = *view.before;
  geometry.body_positions.resize(spheres.count(), 3);
  geometry.body_radii.resize(spheres.count());
  for (int i = 0; i < spheres.count(); ++i) {
    geometry.body_positions.row(i) = spheres.position[static_cast<std::size_t>(i)];
    geometry.body_radii[i] = spheres.radius[static_cast<std::size_t>(i)];
  }
  return geometry;
}

problems::Solution solution_of(const StepView& view) {
  const Eigen::VectorXd& r = view.answer->r;
  return {r, view.standard->rate(r), view.standard->velocity(r),
          problems::evaluate_eta(*view.standard, r)};
}

}  // namespace

problems::Problem make_problem(const Scene& scene, std::int64_t step, Assembly& assembly) {
  problems::Metadata metadata;
  metadata.name = fmt::format("{}_{:06}", scene.name, step);
  metadata.engine = "dem";
  metadata.scene = scene.name;
  metadata.step = step;
  metadata.step_size_s = scene.step_s;
  return problems::Problem(std::move(assembly.data), std::move(assembly.cones),
                           std::move(metadata));
}

Exporter::Exporter(std::filesystem::path folder, engine::StepSelection selection)
    : folder_(std::move(folder)), selection_(selection) {
  engine::make_folder(folder_);
}

void Exporter::operator()(const StepView& view) {
  if (!selection_.contains(view.step)) return;
  if (!view.problem) {
    ++without_contacts_;
    return;
  }
  problems::Metadata metadata = view.problem->metadata();
  metadata.sampling_weight = static_cast<double>(selection_.stride);
  const auto path = folder_ / (metadata.name + ".h5");
  problems::write_problem_file(path, {view.problem->with_metadata(std::move(metadata)),
                                      geometry_of(view), *view.guess, solution_of(view)});
  ++written_;
}

}  // namespace conebench::dem
