#include "dem/assembly.h"

#include <algorithm>
#include <optional>
#include <span>

namespace conebench::dem {
namespace {

using problems::Cone;
using problems::SparseMatrix;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

// The components of a velocity that are dofs, linear and angular.
struct Axes {
  std::span<const int> linear, angular;

  explicit Axes(int dimension) {
    static constexpr int kAll[] = {0, 1, 2}, kPlane[] = {0, 2}, kTurn[] = {1};
    linear = dimension == 2 ? std::span<const int>(kPlane) : std::span<const int>(kAll);
    angular = dimension == 2 ? std::span<const int>(kTurn) : std::span<const int>(kAll);
  }
  int count() const { return static_cast<int>(linear.size() + angular.size()); }
};

// Appends rows to a compressed matrix, in order. Zeros are left out: every first tangent has one.
class RowWriter {
 public:
  RowWriter(SparseMatrix& matrix, Eigen::Index rows, Eigen::Index columns, Eigen::Index capacity)
      : matrix_(matrix) {
    matrix_.resize(rows, columns);
    matrix_.resizeNonZeros(capacity);
    matrix_.outerIndexPtr()[0] = 0;
  }

  void add(int column, double value) {
    if (value == 0.0) return;
    matrix_.innerIndexPtr()[next_] = column;
    matrix_.valuePtr()[next_++] = value;
  }
  void end_row() { matrix_.outerIndexPtr()[++row_] = next_; }
  void finish() { matrix_.resizeNonZeros(next_); }

