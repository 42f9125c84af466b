#include "dem/vtk_writer.h"

#include "problems/engine/text_file.h"

namespace conebench::dem {
namespace {

using Eigen::Vector3d;
using engine::PolyData;
using engine::vtk_file_name;

constexpr int kAround = 16;  // facets of round surfaces

std::size_t at(int i) { return static_cast<std::size_t>(i); }

// Of all parts, inner faces included.
Polyhedron surface_of(const Solid& solid) {
  Polyhedron out;
  for (const Part& part : solid.parts) {
    const int first = static_cast<int>(out.vertices.size());
    const Polyhedron piece = facets(part.piece, kAround);
    for (const Vector3d& x : piece.vertices) out.vertices.push_back(part.pose * x);
    for (std::vector<int> face : piece.faces) {
      for (int& corner : face) corner += first;
      out.faces.push_back(std::move(face));
    }
  }
  return out;
}

std::string spheres_file(const Bodies& bodies, const std::vector<int>& balls) {
  const auto of = [&](const auto& array) { return [&](int i) { return array[at(balls[at(i)])]; }; };
  PolyData out(static_cast<int>(balls.size()));
  out.points(of(bodies.position));
  out.scalars("radius_m", of(bodies.radius));
  out.vectors("velocity_m_s", of(bodies.velocity));
  out.vectors("angular_velocity_rad_s", of(bodies.angular_velocity));
  out.scalars("speed_m_s", [&](int i) { return bodies.velocity[at(balls[at(i)])].norm(); });
  return out.finish();
}

std::string contacts_file(const StepView& view, double step_s) {
  const auto contact = [&](int i) -> const Contact& {
    return view.contacts->contacts()[at(view.entered[at(i)])];
  };
  PolyData out(static_cast<int>(view.entered.size()));
  out.points([&](int i) { return contact(i).point; });
  out.vectors("force_N", [&](int i) { return Vector3d(contact(i).reaction / step_s); });
  out.vectors("normal", [&](int i) { return contact(i).normal; });
  out.scalars("gap_m", [&](int i) { return contact(i).gap; });
  out.integers("bonded", [&](int i) { return contact(i).bonded ? 1 : 0; });
  return out.finish();
}

// The faces of all bodies that are not balls, in the world.
struct Faces {
  std::vector<Vector3d> vertices;
  std::vector<std::vector<int>> corners;
  std::vector<int> body;
  std::vector<Vector3d> velocity;  // of the middle of the face

  void add(const Bodies& bodies, int i, const Polyhedron& polyhedron) {
    const int first = static_cast<int>(vertices.size());
    for (const Vector3d& x : polyhedron.vertices) vertices.push_back(bodies.pose(i) * x);
    for (std::vector<int> face : polyhedron.faces) {
      Vector3d arm = -bodies.position[at(i)];
      for (int& corner : face) {
        corner += first;
        arm += vertices[at(corner)] / static_cast<double>(face.size());
      }
      corners.push_back(std::move(face));
      body.push_back(i);
      velocity.push_back(bodies.velocity[at(i)] + bodies.angular_velocity[at(i)].cross(arm));
    }
  }
};

}  // namespace

VtkWriter::VtkWriter(std::filesystem::path folder, double step_s, const Placement& start,
                     std::int64_t stride)
    : folder_(std::move(folder)), step_s_(step_s), stride_(stride) {
  engine::make_folder(folder_);
  for (int i = 0; i < start.bodies.count(); ++i) {
    (start.bodies.is_ball(i) ? balls_ : others_).push_back(i);
  }
  for (const Solid& solid : start.solids) polyhedra_.push_back(surface_of(solid));
}

std::string VtkWriter::solids_file(const Bodies& bodies) const {
  Faces faces;
  for (const int i : others_) faces.add(bodies, i, polyhedra_[at(bodies.solid[at(i)])]);
  PolyData out(static_cast<int>(faces.vertices.size()), faces.corners);
  out.points([&](int i) { return faces.vertices[at(i)]; });
  out.vectors("velocity_m_s", [&](int i) { return faces.velocity[at(i)]; });
  out.scalars("speed_m_s", [&](int i) { return faces.velocity[at(i)].norm(); });
  out.integers("body", [&](int i) { return faces.body[at(i)]; });
  out.integers("free", [&](int i) { return bodies.is_free(faces.body[at(i)]) ? 1 : 0; });
  return out.finish();
}

void VtkWriter::operator()(const StepView& view) {
  if (view.step % stride_ != 0) return;
  const auto write = [&](std::string_view kind, const std::string& text) {
    engine::write_text_file(folder_ / vtk_file_name(kind, view.step), text);
  };
  if (!balls_.empty()) write("spheres", spheres_file(*view.bodies, balls_));
  if (!others_.empty()) write("solids", solids_file(*view.bodies));
  write("contacts", contacts_file(view, step_s_));
  steps_.push_back({view.time_s, view.step});
}

void VtkWriter::finish() const {
  if (!balls_.empty()) engine::write_vtk_series(folder_, "spheres", steps_);
  if (!others_.empty()) engine::write_vtk_series(folder_, "solids", steps_);
  engine::write_vtk_series(folder_, "contacts", steps_);
}

}  // namespace conebench::dem
