#include "dem/hierarchical_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "problems/error.h"

namespace conebench::dem {
namespace {

using Eigen::Vector3d;

constexpr double kNoBall = 0.0;      // a size; all others are positive
constexpr double kFarthest = 1e100;  // [m], so that squares and sums stay finite

bool in_reach(const Vector3d& place) { return (place.array().abs() < kFarthest).all(); }

// How far two boxes are apart along the axis where they are farthest; < 0: they overlap.
double separation(const Bounds& a, const Bounds& b) {
  return (a.low - b.high).cwiseMax(b.low - a.high).maxCoeff();
}

std::int64_t cell(double place, double width) {
  return static_cast<std::int64_t>(std::floor(place / width));
}

// Whether a cell reaches into low to high.
bool overlap(std::int64_t cell, double width, double low, double high) {
  return static_cast<double>(cell) * width <= high && static_cast<double>(cell + 1) * width >= low;
}

Vector3d centre_of(const Bounds& box) { return 0.5 * box.low + 0.5 * box.high; }

}  // namespace

// A thing's size: how near to it another one of its size can be found, along each axis, and more
// than the rounding of its place, of its row and of the window in which it is looked for.
double HierarchicalGrid::size_of(double extent, const Vector3d& centre) const {
  constexpr double kRounding = 16.0 * std::numeric_limits<double>::epsilon();
  return (1.0 + kRounding) * (extent + margin_) + kRounding * centre.cwiseAbs().maxCoeff() +
         std::numeric_limits<double>::min();
}

void HierarchicalGrid::measure() {
  problems::require(margin_ >= 0.0 && margin_ < kFarthest, "broad phase", "margin ", margin_,
                    ", expected >= 0 and below 1e100 m");
  sizes_.clear();
  sizes_.reserve(radii_.size() + boxes_.size());
  for (std::size_t i = 0; i < radii_.size(); ++i) {
    if (radii_[i] < 0.0) {
      sizes_.push_back(kNoBall);
      continue;
    }
    problems::require(in_reach(centres_[i]) && radii_[i] < kFarthest, "broad phase", "ball ", i,
                      " has its centre at (", centres_[i].transpose(), ") and radius ", radii_[i],
                      ", expected numbers below 1e100 m");
    sizes_.push_back(size_of(2.0 * radii_[i], centres_[i]));
  }
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    const auto& [low, high] = boxes_[i];
    problems::require(in_reach(low) && in_reach(high) && (low.array() <= high.array()).all(),
                      "broad phase", "box ", i, " reaches from (", low.transpose(), ") to (",
                      high.transpose(), "), expected increasing numbers, below 1e100 m");
    sizes_.push_back(size_of((high - low).maxCoeff(), centre_of(boxes_[i])));
  }
}

// The largest size is a level's width, and all that is larger than half of it is on that level;
// the largest of the rest is the next width.
void HierarchicalGrid::choose_levels() {
  width_.clear();
  double below = std::numeric_limits<double>::infinity();
  while (true) {
    double largest = kNoBall;
    for (const double size : sizes_) {
      if (size <= below) largest = std::max(largest, size);
    }
    if (largest == kNoBall) return;
    width_.push_back(largest);
    below = 0.5 * largest;
  }
}

int HierarchicalGrid::row_of(double size, const Vector3d& centre) {
  std::size_t level = 0;
  while (level + 1 < width_.size() && size <= width_[level + 1]) ++level;
  return rows_.number({static_cast<std::int64_t>(level), cell(centre.y(), width_[level]),
                       cell(centre.z(), width_[level])});
}

void HierarchicalGrid::place_things() {
  rows_.restart(sizes_.size());
  balls_in_rows_.restart(radii_.size());
  for (std::size_t i = 0; i < radii_.size(); ++i) {
    if (sizes_[i] == kNoBall) continue;
    const int row = row_of(sizes_[i], centres_[i]);
    balls_in_rows_.place(row, static_cast<int>(i), centres_[i].x());
  }
  boxes_in_rows_.restart(boxes_.size());
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    const Vector3d centre = centre_of(boxes_[i]);
    const int row = row_of(sizes_[radii_.size() + i], centre);
    boxes_in_rows_.place(row, static_cast<int>(i), centre.x());
  }
  const std::size_t rows = rows_.keys().size();
  balls_in_rows_.settle(rows, [&](int index) {
    const auto i = static_cast<std::size_t>(index);
    return Ball{centres_[i], radii_[i], index};
  });
  boxes_in_rows_.settle(rows, [&](int index) {
    return Box{boxes_[static_cast<std::size_t>(index)], index};
  });
}

inline void HierarchicalGrid::meet(const Ball& a, const Ball& b) {
  const double reach = a.radius + b.radius + margin_;
  ball_pairs_.add_if((a.centre - b.centre).squaredNorm() < reach * reach, a.index, b.index);
}

inline void HierarchicalGrid::meet(const Ball& a, const Box& b) {
  ball_box_pairs_.add_if(separation(around(a), b.bounds) < margin_, a.index, b.index);
}

inline void HierarchicalGrid::meet(const Box& a, const Box& b) {
  box_pairs_.add_if(separation(a.bounds, b.bounds) < margin_, a.index, b.index);
}

