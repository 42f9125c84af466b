#include "dem/vtk_writer.h"

#include "problems/engine/text_file.h"

namespace conebench::dem {
namespace {

using engine::PolyData;
using engine::vtk_file_name;

std::string spheres_file(const Spheres& spheres) {
  const auto at = [](const auto& array) {
    return [&array](int i) { return array[static_cast<std::size_t>(i)]; };
  };
  PolyData out(spheres.count());
  out.points(at(spheres.position));
  out.scalars("radius_m", at(spheres.radius));
  out.vectors("velocity_m_s", at(spheres.velocity));
  out.vectors("angular_velocity_rad_s", at(spheres.angular_velocity));
  out.scalars("speed_m_s",
              [&](int i) { return spheres.velocity[static_cast<std::size_t>(i)].norm(); });
  return out.finish();
}

std::string contacts_file(const StepView& view, double step_s) {
  const auto contact = [&](int i) -> const Contact& {
    const int index = view.entered[static_cast<std::size_t>(i)];
    return view.contacts->contacts()[static_cast<std::size_t>(index)];
  };
  PolyData out(static_cast<int>(view.entered.size()));
  out.points([&](int i) { return contact(i).point; });
  out.vectors("force_N", [&](int i) { return Eigen::Vector3d(contact(i).reaction / step_s); });
  out.vectors("normal", [&](int i) { return Eigen::Vector3d(contact(i).normal()); });
  out.scalars("gap_m", [&](int i) { return contact(i).gap; });
  out.integers("bonded", [&](int i) { return contact(i).bonded ? 1 : 0; });
  return out.finish();
}

}  // namespace

VtkWriter::VtkWriter(std::filesystem::path folder, double step_s, std::int64_t stride)
    : folder_(std::move(folder)), step_s_(step_s), stride_(stride) {
  engine::make_folder(folder_);
}

void VtkWriter::operator()(const StepView& view) {
  if (view.step % stride_ != 0) return;
  engine::write_text_file(folder_ / vtk_file_name("spheres", view.step),
                          spheres_file(*view.spheres));
  engine::write_text_file(folder_ / vtk_file_name("contacts", view.step),
                          contacts_file(view, step_s_));
  steps_.push_back({view.time_s, view.step});
}

void VtkWriter::finish() const {
  engine::write_vtk_series(folder_, "spheres", steps_);
  engine::write_vtk_series(folder_, "contacts", steps_);
}

}  // namespace conebench::dem
