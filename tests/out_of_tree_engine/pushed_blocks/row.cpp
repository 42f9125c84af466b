#include "row.h"

#include <algorithm>
#include <cstdio>

using conebench::problems::Cone;
using conebench::problems::Geometry;
using conebench::problems::Metadata;
using conebench::problems::PrimalData;
using conebench::problems::Problem;
using conebench::problems::SparseMatrix;

namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

SparseMatrix matrix(int rows, int columns, const Triplets& entries) {
  SparseMatrix made(rows, columns);
  made.setFromTriplets(entries.begin(), entries.end());
  return made;
}

}  // namespace

Row::Row() : x(blocks), y(blocks), velocity(Eigen::VectorXd::Zero(2 * blocks)) {
  for (int i = 0; i < blocks; ++i) {
    x(i) = i * side_m;
    y(i) = 0.5 * side_m;
  }
}

Problem Row::problem(int step) const {
  const int dofs = 2 * blocks, contacts = 2 * blocks - 1;
  Triplets M, H;
  for (int k = 0; k < dofs; ++k) M.emplace_back(k, k, mass_kg);

  // f = M v_minus + h f_ext
  Eigen::VectorXd f = mass_kg * velocity;
  for (int i = 0; i < blocks; ++i) f(2 * i + 1) -= step_s * mass_kg * gravity_m_s2;
  f(0) += step_s * push_per_step_N * (step + 1);

  // u = H v + w: rates of opening and of sliding; w = gap / h lets a contact close within the step.
  Eigen::VectorXd w = Eigen::VectorXd::Zero(2 * contacts);
  for (int i = 0; i + 1 < blocks; ++i) {
    for (int k = 0; k < 2; ++k) {
      H.emplace_back(2 * i + k, 2 * i + k, -1.0);
      H.emplace_back(2 * i + k, 2 * (i + 1) + k, 1.0);
    }
    w(2 * i) = std::max(0.0, x(i + 1) - x(i) - side_m) / step_s;
  }
  for (int i = 0; i < blocks; ++i) {
    const int row = 2 * (blocks - 1 + i);
    H.emplace_back(row, 2 * i + 1, 1.0);
    H.emplace_back(row + 1, 2 * i, 1.0);
    w(row) = std::max(0.0, y(i) - 0.5 * side_m) / step_s;
  }

  char name[32];
  std::snprintf(name, sizeof name, "pushed-blocks_%06d", step);
  const std::vector<Cone> cones(static_cast<std::size_t>(contacts), Cone::coulomb(2, friction));
  return {PrimalData{matrix(dofs, dofs, M), matrix(2 * contacts, dofs, H), f, w}, cones,
          Metadata{.name = name,
                   .engine = "pushed_blocks",
                   .scene = "pushed-blocks",
                   .step = step,
                   .step_size_s = step_s}};
}

Geometry Row::geometry() const {
  const int contacts = 2 * blocks - 1;
  Geometry geometry;
  geometry.points.resize(contacts, 3);
  geometry.frames.resize(contacts, 9);  // normal, first and second tangent
  geometry.bodies_of_cone.resize(contacts, 2);
  for (int i = 0; i + 1 < blocks; ++i) {
    geometry.points.row(i) << 0.5 * (x(i) + x(i + 1)), y(i), 0.0;
    geometry.frames.row(i) << 1, 0, 0, 0, 1, 0, 0, 0, 1;
    geometry.bodies_of_cone.row(i) << i + 1, i;  // the normal points towards the first
  }
  for (int i = 0; i < blocks; ++i) {
    geometry.points.row(blocks - 1 + i) << x(i), 0.0, 0.0;
    geometry.frames.row(blocks - 1 + i) << 0, 1, 0, 1, 0, 0, 0, 0, -1;
    geometry.bodies_of_cone.row(blocks - 1 + i) << i, -1;  // -1: a wall or the ground
  }
  geometry.body_positions.resize(blocks, 3);
  geometry.body_positions << x, y, Eigen::VectorXd::Zero(blocks);
  geometry.body_radii = Eigen::VectorXd::Zero(blocks);  // no spheres
  return geometry;
}

void Row::advance(const Eigen::VectorXd& velocity_at_end) {
  velocity = velocity_at_end;
  for (int i = 0; i < blocks; ++i) {
    x(i) += step_s * velocity(2 * i);
    y(i) += step_s * velocity(2 * i + 1);
  }
}

double Row::expected_velocity_m_s(int steps) const {
  double sum = 0.0;
  for (int step = 0; step < steps; ++step) {
    const double push = push_per_step_N * (step + 1) / (blocks * mass_kg);
    sum += step_s * std::max(0.0, push - friction * gravity_m_s2);
  }
  return sum;
}
