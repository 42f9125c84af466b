#include "dem/export.h"

#include <fmt/format.h>

#include <charconv>
#include <optional>
#include <system_error>

#include "dem/text_file.h"
#include "problems/error.h"
#include "problems/problem_file.h"
#include "problems/residual.h"

namespace conebench::dem {
namespace {

using problems::Geometry;

// A whole number that fills the text, or nothing.
std::optional<std::int64_t> to_integer(std::string_view text) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

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

StepSelection parse_selection(std::string_view text) {
  StepSelection selection;
  if (text == "all") return selection;
  if (text.starts_with("every:")) {
    const auto stride = to_integer(text.substr(6));
    if (stride && *stride >= 1) return {0, selection.last, *stride};
  }
  if (const auto dots = text.find(".."); dots != std::string_view::npos) {
    const auto first = to_integer(text.substr(0, dots));
    const auto last = to_integer(text.substr(dots + 2));
    if (first && last && *first >= 0 && *first <= *last) return {*first, *last, 1};
  }
  throw problems::InputError("policy", fmt::format("found \"{}\", expected all, every:N (N >= 1) "
                                                   "or N..M (0 <= N <= M)",
                                                   text));
}

Exporter::Exporter(std::filesystem::path folder, StepSelection selection)
    : folder_(std::move(folder)), selection_(selection) {
  make_folder(folder_);
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
