#include "dem/placement.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "dem/broad_phase.h"
#include "problems/error.h"

namespace conebench::dem {
namespace {

constexpr int kLargestSweepCount = 10'000;

// Numbers in [0, 1), the same on every machine (std::uniform_real_distribution promises less).
class Random {
 public:
  explicit Random(std::int64_t seed) : engine_(static_cast<std::uint64_t>(seed)) {}
  double operator()() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }

 private:
  std::mt19937_64 engine_;
};

void add_sphere(const Scene& scene, const Body& body, Spheres& spheres) {
  const double volume = 4.0 / 3.0 * std::numbers::pi * std::pow(body.radius_m, 3);
  const int material = material_index(scene, body.material);
  const double mass = volume * scene.materials[static_cast<std::size_t>(material)].density_kg_m3;
  spheres.position.push_back(body.position_m);
  spheres.velocity.push_back(body.velocity_m_s);
  spheres.angular_velocity.push_back(body.angular_velocity_rad_s);
  spheres.orientation.push_back(Eigen::Quaterniond::Identity());
  spheres.radius.push_back(body.radius_m);
  spheres.mass.push_back(mass);
  spheres.inertia.push_back(0.4 * mass * body.radius_m * body.radius_m);
  spheres.material.push_back(material);
  spheres.first_dof.push_back(body.fixed ? -1 : spheres.dofs);
  if (!body.fixed) spheres.dofs += 6;
}

void add_column(const Scene& scene, const Column& column, Random& random, Spheres& spheres) {
  const double largest = column.largest_radius_m;
  const double cell = 2.0 * largest;
  // Room for n cells is room for n, whatever the quotient rounds to.
  const auto cells_in = [&](double length) { return static_cast<int>(length / cell + 1e-9); };
  const int side = cells_in(column.width_m);
  const int layers = cells_in(column.height_m);
  const double reach = 0.5 * column.width_m - largest + 1e-9 * largest;
  for (int layer = 0; layer < layers; ++layer) {
    for (int row = 0; row < side; ++row) {
      for (int place = 0; place < side; ++place) {
        const Eigen::Vector3d centre((place - 0.5 * (side - 1)) * cell,
                                     (row - 0.5 * (side - 1)) * cell, (layer + 0.5) * cell);
        if (column.section == Section::kCylinder && centre.head<2>().norm() > reach) continue;
        Body body;
        body.radius_m = column.smallest_radius_m + (largest - column.smallest_radius_m) * random();
        const double room = column.jitter * (largest - body.radius_m);
        for (int k = 0; k < 3; ++k) {
          body.position_m[k] = column.base_m[k] + centre[k] + room * (2.0 * random() - 1.0);
        }
        body.material = column.material;
        add_sphere(scene, body, spheres);
      }
    }
  }
}

void add_stack(const Scene& scene, const Stack& stack, Spheres& spheres) {
  for (std::int64_t i = 0; i < stack.count; ++i) {
    Body body;
    body.radius_m = stack.radius_m;
    body.position_m = stack.base_m;
    body.position_m.z() += static_cast<double>(2 * i + 1) * stack.radius_m;
    body.material = stack.material;
    add_sphere(scene, body, spheres);
  }
}

void add_bed(const Scene& scene, const Bed& bed, Spheres& spheres) {
  const double cell = 2.0 * bed.radius_m;
  const int side = std::max(1, static_cast<int>(std::ceil(bed.width_m / cell - 1e-9)));
  for (int k = 0; k < side * side; ++k) {
    Body body;
    body.radius_m = bed.radius_m;
    body.position_m = bed.centre_m;
    body.position_m.x() += (k % side - 0.5 * (side - 1)) * cell;
    body.position_m.y() += (k / side - 0.5 * (side - 1)) * cell;
    body.material = bed.material;
    body.fixed = true;
    add_sphere(scene, body, spheres);
  }
}

// A pair deeper than the tolerance allows; plane >= 0 stands for the second sphere.
struct Overlap {
  int first = 0, second = 0;
  int plane = -1;
  double depth = 0.0;
  Eigen::Vector3d normal;  // towards `first`
};

void find_sphere_overlaps(const Spheres& spheres, double tolerance, CellList& cells,
                          std::vector<Overlap>& overlaps) {
  std::vector<BodyPair> pairs;
  cells.find_pairs(spheres.position, spheres.radius, 0.0, pairs);
  for (const auto& [first, second] : pairs) {
    const auto a = static_cast<std::size_t>(first);
    const auto b = static_cast<std::size_t>(second);
    const Eigen::Vector3d offset = spheres.position[a] - spheres.position[b];
    const double distance = offset.norm();
    const double depth = spheres.radius[a] + spheres.radius[b] - distance;
    if (depth <= tolerance * std::min(spheres.radius[a], spheres.radius[b])) continue;
    const Eigen::Vector3d normal =
        distance > 0.0 ? Eigen::Vector3d(offset / distance) : Eigen::Vector3d::UnitZ();
    overlaps.push_back({first, second, -1, depth, normal});
  }
}

void find_plane_overlaps(const Scene& scene, const Spheres& spheres, double tolerance,
                         std::vector<Overlap>& overlaps) {
  for (int i = 0; i < spheres.count(); ++i) {
    const auto a = static_cast<std::size_t>(i);
    if (spheres.first_dof[a] < 0) continue;  // a fixed sphere may be set into a wall
    for (std::size_t p = 0; p < scene.planes.size(); ++p) {
      const Plane& plane = scene.planes[p];
      const double depth =
          spheres.radius[a] - plane.normal.dot(spheres.position[a] - plane.point_m);
      if (depth <= tolerance * spheres.radius[a]) continue;
      overlaps.push_back({i, i, static_cast<int>(p), depth, plane.normal});
    }
  }
}

std::vector<Overlap> find_overlaps(const Scene& scene, const Spheres& spheres, double tolerance,
                                   CellList& cells) {
  std::vector<Overlap> overlaps;
  find_sphere_overlaps(spheres, tolerance, cells, overlaps);
  find_plane_overlaps(scene, spheres, tolerance, overlaps);
  std::erase_if(overlaps, [&](const Overlap& overlap) {
    return spheres.first_dof[static_cast<std::size_t>(overlap.first)] < 0 &&
           spheres.first_dof[static_cast<std::size_t>(overlap.second)] < 0;
  });
  return overlaps;
}

void part(const Overlap& overlap, Spheres& spheres) {
  const auto a = static_cast<std::size_t>(overlap.first);
  const auto b = static_cast<std::size_t>(overlap.second);
  const bool a_moves = spheres.first_dof[a] >= 0;
  const bool b_moves = overlap.plane < 0 && spheres.first_dof[b] >= 0;
  const double share = a_moves && b_moves ? 0.5 : 1.0;
  if (a_moves) spheres.position[a] += share * overlap.depth * overlap.normal;
  if (b_moves) spheres.position[b] -= share * overlap.depth * overlap.normal;
}

void resolve_overlaps(const Scene& scene, std::string_view subject, CellList& cells,
                      Spheres& spheres) {
  for (int sweep = 0; sweep < kLargestSweepCount; ++sweep) {
    const auto overlaps = find_overlaps(scene, spheres, 0.5 * kOverlapTolerance, cells);
    if (overlaps.empty()) return;
    for (const Overlap& overlap : overlaps) part(overlap, spheres);
  }
  throw problems::InputError(subject, "resolve: the spheres do not fit, " +
                                          std::to_string(kLargestSweepCount) +
                                          " sweeps did not part them");
}

void refuse_overlaps(const Scene& scene, std::string_view subject, CellList& cells,
                     const Spheres& spheres) {
  const auto overlaps = find_overlaps(scene, spheres, kOverlapTolerance, cells);
  if (overlaps.empty()) return;
  const Overlap& found = overlaps.front();
  const bool with_plane = found.plane >= 0;
  problems::require(false, subject, "body ", found.first, " and ", with_plane ? "plane " : "body ",
                    with_plane ? found.plane : found.second, " overlap by ", found.depth,
                    " m, expected at most ", kOverlapTolerance,
                    " of the radius (or resolve = true)");
}

}  // namespace

Spheres place_spheres(const Scene& scene, std::string_view subject) {
  Spheres spheres;
  Random random(scene.seed);
  for (const Body& body : scene.bodies) add_sphere(scene, body, spheres);
  for (const Column& column : scene.columns) add_column(scene, column, random, spheres);
  for (const Stack& stack : scene.stacks) add_stack(scene, stack, spheres);
  for (const Bed& bed : scene.beds) add_bed(scene, bed, spheres);
  problems::require(spheres.dofs > 0, subject, "no body can move, expected at least one");
  CellList cells;
  if (scene.resolve) resolve_overlaps(scene, subject, cells, spheres);
  refuse_overlaps(scene, subject, cells, spheres);
  return spheres;
}

}  // namespace conebench::dem
