#include "problems/engine/heap.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "problems/engine/svg.h"

namespace conebench::engine {
namespace {

constexpr double kFoot = 0.2, kSummit = 0.8;  // of the height: where a flank begins and ends
constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Column {
  Eigen::Vector2d place;  // of its middle [m]
  double top = 0.0;       // above the lowest grain [m]
};

std::vector<Column> columns_of(const Heap& heap, const Eigen::Matrix3d& axes) {
  std::map<std::pair<long, long>, double> tops;
  double base = kInfinity;
  for (const Grain& grain : heap.grains) {
    const Eigen::Vector3d x = axes * grain.position;
    base = std::min(base, x[1] - grain.radius);
    const std::pair at(std::lround(x[0] / heap.cell_m), std::lround(x[2] / heap.cell_m));
    const auto [place, added] = tops.try_emplace(at, -kInfinity);
    place->second = std::max(place->second, x[1] + grain.radius);
  }
  std::vector<Column> columns;
  for (const auto& [at, top] : tops) {
    columns.push_back({.place = heap.cell_m * Eigen::Vector2d(static_cast<double>(at.first),
                                                              static_cast<double>(at.second)),
                       .top = top - base});
  }
  return columns;
}

double distance_to_summit(const Column& column, const std::vector<Column>& columns,
                          double summit_m) {
  double nearest = kInfinity;
  for (const Column& other : columns) {
    if (other.top >= summit_m) nearest = std::min(nearest, (other.place - column.place).norm());
  }
  return nearest;
}

// Of the line through the points by least squares, or nothing where they lie above each other.
std::optional<double> slope(const std::vector<Eigen::Vector2d>& points, double resolution) {
  if (points.size() < 3) return std::nullopt;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& p : points) mean += p / static_cast<double>(points.size());
  double xx = 0.0, xy = 0.0;
  for (const Eigen::Vector2d& p : points) {
    xx += (p[0] - mean[0]) * (p[0] - mean[0]);
    xy += (p[0] - mean[0]) * (p[1] - mean[1]);
  }
  if (xx <= 1e-12 * resolution * resolution) return std::nullopt;
  return xy / xx;
}

}  // namespace

Eigen::Vector3d centre_of_mass(const Heap& heap) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double mass = 0.0;
  for (const Grain& grain : heap.grains) {
    sum += grain.mass * grain.position;
    mass += grain.mass;
  }
  return sum / mass;
}

double reach(const Heap& heap, const Eigen::Vector3d& up, const Eigen::Vector3d& from,
             double share) {
  std::vector<std::pair<double, double>> places;  // distance, mass
  double mass = 0.0;
  for (const Grain& grain : heap.grains) {
    const Eigen::Vector3d x = grain.position - from;
    places.emplace_back((x - up.dot(x) * up).norm(), grain.mass);
    mass += grain.mass;
  }
  std::sort(places.begin(), places.end());
  double within = 0.0;
  for (const auto& [distance, m] : places) {
    within += m;
    if (within >= share * mass) return distance;
  }
  return places.back().first;  // rounding of the sum
}

std::optional<double> flank_angle(const Heap& heap, const Eigen::Vector3d& up) {
  const std::vector<Column> columns = columns_of(heap, level_axes(-up));
  double height = 0.0;
  for (const Column& column : columns) height = std::max(height, column.top);
  std::vector<Eigen::Vector2d> flank;  // distance, height
  for (const Column& column : columns) {
    if (column.top < kFoot * height || column.top >= kSummit * height) continue;
    flank.emplace_back(distance_to_summit(column, columns, kSummit * height), column.top);
  }
  const std::optional<double> rise = slope(flank, heap.cell_m);
  if (!rise) return std::nullopt;
  return std::atan(-*rise);
}

}  // namespace conebench::engine
