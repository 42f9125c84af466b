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

// Half of its thickness, at its thinnest.
double thinness_of(const Placement& placement, int body) {
  const Bodies& bodies = placement.bodies;
  if (bodies.is_plane(body) || bodies.is_ball(body)) return size_of(placement, body);
  return placement.solids[at(bodies.solid[at(body)])].thinness_m;
}

double smaller_size(const Placement& placement, int body, int other) {
  return std::min(size_of(placement, body), size_of(placement, other));
}

std::string name_of(const Bodies& bodies, int i) {
  if (bodies.is_plane(i)) return "plane " + std::to_string(i - bodies.count());
  return "body " + std::to_string(i);
}

// Finds what overlaps by more than a share of the smaller one's size.
class OverlapFinder {
 public:
  OverlapFinder(int dimension, const Placement& placement) : neighbours_(placement, dimension) {}

  const std::vector<Near>& find(const Placement& placement, double tolerance) {
    neighbours_.find(placement.bodies, 0.0, 0.0, found_);
    std::erase_if(found_, [&](const Near& near) {
      return -near.touch.gap <= tolerance * smaller_size(placement, near.body, near.other);
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
  problems::require(false, subject, name_of(placement.bodies, found.body), " and ",
                    name_of(placement.bodies, found.other), " overlap by ", -found.touch.gap,
                    " m, expected at most ", kOverlapTolerance,
                    " of the smaller one's size (or resolve = true)");
}

void refuse_sunk(const Scene& scene, std::int64_t step, std::span<const Contact> contacts,
                 const Placement& placement) {
  const Bodies& bodies = placement.bodies;
  for (const Contact& contact : contacts) {
    if (contact.gap >= 0.0) continue;
    const double thinner =
        std::min(thinness_of(placement, contact.body), thinness_of(placement, contact.other));
    if (-contact.gap <= thinner) continue;
    problems::require(false, scene.name, "step ", step, ": ", name_of(bodies, contact.body),
                      " and ", name_of(bodies, contact.other), " overlap by ", -contact.gap,
                      " m, expected at most ", thinner,
                      ", half of the thinner one. A smaller step_s (now ", scene.step_s,
                      "), a larger skin_m (now ", scene.skin_m,
                      ") or a smaller solver.tol may help; room that driven walls take away does "
                      "not come back");
  }
}

void refuse_long_step(const Scene& scene, std::string_view subject, const Placement& placement) {
  const Bodies& bodies = placement.bodies;
  const double h = scene.step_s;
  for (int i = 0; i < bodies.count(); ++i) {
    if (!bodies.is_free(i)) continue;
    const double way = h * (bodies.velocity[at(i)] + h * scene.gravity_m_s2).norm();
    const double thickness = 2.0 * thinness_of(placement, i);
    if (way <= thickness) continue;
    problems::require(false, subject, "step_s: found ", h, ", in which ", name_of(bodies, i),
                      " starts by moving ", way, " m, expected at most ", thickness,
                      " m, its thickness: it could pass others unseen");
  }
}

}  // namespace conebench::dem
