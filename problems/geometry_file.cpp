#include "problems/geometry_file.h"

#include "problems/error.h"

namespace conebench::problems {
namespace {

void write_table(hdf5::Writer& writer, const std::string& name, const Geometry::Table& table,
                 Eigen::Index rows, Eigen::Index cols, const std::string& subject) {
  if (table.size() == 0) return;
  require(table.rows() == rows && table.cols() == cols, subject, name, " is ", table.rows(), " x ",
          table.cols(), ", expected ", rows, " x ", cols);
  writer.table(name, table);
}

// The number of bodies that the file speaks of: the length of either table of bodies.
Eigen::Index body_count(const hdf5::Reader& reader) {
  if (reader.has("/geometry/body_radii")) return reader.vector("/geometry/body_radii").size();
  return reader.vector("/geometry/body_positions").size() / 3;
}

void read_bodies(const hdf5::Reader& reader, Geometry& geometry) {
  if (!reader.has("/geometry/body_radii") && !reader.has("/geometry/body_positions")) return;
  const Eigen::Index bodies = body_count(reader);
  if (reader.has("/geometry/body_radii")) {
    geometry.body_radii = reader.vector("/geometry/body_radii", bodies);
  }
  if (reader.has("/geometry/body_positions")) {
    geometry.body_positions = reader.table("/geometry/body_positions", bodies, 3);
  }
  for (const int body : geometry.bodies_of_cone.reshaped()) {
    if (body < -1 || body >= bodies) {
      reader.fail("/geometry/bodies_of_cone", "names body " + std::to_string(body) +
                                                  ", expected -1 to " + std::to_string(bodies - 1));
    }
  }
}

}  // namespace

void write_geometry(hdf5::Writer& writer, const Geometry& geometry, const Problem& problem) {
  const Eigen::Index cones = problem.cone_count();
  const std::string& subject = problem.name();
  writer.group("/geometry");
  write_table(writer, "/geometry/points", geometry.points, cones, 3, subject);
  write_table(writer, "/geometry/frames", geometry.frames, cones, 9, subject);
  if (geometry.bodies_of_cone.size() > 0) {
    require(geometry.bodies_of_cone.rows() == cones, subject, "bodies_of_cone has ",
            geometry.bodies_of_cone.rows(), " rows, expected ", cones);
    writer.table("/geometry/bodies_of_cone", geometry.bodies_of_cone);
  }
  const Eigen::Index bodies = std::max(geometry.body_positions.rows(), geometry.body_radii.size());
  write_table(writer, "/geometry/body_positions", geometry.body_positions, bodies, 3, subject);
  if (geometry.body_radii.size() > 0) {
    require(geometry.body_radii.size() == bodies, subject, "body_radii has ",
            geometry.body_radii.size(), " entries, expected ", bodies);
    writer.array("/geometry/body_radii", geometry.body_radii);
  }
  if (geometry.volume_fraction.size() > 0) {
    require(geometry.volume_fraction.size() == cones, subject, "volume_fraction has ",
            geometry.volume_fraction.size(), " entries, expected ", cones);
    writer.array("/geometry/volume_fraction", geometry.volume_fraction);
  }
  if (!geometry.state.empty()) {
    require(std::ssize(geometry.state) == cones, subject, "state has ", geometry.state.size(),
            " entries, expected ", cones);
    writer.array("/geometry/state", geometry.state);
  }
}

std::optional<Geometry> read_geometry(const hdf5::Reader& reader, int cones) {
  if (!reader.has("/geometry")) return {};
  Geometry geometry;
  if (reader.has("/geometry/points")) geometry.points = reader.table("/geometry/points", cones, 3);
  if (reader.has("/geometry/frames")) geometry.frames = reader.table("/geometry/frames", cones, 9);
  if (reader.has("/geometry/bodies_of_cone")) {
    const std::vector<int> pairs = reader.integers("/geometry/bodies_of_cone", cones, 2);
    geometry.bodies_of_cone = Eigen::Map<const Geometry::Pairs>(pairs.data(), cones, 2);
  }
  read_bodies(reader, geometry);
  if (reader.has("/geometry/volume_fraction")) {
    geometry.volume_fraction = reader.vector("/geometry/volume_fraction", cones);
  }
  if (reader.has("/geometry/state")) {
    geometry.state = reader.integers("/geometry/state");
    if (std::ssize(geometry.state) != cones) {
      reader.fail("/geometry/state", "has " + std::to_string(geometry.state.size()) +
                                         " entries, expected " + std::to_string(cones));
    }
  }
  return geometry;
}

}  // namespace conebench::problems
