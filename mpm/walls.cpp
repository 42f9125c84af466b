#include "mpm/walls.h"

#include <cmath>

namespace conebench::mpm {
namespace {

void hold(Condition condition, int axis, NodeWalls& walls) {
  const auto a = static_cast<std::size_t>(axis);
  if (condition == Condition::kStick) walls.held = {true, true, true};
  if (condition == Condition::kSlip) walls.held[a] = walls.smooth[a] = true;
}

Eigen::Matrix3d frame_around(const Eigen::Vector3d& normal, int dim) {
  Eigen::Matrix3d frame;
  frame.col(0) = normal;
  if (dim == 2) {
    frame.col(1) = Eigen::Vector3d(-normal.y(), normal.x(), 0.0);
    frame.col(2) = Eigen::Vector3d::UnitZ();
    return frame;
  }
  Eigen::Index axis;
  normal.cwiseAbs().minCoeff(&axis);
  frame.col(1) = normal.cross(Eigen::Vector3d::Unit(axis)).normalized();
  frame.col(2) = normal.cross(frame.col(1));
  return frame;
}

Eigen::Vector3d inward(int axis, bool high) {
  return (high ? -1.0 : 1.0) * Eigen::Vector3d::Unit(axis);
}

// The integral of a node's shape function on a regular grid over the face with this normal, at
// `place` along it [m2].
double face_area(const Grid& grid, int node, int axis, int place) {
  const Eigen::Vector3i at = grid.place(node);
  if (at[axis] != place) return 0.0;
  double area = 1.0;
  for (int a = 0; a < grid.dim; ++a) {
    if (a == axis) continue;
    area *= grid.spacing(a) * (at[a] == 0 || at[a] == grid.cells[a] ? 0.5 : 1.0);
  }
  return area;
}

void add_wall_cones(const Scene& scene, const Nodes& nodes, int slot, std::vector<Interface>& out) {
  const Grid& grid = nodes.mesh.grid();
  const int node = nodes.index[static_cast<std::size_t>(slot)];
  const Eigen::Vector3i at = grid.place(node);
  for (int axis = 0; axis < grid.dim; ++axis) {
    for (const bool high : {false, true}) {
      const Wall& wall = scene.wall(axis, high);
      if (wall.condition != Condition::kFrictional) continue;
      const int end = high ? grid.cells[axis] : 0;
      if (at[axis] != end) continue;
      const auto area = [&](int i) { return face_area(grid, i, axis, end); };
      Interface contact;
      contact.point = grid.position(node);
      contact.frame = frame_around(inward(axis, high), grid.dim);
      contact.node = slot;
      contact.weight = nodes.mesh.integral(node, area) * nodes.fraction(slot);
      contact.friction = wall.friction;
      out.push_back(contact);
    }
  }
}

void add_body_cones(const Nodes& nodes, int slot, const std::vector<RigidBody>& bodies,
                    std::vector<Interface>& out) {
  const Grid& grid = nodes.mesh.grid();
  const Eigen::Vector3d x = grid.position(nodes.index[static_cast<std::size_t>(slot)]);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const Distance distance = distance_to(bodies[b], grid.dim, x);
    if (distance.value > 0.0) continue;
    Interface contact;
    contact.point = x;
    contact.frame = frame_around(distance.normal, grid.dim);
    contact.node = slot;
    contact.body = static_cast<int>(b);
    contact.weight = nodes.solid[slot] / grid.smallest_spacing();
    contact.friction = bodies[b].body.friction;
    out.push_back(contact);
  }
}

void add_body_wall_cones(const Scene& scene, const RigidBody& body, int index,
                         std::vector<Interface>& out) {
  const Grid& grid = scene.grid;
  const double skin = grid.smallest_spacing();
  for (int axis = 0; axis < grid.dim; ++axis) {
    for (const bool high : {false, true}) {
      if (scene.wall(axis, high).condition == Condition::kFree) continue;
      const Eigen::Vector3d normal = inward(axis, high);
      const double wall = grid.low_m[axis] + (high ? grid.size_m[axis] : 0.0);
      for (const Eigen::Vector3d& point : surface_points(body, grid.dim, normal)) {
        const double gap = (point[axis] - wall) * normal[axis];
        if (gap > skin) continue;
        Interface contact;
        contact.point = point;
        contact.frame = frame_around(normal, grid.dim);
        contact.body = index;
        contact.weight = grid.cell_volume() / grid.smallest_spacing();
        contact.friction = body.body.friction;
        contact.gap_m = std::max(gap, 0.0);
        out.push_back(contact);
      }
    }
  }
}

}  // namespace

bool covers(const Barrier& barrier, const Eigen::Vector3d& gravity_m_s2, int dim,
            const Eigen::Vector3d& x, double time_s) {
  const double open_s = time_s - barrier.opens_s;
  if (open_s >= 0.0 && barrier.opening_m_s == 0.0) return false;
  Eigen::Vector3d low = barrier.low_m, high = barrier.high_m;
  if (open_s > 0.0) {
    Eigen::Index vertical;
    gravity_m_s2.cwiseAbs().maxCoeff(&vertical);
    const double up = gravity_m_s2[vertical] < 0.0 ? 1.0 : -1.0;
    const double lift = barrier.opening_m_s * open_s * up;
    low[vertical] += lift;
    high[vertical] += lift;
  }
  for (int a = 0; a < dim; ++a) {
    if (a == barrier.axis) continue;
    const double slack = 1e-9 * (barrier.high_m[a] - barrier.low_m[a]);
    if (x[a] < low[a] - slack || x[a] > high[a] + slack) return false;
  }
  return true;
}

bool holds(const Scene& scene, const Barrier& barrier, int node, double time_s) {
  const Grid grid = scene.grid.finest();
  const double plane = (barrier.position_m - grid.low_m[barrier.axis]) / grid.spacing(barrier.axis);
  return grid.place(node)[barrier.axis] == std::lround(plane) &&
         covers(barrier, scene.gravity_m_s2, grid.dim, grid.position(node), time_s);
}

NodeWalls walls_at(const Scene& scene, int node, double time_s) {
  const Grid grid = scene.grid.finest();
  const Eigen::Vector3i at = grid.place(node);
  NodeWalls walls;
  for (int axis = 0; axis < grid.dim; ++axis) {
    if (at[axis] == 0) hold(scene.wall(axis, false).condition, axis, walls);
    if (at[axis] == grid.cells[axis]) hold(scene.wall(axis, true).condition, axis, walls);
  }
  for (const Barrier& barrier : scene.barriers) {
    if (holds(scene, barrier, node, time_s)) hold(barrier.condition, barrier.axis, walls);
  }
  return walls;
}

std::vector<Interface> find_interfaces(const Scene& scene, const Nodes& nodes,
                                       const std::vector<RigidBody>& bodies) {
  std::vector<Interface> found;
  for (int slot = 0; slot < nodes.count(); ++slot) {
    add_wall_cones(scene, nodes, slot, found);
    add_body_cones(nodes, slot, bodies, found);
  }
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (bodies[b].moves_freely()) {
      add_body_wall_cones(scene, bodies[b], static_cast<int>(b), found);
    }
  }
  return found;
}

}  // namespace conebench::mpm
