#include "dem/neighbours.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace conebench::dem {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

std::vector<double> until_of(std::span<const Plane> planes) {
  std::vector<double> out;
  for (const Plane& plane : planes) out.push_back(plane.until_s);
  return out;
}

// The touches of one pair, from `first` on, as they are in the plane y = 0.
void flatten(std::vector<Near>& found, std::size_t first) {
  std::size_t kept = first;
  for (std::size_t i = first; i < found.size(); ++i) {
    Touch touch = found[i].touch;
    touch.normal.y() = touch.point.y() = 0.0;
    const double length = touch.normal.norm();
    if (length < 0.5) continue;  // it faces along y
    touch.normal /= length;
    const auto same = [&](const Near& other) {
      return (other.touch.point - touch.point).norm() <= 1e-9 * (1.0 + touch.point.norm());
    };
    const auto begin = found.begin() + static_cast<std::ptrdiff_t>(first);
    const auto end = found.begin() + static_cast<std::ptrdiff_t>(kept);
    if (std::any_of(begin, end, same)) continue;
    found[kept] = found[i];
    found[kept++].touch = touch;
  }
  found.resize(kept);
}

}  // namespace

Neighbours::Neighbours(const Placement& placement, int dimension)
    : solids_(placement.solids),
      until_s_(until_of(placement.planes)),
      dimension_(dimension),
      narrow_(placement.pieces) {
  const Bodies& bodies = placement.bodies;
  for (int i = 0; i < bodies.count(); ++i) {
    if (bodies.is_ball(i)) continue;
    const int parts = static_cast<int>(solid_of(bodies, i).parts.size());
    for (int part = 0; part < parts; ++part) proxies_.push_back({i, part});
  }
  bounds_.resize(proxies_.size());
}

const Solid& Neighbours::solid_of(const Bodies& bodies, int body) const {
  return solids_[at(bodies.solid[at(body)])];
}

Pose Neighbours::part_pose(const Bodies& bodies, const Proxy& proxy) const {
  return bodies.pose(proxy.body) * solid_of(bodies, proxy.body).parts[at(proxy.part)].pose;
}

int Neighbours::piece_of(const Bodies& bodies, const Proxy& proxy) const {
  return solid_of(bodies, proxy.body).pieces[at(proxy.part)];
}

void Neighbours::bound_parts(const Bodies& bodies) {
  for (std::size_t k = 0; k < proxies_.size(); ++k) {
    const Part& part = solid_of(bodies, proxies_[k].body).parts[at(proxies_[k].part)];
    bounds_[k] = bounds_of(part.piece, part_pose(bodies, proxies_[k]));
  }
}

// Appends touches_, found for (body, other) in either order, and empties them.
void Neighbours::append(int body, int other, std::vector<Near>& found) {
  const std::size_t first = found.size();
  for (Touch& touch : touches_) {
    if (body > other) touch.normal = -touch.normal;
    found.push_back({std::min(body, other), std::max(body, other), touch});
  }
  touches_.clear();
  if (dimension_ == 2) flatten(found, first);
}

void Neighbours::add_ball_pairs(const Bodies& bodies, double reach, std::vector<Near>& found) {
  for (const auto& [first, second] : candidates_.balls) {
    if (!bodies.is_free(first) && !bodies.is_free(second)) continue;
    const auto a = at(first), b = at(second);
    const Eigen::Vector3d offset = bodies.position[a] - bodies.position[b];
    const double distance = offset.norm();
    const double gap = distance - bodies.radius[a] - bodies.radius[b];
    if (gap >= reach) continue;
    Near near{first, second, {}};
    near.touch.gap = gap;
    near.touch.normal =
        distance > 0.0 ? Eigen::Vector3d(offset / distance) : Eigen::Vector3d::UnitZ();
    near.touch.point = bodies.position[a] - (bodies.radius[a] + 0.5 * gap) * near.touch.normal;
    found.push_back(near);
  }
}

void Neighbours::add_ball_parts(const Bodies& bodies, double reach, std::vector<Near>& found) {
  for (const auto& [ball, box] : candidates_.ball_box) {
    const Proxy& proxy = proxies_[at(box)];
    if (!bodies.is_free(ball) && !bodies.is_free(proxy.body)) continue;
    narrow_.ball_touches(bodies.position[at(ball)], bodies.radius[at(ball)],
                         piece_of(bodies, proxy), part_pose(bodies, proxy), reach, touches_);
    append(ball, proxy.body, found);
  }
}

void Neighbours::add_part_pairs(const Bodies& bodies, double reach, std::vector<Near>& found) {
  for (const auto& [first, second] : candidates_.boxes) {
    const Proxy& a = proxies_[at(first)];
    const Proxy& b = proxies_[at(second)];
    if (a.body == b.body || (!bodies.is_free(a.body) && !bodies.is_free(b.body))) continue;
    narrow_.touches(piece_of(bodies, a), part_pose(bodies, a), piece_of(bodies, b),
                    part_pose(bodies, b), reach, touches_);
    append(a.body, b.body, found);
  }
}

void Neighbours::add_planes(const Bodies& bodies, double reach, double time_s,
                            std::vector<Near>& found) {
  for (int p = 0; p < bodies.planes; ++p) {
    if (time_s >= until_s_[at(p)]) continue;
    const int plane = bodies.count() + p;
    const Eigen::Vector3d normal = bodies.plane_normal(plane);
    const Eigen::Vector3d& point = bodies.position[at(plane)];
    for (int i = 0; i < bodies.count(); ++i) {
      if (!bodies.is_free(i)) continue;
      if (bodies.is_ball(i)) {
        const double radius = bodies.radius[at(i)];
        const double gap = normal.dot(bodies.position[at(i)] - point) - radius;
        if (gap >= reach) continue;
        touches_.push_back({bodies.position[at(i)] - (radius + 0.5 * gap) * normal, normal, gap});
      } else {
        const Solid& solid = solid_of(bodies, i);
        for (const Part& part : solid.parts) {
          plane_touches(part.piece, bodies.pose(i) * part.pose, point, normal, reach, touches_);
        }
      }
      append(i, plane, found);
    }
  }
}

void Neighbours::find(const Bodies& bodies, double reach_m, double time_s,
                      std::vector<Near>& found) {
  found.clear();
  bound_parts(bodies);
  const auto count = at(bodies.count());
  grid_.find_pairs(std::span(bodies.position).first(count), std::span(bodies.radius).first(count),
                   bounds_, reach_m, candidates_);
  add_ball_pairs(bodies, reach_m, found);
  add_ball_parts(bodies, reach_m, found);
  add_part_pairs(bodies, reach_m, found);
  add_planes(bodies, reach_m, time_s, found);
  std::stable_sort(found.begin(), found.end(), [](const Near& a, const Near& b) {
    return std::pair(a.body, a.other) < std::pair(b.body, b.other);
  });
}

}  // namespace conebench::dem
