#include "dem/paint_order.h"

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <numeric>
#include <queue>

namespace conebench::dem {
namespace {

using Eigen::Vector2d;

// Two things that share a narrower strip, or are closer, hide nothing of each other.
constexpr double kVisible_px = 0.02;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

// > 0: x lies to the right of the way from a to b, as one sees it.
double side(const Vector2d& a, const Vector2d& b, const Vector2d& x) {
  return (b[0] - a[0]) * (x[1] - a[1]) - (b[1] - a[1]) * (x[0] - a[0]);
}

// The part of an contour to the left of the way from a to b.
Contour left_of(const Vector2d& a, const Vector2d& b, const Contour& contour) {
  Contour out;
  for (std::size_t k = 0; k < contour.size(); ++k) {
    const Vector2d &from = contour[k], &to = contour[(k + 1) % contour.size()];
    const double at_from = side(a, b, from), at_to = side(a, b, to);
    if (at_from <= 0.0) out.push_back(from);
    if (at_from * at_to < 0.0) out.push_back(from + at_from / (at_from - at_to) * (to - from));
  }
  return out;
}

bool is_visible(const Contour& contour) {
  double around = 0.0;
  for (std::size_t k = 0; k < contour.size(); ++k) {
    around += (contour[(k + 1) % contour.size()] - contour[k]).norm();
  }
  return area(contour) > 0.5 * around * kVisible_px;
}

// How much nearer `a` is than `b` in the middle of what they share [px]; 0 where nothing is hidden.
double lead(const Patch& a, const Patch& b) {
  if (a.is_level() && b.is_level()) return a.nearest - b.nearest;
  const Contour shared = clipped(a.contour, b.contour);
  if (!is_visible(shared)) return 0.0;
  const Vector2d middle = std::accumulate(shared.begin(), shared.end(), Vector2d(0.0, 0.0)) /
                          static_cast<double>(shared.size());
  const double lead = a.depth(middle) - b.depth(middle);
  return std::abs(lead) > kVisible_px ? lead : 0.0;
}

std::vector<int> sorted_by(const std::vector<double>& key) {
  std::vector<int> order(key.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return key[at(a)] < key[at(b)]; });
  return order;
}

std::vector<int> far_first(std::span<const Patch> patches) {
  std::vector<double> depth;
  for (const Patch& patch : patches) depth.push_back(0.5 * (patch.farthest + patch.nearest));
  return sorted_by(depth);
}

struct Hidings {
  std::vector<std::vector<int>> hidden_by;  // of each thing: who covers it
  std::vector<int> behind;                  // of each thing: how many it covers
};

// A sweep from left to right: of two boxes that overlap, one starts where the other has not ended.
Hidings compare_all(std::span<const Patch> patches) {
  std::vector<Eigen::AlignedBox2d> boxes(patches.size());
  std::vector<double> left;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (const Vector2d& x : patches[i].contour) boxes[i].extend(x);
    left.push_back(boxes[i].min()[0]);
  }
  Hidings out{std::vector<std::vector<int>>(patches.size()), std::vector<int>(patches.size(), 0)};
  const std::vector<int> order = sorted_by(left);
  for (std::size_t k = 0; k < order.size(); ++k) {
    const int i = order[k];
    for (std::size_t l = k + 1; l < order.size(); ++l) {
      const int j = order[l];
      if (left[at(j)] > boxes[at(i)].max()[0]) break;
      if (!boxes[at(i)].intersects(boxes[at(j)])) continue;
      const double ahead = lead(patches[at(i)], patches[at(j)]);
      if (ahead == 0.0) continue;
      out.hidden_by[at(ahead > 0.0 ? j : i)].push_back(ahead > 0.0 ? i : j);
      ++out.behind[at(ahead > 0.0 ? i : j)];
    }
  }
  return out;
}

}  // namespace

Contour clipped(Contour contour, const Contour& window) {
  for (std::size_t k = 0; k < window.size() && !contour.empty(); ++k) {
    contour = left_of(window[k], window[(k + 1) % window.size()], contour);
  }
  return contour;
}

double area(const Contour& contour) {
  double twice = 0.0;
  for (std::size_t k = 2; k < contour.size(); ++k) {
    twice -= side(contour[0], contour[k - 1], contour[k]);
  }
  return 0.5 * twice;
}

std::vector<int> paint_order(std::span<const Patch> patches) {
  const std::vector<int> by_depth = far_first(patches);
  if (std::all_of(patches.begin(), patches.end(), std::mem_fn(&Patch::is_level))) return by_depth;
  auto [hidden_by, behind] = compare_all(patches);

  std::vector<int> rank(patches.size());
  for (std::size_t k = 0; k < by_depth.size(); ++k) rank[at(by_depth[k])] = static_cast<int>(k);
  std::priority_queue<int, std::vector<int>, std::greater<>> ready;  // ranks
  for (std::size_t k = 0; k < by_depth.size(); ++k) {
    if (behind[at(by_depth[k])] == 0) ready.push(static_cast<int>(k));
  }

  std::vector<bool> painted(patches.size(), false);
  std::vector<int> out;
  const auto paint = [&](int i) {
    painted[at(i)] = true;
    out.push_back(i);
    for (const int j : hidden_by[at(i)]) {
      if (--behind[at(j)] == 0 && !painted[at(j)]) ready.push(rank[at(j)]);
    }
  };
  for (const int farthest_left : by_depth) {
    while (!ready.empty()) {
      const int i = by_depth[at(ready.top())];
      ready.pop();
      paint(i);
    }
    if (!painted[at(farthest_left)]) paint(farthest_left);  // a ring
  }
  return out;
}

}  // namespace conebench::dem
