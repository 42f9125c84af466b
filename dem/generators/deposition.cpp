#include "dem/generators/deposition.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "dem/generators/crowd.h"
#include "dem/generators/extent.h"
#include "problems/engine/scene_file.h"
#include "problems/error.h"

namespace conebench::dem {

using engine::Range;

namespace {

// Draws the bodies of a deposition, and knows the largest.
class Supply {
 public:
  Supply(const Deposition& deposition, Nursery& nursery)
      : deposition_(deposition), nursery_(nursery), largest_m_(deposition.largest_radius_m) {
    for (const std::string& name : deposition.shapes) {
      solids_.push_back(nursery.shape(name));
      extents_.push_back(extent_of(nursery.solid(solids_.back())));
      largest_m_ = std::max(largest_m_, extents_.back().radius_m);
    }
  }

  /// Radius of the ball about the largest body.
  double largest_m() const { return largest_m_; }

  /// A body about the origin of a cell with `half` its sides.
  Seedling next(const Eigen::Vector3d& half) {
    Seedling body;
    body.material = deposition_.material;
    body.velocity_m_s = deposition_.velocity_m_s;
    double radius = 0.0;
    if (solids_.empty()) {
      const double range = deposition_.largest_radius_m - deposition_.smallest_radius_m;
      radius = body.radius_m = deposition_.smallest_radius_m + range * nursery_.random();
    } else {
      const std::size_t which = choose();
      body.solid = solids_[which];
      body.pose.orientation = random_turn(nursery_);
      body.pose.position = -(body.pose.orientation * extents_[which].centre_m);
      radius = extents_[which].radius_m;
    }
    for (int k = 0; k < 3; ++k) {
      if (k == 1 && nursery_.dimension() == 2) continue;
      const double room = deposition_.jitter * std::max(0.0, half[k] - radius);
      body.pose.position[k] += room * (2.0 * nursery_.random() - 1.0);
    }
    return body;
  }

 private:
  std::size_t choose() {
    const std::size_t kinds = solids_.size();
    if (deposition_.in_turn) return made_++ % kinds;
    return static_cast<std::size_t>(static_cast<double>(kinds) * nursery_.random());
  }

  const Deposition& deposition_;
  Nursery& nursery_;
  double largest_m_;
  std::vector<int> solids_;
  std::vector<Extent> extents_;
  std::size_t made_ = 0;
};

}  // namespace

Deposition read_deposition(engine::TomlReader in) {
  static const std::string kOrders[] = {"in turn", "random"};
  Deposition deposition;
  deposition.low_m = in.vector("low_m");
  deposition.high_m = in.vector("high_m");
  if (!(deposition.low_m.array() < deposition.high_m.array()).all()) {
    in.fail("high_m", "expected above low_m in every direction");
  }
  if (in.has("count")) deposition.count = in.integer("count", 1);
  if (in.has("shapes")) {
    deposition.shapes = in.some_texts("shapes");
    deposition.in_turn = in.word("order", kOrders, "in turn") == 0;
  } else {
    const Eigen::Vector2d radii = in.interval("radius_range_m", Range::kPositive);
    deposition.smallest_radius_m = radii[0];
    deposition.largest_radius_m = radii[1];
  }
  deposition.jitter = in.number("jitter", Range::kUnitInterval, deposition.jitter);
  deposition.velocity_m_s = in.vector("velocity_m_s", deposition.velocity_m_s);
  deposition.material = in.text("material");
  in.finish();
  return deposition;
}

std::string show(const Deposition& deposition) {
  std::string out = fmt::format("\n[[depositions]]\nlow_m = {}\nhigh_m = {}\n",
                                engine::show(deposition.low_m), engine::show(deposition.high_m));
  if (deposition.count) out += fmt::format("count = {}\n", *deposition.count);
  if (deposition.shapes.empty()) {
    out += fmt::format("radius_range_m = [{}, {}]\n", deposition.smallest_radius_m,
                       deposition.largest_radius_m);
  } else {
    std::vector<std::string> names;
    for (const std::string& name : deposition.shapes) names.push_back(engine::quote(name));
    out += fmt::format("shapes = [{}]\norder = \"{}\"\n", fmt::join(names, ", "),
                       deposition.in_turn ? "in turn" : "random");
  }
  return out + fmt::format("jitter = {}\nvelocity_m_s = {}\nmaterial = {}\n", deposition.jitter,
                           engine::show(deposition.velocity_m_s),
                           engine::quote(deposition.material));
}

void place(const Deposition& deposition, Nursery& nursery) {
  Supply supply(deposition, nursery);
  const bool flat = nursery.dimension() == 2;
  const Eigen::Vector3d sides = deposition.high_m - deposition.low_m;
  std::int64_t cells[3];
  double room = 1.0;
  for (int k = 0; k < 3; ++k) {
    // Room for n cells is room for n, whatever the quotient rounds to. Of more than a million a
    // side only the first are used, so that their product is a number.
    const double fit = flat && k == 1 ? 1.0 : sides[k] / (2.0 * supply.largest_m()) + 1e-9;
    room *= fit;
    cells[k] = static_cast<std::int64_t>(std::min(fit, 1e6));
  }
  check_crowd(deposition.count ? static_cast<double>(*deposition.count) : room, "depositions",
              nursery);
  const std::int64_t capacity = cells[0] * cells[1] * cells[2];
  const std::int64_t count = deposition.count.value_or(std::max<std::int64_t>(1, capacity));
  problems::require(count <= capacity, nursery.subject(), "depositions: count: ", count,
                    " cells of side ", 2.0 * supply.largest_m(),
                    " m do not fit into low_m..high_m, there is room for ", capacity);
  const Eigen::Vector3d cell(sides.x() / static_cast<double>(cells[0]),
                             sides.y() / static_cast<double>(cells[1]),
                             sides.z() / static_cast<double>(cells[2]));
  for (std::int64_t n = 0; n < count; ++n) {
    const Eigen::Vector3d place(static_cast<double>(n % cells[0]),
                                static_cast<double>(n / cells[0] % cells[1]),
                                static_cast<double>(n / (cells[0] * cells[1])));
    const Eigen::Vector3d offset = (place.array() + 0.5).matrix().cwiseProduct(cell);
    Eigen::Vector3d middle = deposition.low_m + offset;
    if (flat) middle.y() = 0.0;
    Seedling body = supply.next(0.5 * cell);
    body.pose.position += middle;
    nursery.add(body);
  }
}

}  // namespace conebench::dem
