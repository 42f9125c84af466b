#include "dem/overlaps.h"

#include <algorithm>
#include <limits>
#include <string>

#include "dem/neighbours.h"
#include "problems/error.h"

namespace conebench::dem {
namespace {

constexpr int kLargestSweepCount = 10'000;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

double size_of(const Placement& placement, int body) {
  const Bodies& bodies = placement.bodies;
  if (bodies.is_plane(body)) return std::numeric_limits<double>::infinity();
  if (bodies.is_ball(body)) return bodies.radius[at(body)];
  return placement.solids[at(bodies.solid[at(body)])].size_m;
}

// Finds what overlaps by more than a share of the smaller one's size.
class OverlapFinder {
 public:
  OverlapFinder(int dimension, const Placement& placement) : neighbours_(placement, dimension) {}

  const std::vector<Near>& find(const Placement& placement, double tolerance) {
    neighbours_.find(placement.bodies, 0.0, 0.0, found_);
    std::erase_if(found_, [&](const Near& near) {
      const double size = std::min(size_of(placement, near.body), size_of(placement, near.other));
      return -near.touch.gap <= tolerance * size;
    });
    return found_;
  }

 private:
  Neighbours neighbours_;
  std::vector<Near> found_;
};

void part(const Near& near, Bodies& bodies) {
  const bool both = bodies.is_free(near.body) && bodies.is_free(near.other);
  const Eigen::Vector3d move = -(both ? 0.5 : 1.0) * near.touch.gap * near.touch.normal;
  if (bodies.is_free(near.body)) bodies.position[at(near.body)] += move;
  if (bodies.is_free(near.other)) bodies.position[at(near.other)] -= move;
}

}  // namespace

void resolve_overlaps(int dimension, std::string_view subject, Placement& placement) {
  OverlapFinder finder(dimension, placement);
  for (int sweep = 0; sweep < kLargestSweepCount; ++sweep) {
    const auto& overlaps = finder.find(placement, 0.5 * kOverlapTolerance);
    if (overlaps.empty()) return;
    for (const Near& near : overlaps) part(near, placement.bodies);
  }
  throw problems::InputError(subject, "resolve: the bodies do not fit, " +
                                          std::to_string(kLargestSweepCount) +
                                          " sweeps did not part them");
}

void refuse_overlaps(int dimension, std::string_view subject, const Placement& placement) {
  OverlapFinder finder(dimension, placement);
  const auto& overlaps = finder.find(placement, kOverlapTolerance);
  if (overlaps.empty()) return;
  const Near& found = overlaps.front();
  const bool with_plane = placement.bodies.is_plane(found.other);
  problems::require(false, subject, "body ", found.body, " and ", with_plane ? "plane " : "body ",
                    with_plane ? found.other - placement.bodies.count() : found.other,
                    " overlap by ", -found.touch.gap, " m, expected at most ", kOverlapTolerance,
                    " of the smaller one's size (or resolve = true)");
}

}  // namespace conebench::dem