 private:
  SparseMatrix& matrix_;
  int row_ = 0;
  int next_ = 0;
};

SparseMatrix mass_matrix(const Axes& axes, const Bodies& bodies) {
  SparseMatrix M;
  RowWriter rows(M, bodies.dofs, bodies.dofs, 2 * bodies.dofs);
  for (int i = 0; i < bodies.count(); ++i) {
    if (!bodies.is_free(i)) continue;
    int dof = bodies.first_dof[at(i)];
    for (std::size_t k = 0; k < axes.linear.size(); ++k) {
      rows.add(dof++, bodies.mass[at(i)]);
      rows.end_row();
    }
    const Eigen::Matrix3d J = bodies.inertia(i);
    for (const int row : axes.angular) {
      for (std::size_t k = 0; k < axes.angular.size(); ++k) {
        rows.add(dof + static_cast<int>(k), J(row, axes.angular[k]));
      }
      rows.end_row();
    }
  }
  rows.finish();
  return M;
}

Eigen::VectorXd free_momentum(const Scene& scene, const Axes& axes, const Bodies& bodies) {
  Eigen::VectorXd f(bodies.dofs);
  for (int i = 0; i < bodies.count(); ++i) {
    if (!bodies.is_free(i)) continue;
    const auto b = at(i);
    const Eigen::Vector3d linear =
        bodies.mass[b] * (bodies.velocity[b] + scene.step_s * scene.gravity_m_s2);
    const Eigen::Vector3d angular = spin(bodies, i) - scene.step_s * gyroscopic(bodies, i);
    int dof = bodies.first_dof[b];
    for (const int k : axes.linear) f[dof++] = linear[k];
    for (const int k : axes.angular) f[dof++] = angular[k];
  }
  return f;
}

// One body's part of a row: direction . (+-v + omega x arm). A ball's normal turns nothing.
void add_body(const Axes& axes, const Bodies& bodies, int body, double sign,
              const Eigen::Vector3d& arm, const Eigen::Vector3d& direction, bool normal,
              RowWriter& H) {
  int dof = bodies.first_dof[at(body)];
  if (dof < 0) return;
  for (const int k : axes.linear) H.add(dof++, sign * direction[k]);
  if (normal && bodies.is_ball(body)) return;
  const Eigen::Vector3d torque = sign * arm.cross(direction);
  for (const int k : axes.angular) H.add(dof++, torque[k]);
}

void write_H(const Scene& scene, const Axes& axes, const Bodies& bodies, const ContactList& list,
             Assembly& out) {
  Eigen::Index rows = 0;
  for (const Cone& cone : out.cones) rows += cone.dim;
  RowWriter H(out.data.H, rows, bodies.dofs, 2 * axes.count() * rows);
  for (std::size_t i = 0; i < out.cones.size(); ++i) {
    const Contact& contact = list.contacts()[at(out.entered[i])];
    const Eigen::Matrix3d frame = frame_of(contact, scene.dimension);
    const Eigen::Vector3d arm = arm_of_body(bodies, contact);
    const Eigen::Vector3d other_arm = arm_of_other(bodies, contact);
    for (int row = 0; row < out.cones[i].dim; ++row) {
      const Eigen::Vector3d direction = frame.col(row);
      add_body(axes, bodies, contact.body, 1.0, arm, direction, row == 0, H);
      add_body(axes, bodies, contact.other, -1.0, other_arm, direction, row == 0, H);
      H.end_row();
    }
  }
  H.finish();
}

// a_n of a contact that enters the step's problem, or nothing.
std::optional<double> entering_rate(const Contact& contact, const PairLaw& law,
                                    const Bodies& bodies, double step_s) {
  if (law.restitution == 0.0 || (contact.bonded && contact.gap > 0.0)) {
    return std::max(contact.gap, 0.0) / step_s;
  }
  const double u_n = contact.normal.dot(relative_velocity(bodies, contact));
  if (!contact.bonded && contact.gap + 0.5 * step_s * u_n > 0.0) return std::nullopt;
  return law.restitution * std::min(u_n, 0.0);
}

void choose_cones(const Scene& scene, const Bodies& bodies, const ContactList& list, Assembly& out,
                  std::vector<double>& normal_rates) {
  for (std::size_t i = 0; i < list.contacts().size(); ++i) {
    const Contact& contact = list.contacts()[i];
    const PairLaw& law = list.law_of(contact);
    const auto rate = entering_rate(contact, law, bodies, scene.step_s);
    if (!rate) continue;
    const double kappa = contact.bonded ? scene.step_s * law.strength_N(contact.gap) : 0.0;
    out.cones.push_back(
        Cone::coulomb(law.friction > 0.0 ? scene.dimension : 1, law.friction, kappa));
    out.entered.push_back(static_cast<int>(i));
    normal_rates.push_back(*rate);
  }
}

void write_w_and_guess(const Scene& scene, const Bodies& bodies, const ContactList& list,
                       const std::vector<double>& normal_rates, Assembly& out) {
  out.data.w.resize(out.data.H.rows());
  out.guess.resize(out.data.H.rows());
  Eigen::Index start = 0;
  for (std::size_t i = 0; i < out.cones.size(); ++i) {
    const Contact& contact = list.contacts()[at(out.entered[i])];
    const int dim = out.cones[i].dim;
    const Eigen::Matrix3d frame = frame_of(contact, scene.dimension);
    const Eigen::Vector3d driven = frame.transpose() * driven_velocity(bodies, contact);
    const Eigen::Vector3d reaction = frame.transpose() * contact.reaction;
    for (int k = 0; k < dim; ++k) {
      out.data.w[start + k] = driven[k];
      out.guess[start + k] = reaction[k];
    }
    out.data.w[start] += normal_rates[i];
    out.guess[start] += out.cones[i].kappa;
    start += dim;
  }
}

}  // namespace

Assembly assemble(const Scene& scene, const Bodies& bodies, const ContactList& list) {
  const Axes axes(scene.dimension);
  Assembly out;
  std::vector<double> normal_rates;
  choose_cones(scene, bodies, list, out, normal_rates);
  out.data.M = mass_matrix(axes, bodies);
  out.data.f = free_momentum(scene, axes, bodies);
  write_H(scene, axes, bodies, list, out);
  write_w_and_guess(scene, bodies, list, normal_rates, out);
  return out;
}

void scatter_velocity(int dimension, const Eigen::VectorXd& v, Bodies& bodies) {
  const Axes axes(dimension);
  for (int i = 0; i < bodies.count(); ++i) {
    if (!bodies.is_free(i)) continue;
    int dof = bodies.first_dof[at(i)];
    for (const int k : axes.linear) bodies.velocity[at(i)][k] = v[dof++];
    for (const int k : axes.angular) bodies.angular_velocity[at(i)][k] = v[dof++];
  }
}

}  // namespace conebench::dem
