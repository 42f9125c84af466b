#include "dem/scene_shapes.h"

#include <fmt/format.h>

#include "dem/mesh_file.h"

namespace conebench::dem {
namespace {

using engine::quote;
using engine::Range;
using engine::show;
using engine::TomlReader;

const std::string kKinds[] = {"ball", "box", "capsule", "cylinder", "hull", "mesh"};

Mesh read_surface(TomlReader& in, std::string_view subject, ScenePart& part) {
  if (in.has("file")) {
    part.file = std::filesystem::path(subject).parent_path() / in.text("file");
    return read_mesh(part.file);
  }
  return {in.some_vectors("vertices_m"), in.some_triples("triangles", 0)};
}

// A file with the hull's faces must be closed and the right way out.
Piece read_hull(TomlReader& in, std::string_view subject, ScenePart& part) {
  if (!in.has("file")) return Hull{in.some_vectors("points_m")};
  const Mesh mesh = read_surface(in, subject, part);
  check_piece(mesh, part.file.string(), true);
  return Hull{mesh.vertices_m};
}

Box read_box(TomlReader& in) {
  const Eigen::Vector3d size = in.vector("size_m");
  if (!(size.array() > 0.0).all()) {
    in.fail("size_m", fmt::format("found {}, expected numbers > 0", show(size)));
  }
  return {0.5 * size};
}

Piece read_piece(TomlReader& in, std::string_view subject, ScenePart& part) {
  switch (in.word("kind", kKinds)) {
    case 0:
      return Ball{in.number("radius_m", Range::kPositive)};
    case 1:
      return read_box(in);
    case 2:
      return Capsule{in.number("radius_m", Range::kPositive),
                     0.5 * in.number("length_m", Range::kPositive)};
    case 3:
      return Cylinder{in.number("radius_m", Range::kPositive),
                      0.5 * in.number("length_m", Range::kPositive)};
    case 4:
      return read_hull(in, subject, part);
    default:
      return read_surface(in, subject, part);
  }
}

ScenePart read_part(TomlReader& in, std::string_view subject, const std::string& name) {
  ScenePart part;
  part.piece = read_piece(in, subject, part);
  part.position_m = in.vector("position_m", part.position_m);
  part.rotation_rad = in.vector("rotation_rad", part.rotation_rad);
  check_piece(part.piece, fmt::format("{}: shape \"{}\"", subject, name));
  return part;
}

template <class Triples>
std::string show_triples(const Triples& triples) {
  std::string out;
  for (const auto& x : triples) {
    out += fmt::format("{}[{}, {}, {}]", out.empty() ? "[" : ", ", x[0], x[1], x[2]);
  }
  return out + "]";
}

struct ShowPiece {
  const ScenePart& part;

  std::string operator()(const Ball& b) const {
    return fmt::format("kind = \"ball\"\nradius_m = {}\n", b.radius_m);
  }
  std::string operator()(const Box& b) const {
    return fmt::format("kind = \"box\"\nsize_m = {}\n", show(Eigen::Vector3d(2.0 * b.half_m)));
  }
  std::string operator()(const Capsule& c) const {
    return fmt::format("kind = \"capsule\"\nradius_m = {}\nlength_m = {}\n", c.radius_m,
                       2.0 * c.half_length_m);
  }
  std::string operator()(const Cylinder& c) const {
    return fmt::format("kind = \"cylinder\"\nradius_m = {}\nlength_m = {}\n", c.radius_m,
                       2.0 * c.half_length_m);
  }
  std::string operator()(const Hull& h) const {
    return "kind = \"hull\"\n" +
           (part.file.empty() ? "points_m = " + show_triples(h.points_m) + "\n" : file());
  }
  std::string operator()(const Mesh& m) const {
    if (!part.file.empty()) return "kind = \"mesh\"\n" + file();
    return fmt::format("kind = \"mesh\"\nvertices_m = {}\ntriangles = {}\n",
                       show_triples(m.vertices_m), show_triples(m.triangles));
  }

 private:
  std::string file() const {
    return fmt::format("file = {}\n", quote(std::filesystem::absolute(part.file).string()));
  }
};

}  // namespace

Pose pose_of(const Eigen::Vector3d& position_m, const Eigen::Vector3d& rotation_rad) {
  const double angle = rotation_rad.norm();
  if (angle == 0.0) return {position_m, Eigen::Quaterniond::Identity()};
  return {position_m, Eigen::Quaterniond(Eigen::AngleAxisd(angle, rotation_rad / angle))};
}

Shape SceneShape::shape() const {
  Shape out{name, {}};
  for (const ScenePart& part : parts) {
    out.parts.push_back({part.piece, pose_of(part.position_m, part.rotation_rad)});
  }
  return out;
}

SceneShape read_shape(TomlReader in, std::string_view subject) {
  SceneShape shape{in.text("name"), {}};
  if (in.has("kind")) {
    shape.parts.push_back(read_part(in, subject, shape.name));
  } else {
    for (TomlReader& part : in.tables("parts")) {
      shape.parts.push_back(read_part(part, subject, shape.name));
      part.finish();
    }
    if (shape.parts.empty()) in.fail("kind", "missing, expected a kind, or [[shapes.parts]]");
  }
  in.finish();
  return shape;
}

std::string show(const SceneShape& shape) {
  std::string out = fmt::format("\n[[shapes]]\nname = {}\n", quote(shape.name));
  for (const ScenePart& part : shape.parts) {
    out += fmt::format("[[shapes.parts]]\n{}position_m = {}\nrotation_rad = {}\n",
                       std::visit(ShowPiece{part}, part.piece), show(part.position_m),
                       show(part.rotation_rad));
  }
  return out;
}

}  // namespace conebench::dem
