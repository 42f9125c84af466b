#include "dem/generators/lattice.h"

#include <fmt/format.h>

#include <cmath>

#include "dem/generators/crowd.h"
#include "dem/generators/extent.h"
#include "problems/engine/scene_file.h"
#include "problems/error.h"

namespace conebench::dem {

using engine::Range;

namespace {

// Half of the room that each body has along the axes when neighbours touch.
Eigen::Vector3d room_of(const Lattice& lattice, const Extent& extent) {
  if (!lattice.random_rotation) return extent.half_m;
  return Eigen::Vector3d::Constant(extent.radius_m);
}

Eigen::Vector3d touching(const Lattice& lattice, const Eigen::Vector3d& room, int dimension) {
  Eigen::Vector3d spacing = 2.0 * room;
  if (lattice.arrangement == Arrangement::kFcc)
    spacing.z() *= std::sqrt(dimension == 2 ? 0.75 : 0.5);
  return spacing;
}

}  // namespace

Lattice read_lattice(engine::TomlReader in) {
  static const std::string kArrangements[] = {"cubic", "fcc"};
  Lattice lattice;
  lattice.shape = in.text("shape", "");
  if (lattice.shape.empty()) {
    lattice.radius_m = in.number("radius_m", Range::kPositive);
  } else {
    lattice.random_rotation = in.boolean("random_rotation", false);
  }
  lattice.base_m = in.vector("base_m", lattice.base_m);
  const auto counts = in.integers("counts", 3, 3, 1);
  for (int k = 0; k < 3; ++k) {
    if (static_cast<double>(counts[static_cast<std::size_t>(k)]) > kLargestCrowd) {
      in.fail("counts", fmt::format("found {}, expected at most {:g}",
                                    counts[static_cast<std::size_t>(k)], kLargestCrowd));
    }
    lattice.counts[k] = static_cast<int>(counts[static_cast<std::size_t>(k)]);
  }
  if (in.has("spacing_m")) lattice.spacing_m = read_size(in, "spacing_m");
  lattice.arrangement =
      in.word("arrangement", kArrangements, "cubic") == 0 ? Arrangement::kCubic : Arrangement::kFcc;
  if (lattice.arrangement == Arrangement::kFcc && !lattice.shape.empty()) {
    in.fail("arrangement", "found fcc with a shape, expected cubic, or balls (radius_m)");
  }
  lattice.material = in.text("material");
  in.finish();
  return lattice;
}

std::string show(const Lattice& lattice) {
  std::string out = "\n[[lattices]]\n";
  if (lattice.shape.empty()) {
    out += fmt::format("radius_m = {}\n", lattice.radius_m);
  } else {
    out += fmt::format("shape = {}\nrandom_rotation = {}\n", engine::quote(lattice.shape),
                       lattice.random_rotation);
  }
  if (lattice.spacing_m) out += fmt::format("spacing_m = {}\n", engine::show(*lattice.spacing_m));
  return out + fmt::format(
                   "base_m = {}\ncounts = [{}, {}, {}]\narrangement = \"{}\"\nmaterial = {}\n",
                   engine::show(lattice.base_m), lattice.counts[0], lattice.counts[1],
                   lattice.counts[2], lattice.arrangement == Arrangement::kCubic ? "cubic" : "fcc",
                   engine::quote(lattice.material));
}

void place(const Lattice& lattice, Nursery& nursery) {
  problems::require(nursery.dimension() == 3 || lattice.counts.y() == 1, nursery.subject(),
                    "lattices: counts: found ", lattice.counts.y(),
                    " along y, expected 1 in a scene of dimension 2");
  check_crowd(lattice.counts.cast<double>().prod(), "lattices: counts", nursery);
  Seedling body;
  body.radius_m = lattice.radius_m;
  body.material = lattice.material;
  Extent extent;
  extent.half_m.setConstant(lattice.radius_m);
  if (!lattice.shape.empty()) {
    body.solid = nursery.shape(lattice.shape);
    extent = extent_of(nursery.solid(body.solid));
  }
  const Eigen::Vector3d room = room_of(lattice, extent);
  const Eigen::Vector3d spacing =
      lattice.spacing_m.value_or(touching(lattice, room, nursery.dimension()));
  const bool moved = lattice.arrangement == Arrangement::kFcc && lattice.counts.z() > 1;
  for (int k = 0; k < lattice.counts.z(); ++k) {
    const double shift = moved ? (k % 2 == 0 ? -0.25 : 0.25) : 0.0;
    for (int j = 0; j < lattice.counts.y(); ++j) {
      for (int i = 0; i < lattice.counts.x(); ++i) {
        const Eigen::Vector3d site(
            (i - 0.5 * (lattice.counts.x() - 1) + shift) * spacing.x(),
            (j - 0.5 * (lattice.counts.y() - 1) + (nursery.dimension() == 2 ? 0.0 : shift)) *
                spacing.y(),
            room.z() + k * spacing.z());
        if (lattice.random_rotation) body.pose.orientation = random_turn(nursery);
        body.pose.position = lattice.base_m + site - body.pose.orientation * extent.centre_m;
        nursery.add(body);
      }
    }
  }
}

}  // namespace conebench::dem