// Two rows of one level: those that are not a width apart along x.
template <class A, class B>
void HierarchicalGrid::sweep(std::span<const A> as, std::span<const B> bs, double width) {
  const B* first = bs.data();
  const B* const end = first + bs.size();
  for (const A& a : as) {
    while (first != end && first->x() <= a.x() - width) ++first;
    for (const B* b = first; b != end && b->x() < a.x() + width; ++b) meet(a, *b);
  }
}

template <class Thing>
void HierarchicalGrid::sweep_itself(std::span<const Thing> things, double width) {
  for (std::size_t i = 0; i < things.size(); ++i) {
    const double end = things[i].x() + width;
    for (std::size_t j = i + 1; j < things.size() && things[j].x() < end; ++j) {
      meet(things[i], things[j]);
    }
  }
}

void HierarchicalGrid::sweep_level(int row) {
  const RowKey& key = rows_.keys()[static_cast<std::size_t>(row)];
  const double width = width_[static_cast<std::size_t>(key.level)];
  const auto balls = balls_in_rows_.row(row);
  const auto boxes = boxes_in_rows_.row(row);
  sweep_itself(balls, width);
  sweep_itself(boxes, width);
  sweep(balls, boxes, width);
  for (const auto& [y, z] : {std::pair{1, -1}, {1, 0}, {1, 1}, {0, 1}}) {
    const int other = rows_.find({key.level, key.y + y, key.z + z});
    if (other < 0) continue;
    sweep(balls, balls_in_rows_.row(other), width);
    sweep(balls, boxes_in_rows_.row(other), width);
    sweep(boxes, balls_in_rows_.row(other), width);
    sweep(boxes, boxes_in_rows_.row(other), width);
  }
}

// Where the centres of things up to `width` in size lie that may touch a thing.
template <class Thing>
Bounds HierarchicalGrid::reach_of(const Thing& thing, double width) const {
  const Bounds box = around(thing);
  const double extent = (box.high - box.low).maxCoeff();
  const double reach = 0.5 * (size_of(extent, centre_of(box)) - extent + width);
  return {box.low.array() - reach, box.high.array() + reach};
}

// Things of a row, and of a row on a coarser level, one of these at a time: what is long or flat
// costs little in the rows that it does not reach.
template <class Small, class Large>
void HierarchicalGrid::sweep_sizes(const RowKey& row, std::span<const Small> small,
                                   std::span<const Large> large, double large_width) {
  if (small.empty()) return;
  const auto up_to = [](double x) { return [x](const auto& thing) { return thing.x() <= x; }; };
  const double width = width_[static_cast<std::size_t>(row.level)];
  const double window = 0.5 * (width + large_width), end = small.back().x() + window;
  auto b = std::partition_point(large.begin(), large.end(), up_to(small.front().x() - window));
  for (; b != large.end() && b->x() < end; ++b) {
    const auto [low, high] = reach_of(*b, width);
    if (!overlap(row.y, width, low.y(), high.y()) || !overlap(row.z, width, low.z(), high.z())) {
      continue;
    }
    auto a = std::partition_point(small.begin(), small.end(), up_to(low.x()));
    for (; a != small.end() && a->x() < high.x(); ++a) meet(*a, *b);
  }
}

void HierarchicalGrid::sweep_coarser(int row, std::size_t level) {
  const RowKey& key = rows_.keys()[static_cast<std::size_t>(row)];
  const double own = width_[static_cast<std::size_t>(key.level)], width = width_[level];
  const double reach = 0.5 * (own + width);
  const auto first = [&](std::int64_t k) {
    return cell(static_cast<double>(k) * own - reach, width);
  };
  const auto last = [&](std::int64_t k) {
    return cell(static_cast<double>(k + 1) * own + reach, width);
  };
  for (std::int64_t y = first(key.y); y <= last(key.y); ++y) {
    for (std::int64_t z = first(key.z); z <= last(key.z); ++z) {
      const int other = rows_.find({static_cast<std::int64_t>(level), y, z});
      if (other < 0) continue;
      sweep_sizes(key, balls_in_rows_.row(row), balls_in_rows_.row(other), width);
      sweep_sizes(key, balls_in_rows_.row(row), boxes_in_rows_.row(other), width);
      sweep_sizes(key, boxes_in_rows_.row(row), balls_in_rows_.row(other), width);
      sweep_sizes(key, boxes_in_rows_.row(row), boxes_in_rows_.row(other), width);
    }
  }
}

void HierarchicalGrid::find_pairs(std::span<const Vector3d> centres, std::span<const double> radii,
                                  std::span<const Bounds> boxes, double margin, Candidates& out) {
  centres_ = centres;
  radii_ = radii;
  boxes_ = boxes;
  margin_ = margin;
  measure();
  choose_levels();
  place_things();
  ball_pairs_.restart();
  ball_box_pairs_.restart();
  box_pairs_.restart();
  for (std::size_t row = 0; row < rows_.keys().size(); ++row) {
    sweep_level(static_cast<int>(row));
    const auto own = static_cast<std::size_t>(rows_.keys()[row].level);
    for (std::size_t level = 0; level < own; ++level) {
      sweep_coarser(static_cast<int>(row), level);
    }
  }
  ball_pairs_.put_smaller_first();
  box_pairs_.put_smaller_first();
  ball_pairs_.write(radii.size(), out.balls);
  ball_box_pairs_.write(radii.size(), out.ball_box);
  box_pairs_.write(boxes.size(), out.boxes);
}

}  // namespace conebench::dem
