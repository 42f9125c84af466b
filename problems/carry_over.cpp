#include "problems/carry_over.h"

#include <array>
#include <limits>
#include <map>
#include <vector>

#include "problems/error.h"

namespace conebench::problems {
namespace {

using Matrix3 = Eigen::Matrix3d;

bool is_node(const Geometry& geometry, int cone) {
  return !geometry.state.empty() && geometry.state[static_cast<std::size_t>(cone)] >= 0;
}

// What cones must share to be matched; a node's is its position.
using Key = std::array<double, 4>;

Key key_of(const Geometry& geometry, int cone) {
  if (is_node(geometry, cone)) {
    const auto x = geometry.points.row(cone);
    return {1.0, x(0), x(1), x(2)};
  }
  if (geometry.bodies_of_cone.size() == 0) return {0.0, -1.0, -1.0, 0.0};
  return {0.0, static_cast<double>(geometry.bodies_of_cone(cone, 0)),
          static_cast<double>(geometry.bodies_of_cone(cone, 1)), 0.0};
}

std::map<Key, std::vector<int>> cones_by_key(const ProblemFile& file) {
  std::map<Key, std::vector<int>> cones;
  for (int i = 0; i < file.problem.cone_count(); ++i) {
    cones[key_of(*file.geometry, i)].push_back(i);
  }
  return cones;
}

// Takes the nearest cone of the same dimension out of `candidates`; -1: there is none.
int take_nearest(const ProblemFile& from, const ProblemFile& to, int cone,
                 std::vector<int>& candidates) {
  const auto k = static_cast<std::size_t>(cone);
  std::size_t nearest = candidates.size();
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    const int other = candidates[c];
    if (from.problem.cones()[static_cast<std::size_t>(other)].dim != to.problem.cones()[k].dim) {
      continue;
    }
    const double distance =
        (from.geometry->points.row(other) - to.geometry->points.row(cone)).squaredNorm();
    if (!(distance < least)) continue;
    least = distance;
    nearest = c;
  }
  if (nearest == candidates.size()) return -1;
  const int found = candidates[nearest];
  candidates.erase(candidates.begin() + static_cast<std::ptrdiff_t>(nearest));
  return found;
}

// For each cone of `to` one of `from`, or -1.
std::vector<int> match(const ProblemFile& from, const ProblemFile& to) {
  std::vector<int> matched(static_cast<std::size_t>(to.problem.cone_count()), -1);
  auto candidates = cones_by_key(from);
  for (int i = 0; i < to.problem.cone_count(); ++i) {
    const auto found = candidates.find(key_of(*to.geometry, i));
    if (found == candidates.end()) continue;
    matched[static_cast<std::size_t>(i)] = take_nearest(from, to, i, found->second);
  }
  return matched;
}

std::vector<int> match_by_order(const Problem& from, const Problem& to) {
  std::vector<int> matched(static_cast<std::size_t>(to.cone_count()), -1);
  bool same = from.cone_count() == to.cone_count();
  for (std::size_t i = 0; same && i < matched.size(); ++i) {
    same = from.cones()[i].dim == to.cones()[i].dim;
  }
  for (std::size_t i = 0; same && i < matched.size(); ++i) matched[i] = static_cast<int>(i);
  return matched;
}

// Columns: normal and tangents.
Matrix3 frame(const Geometry& geometry, int cone) {
  return Eigen::Map<const Matrix3>(geometry.frames.row(cone).data());
}

Eigen::VectorXd turned(const Geometry& from, int before, const Geometry& to, int now,
                       const Eigen::VectorXd& r) {
  const Eigen::Index dim = r.size();
  const bool vectors = dim <= 3 && !is_node(to, now) && !is_node(from, before);
  if (!vectors || from.frames.size() == 0 || to.frames.size() == 0) return r;
  const Eigen::Vector3d world = frame(from, before).leftCols(dim) * r;
  return frame(to, now).leftCols(dim).transpose() * world;
}

}  // namespace

Eigen::VectorXd carry_over(const ProblemFile& from, const Eigen::VectorXd& r,
                           const ProblemFile& to) {
  const Problem &before = from.problem, &now = to.problem;
  require(r.size() == before.rows(), before.name(), "r has ", r.size(), " entries, expected ",
          before.rows());
  const bool by_place = from.geometry && to.geometry;
  const std::vector<int> matched = by_place ? match(from, to) : match_by_order(before, now);
  const double h = before.metadata().step_size_s, h_now = now.metadata().step_size_s;
  const double scale = h > 0.0 && h_now > 0.0 ? h_now / h : 1.0;

  Eigen::VectorXd guess = Eigen::VectorXd::Zero(now.rows());
  for (int i = 0; i < now.cone_count(); ++i) {
    const int old = matched[static_cast<std::size_t>(i)];
    if (old < 0) continue;
    const Cone& cone = now.cones()[static_cast<std::size_t>(i)];
    const Eigen::VectorXd part = scale * r.segment(before.start(old), cone.dim);
    auto target = guess.segment(now.start(i), cone.dim);
    target = by_place ? turned(*from.geometry, old, *to.geometry, i, part) : part;
    project(cone.mu, target);
  }
  return guess;
}

}  // namespace conebench::problems
