#include "dem/assembly.h"

#include <algorithm>
#include <numeric>
#include <optional>

namespace conebench::dem {
namespace {

using problems::Cone;
using problems::SparseMatrix;

// a_n of a contact that enters the step's problem, or nothing.
std::optional<double> entering_rate(const Contact& contact, const PairLaw& law,
                                    const Spheres& spheres, double step_s) {
  if (law.restitution == 0.0 || (contact.bonded && contact.gap > 0.0)) {
    return std::max(contact.gap, 0.0) / step_s;
  }
  const double u_n = contact.normal().dot(relative_velocity(spheres, contact));
  if (!contact.bonded && contact.gap + 0.5 * step_s * u_n > 0.0) return std::nullopt;
  return law.restitution * std::min(u_n, 0.0);
}

// The diagonal of M, six entries a free sphere.
Eigen::VectorXd mass_diagonal(const Spheres& spheres) {
  Eigen::VectorXd diagonal(spheres.dofs);
  for (std::size_t i = 0; i < spheres.mass.size(); ++i) {
    if (spheres.first_dof[i] < 0) continue;
    diagonal.segment<3>(spheres.first_dof[i]).setConstant(spheres.mass[i]);
    diagonal.segment<3>(spheres.first_dof[i] + 3).setConstant(spheres.inertia[i]);
  }
  return diagonal;
}

SparseMatrix diagonal_matrix(const Eigen::VectorXd& diagonal) {
  const auto n = diagonal.size();
  SparseMatrix M(n, n);
  M.resizeNonZeros(n);
  std::iota(M.outerIndexPtr(), M.outerIndexPtr() + n + 1, 0);
  std::iota(M.innerIndexPtr(), M.innerIndexPtr() + n, 0);
  std::copy_n(diagonal.data(), n, M.valuePtr());
  return M;
}

Eigen::VectorXd free_momentum(const Scene& scene, const Spheres& spheres) {
  Eigen::VectorXd f(spheres.dofs);
  for (std::size_t i = 0; i < spheres.mass.size(); ++i) {
    if (spheres.first_dof[i] < 0) continue;
    f.segment<3>(spheres.first_dof[i]) =
        spheres.mass[i] * (spheres.velocity[i] + scene.step_s * scene.gravity_m_s2);
    f.segment<3>(spheres.first_dof[i] + 3) = spheres.inertia[i] * spheres.angular_velocity[i];
  }
  return f;
}

// Appends entries to the rows of a compressed matrix, in order.
class RowWriter {
 public:
  RowWriter(SparseMatrix& matrix, Eigen::Index rows, Eigen::Index columns, Eigen::Index capacity)
      : matrix_(matrix) {
    matrix_.resize(rows, columns);
    matrix_.resizeNonZeros(capacity);
    matrix_.outerIndexPtr()[0] = 0;
  }

  void add(int first_column, const Eigen::Vector3d& values) {
    for (int k = 0; k < 3; ++k, ++next_) {
      matrix_.innerIndexPtr()[next_] = first_column + k;
      matrix_.valuePtr()[next_] = values[k];
    }
  }
  void end_row() { matrix_.outerIndexPtr()[++row_] = next_; }
  void finish() { matrix_.resizeNonZeros(next_); }

 private:
  SparseMatrix& matrix_;
  int row_ = 0;
  int next_ = 0;
};

// One sphere's part of a contact's rows: direction . (+-v + omega x arm), arm = -+ R n. Both signs
// cancel in the torque -R (n x direction), which is the same for either partner: 0 for the normal
// (left out), -R t2 for the first tangent, R t1 for the second.
void add_sphere(const Spheres& spheres, int body, double sign, const Contact& contact, int row,
                RowWriter& H) {
  const auto i = static_cast<std::size_t>(body);
  const int dof = spheres.first_dof[i];
  if (dof < 0) return;
  H.add(dof, sign * contact.frame.col(row));
  if (row == 1) H.add(dof + 3, -spheres.radius[i] * contact.frame.col(2));
  if (row == 2) H.add(dof + 3, spheres.radius[i] * contact.frame.col(1));
}

void write_rows(const Spheres& spheres, const ContactList& list, Assembly& out) {
  Eigen::Index rows = 0;
  for (const Cone& cone : out.cones) rows += cone.dim;
  RowWriter H(out.data.H, rows, spheres.dofs, 12 * rows);
  for (std::size_t i = 0; i < out.cones.size(); ++i) {
    const Contact& contact = list.contacts()[static_cast<std::size_t>(out.entered[i])];
    for (int row = 0; row < out.cones[i].dim; ++row) {
      add_sphere(spheres, contact.body, 1.0, contact, row, H);
      if (!contact.with_plane()) add_sphere(spheres, contact.other, -1.0, contact, row, H);
      H.end_row();
    }
  }
  H.finish();
}

void write_guess(const ContactList& list, Assembly& out) {
  out.guess.resize(out.data.w.size());
  Eigen::Index start = 0;
  for (std::size_t i = 0; i < out.cones.size(); ++i) {
    const Contact& contact = list.contacts()[static_cast<std::size_t>(out.entered[i])];
    const int dim = out.cones[i].dim;
    for (int k = 0; k < dim; ++k) {
      out.guess[start + k] = contact.frame.col(k).dot(contact.reaction);
    }
    out.guess[start] += out.cones[i].kappa;
    start += dim;
  }
}

}  // namespace

Assembly assemble(const Scene& scene, const Spheres& spheres, const ContactList& list) {
  Assembly out;
  std::vector<double> normal_rates;
  for (std::size_t i = 0; i < list.contacts().size(); ++i) {
    const Contact& contact = list.contacts()[i];
    const PairLaw& law = list.law_of(contact);
    const auto rate = entering_rate(contact, law, spheres, scene.step_s);
    if (!rate) continue;
    const double kappa = contact.bonded ? scene.step_s * law.tensile_force_N : 0.0;
    out.cones.push_back(Cone::coulomb(law.friction > 0.0 ? 3 : 1, law.friction, kappa));
    out.entered.push_back(static_cast<int>(i));
    normal_rates.push_back(*rate);
  }
  out.data.M = diagonal_matrix(mass_diagonal(spheres));
  out.data.f = free_momentum(scene, spheres);
  write_rows(spheres, list, out);
  out.data.w = Eigen::VectorXd::Zero(out.data.H.rows());
  Eigen::Index start = 0;
  for (std::size_t i = 0; i < out.cones.size(); ++i) {
    out.data.w[start] = normal_rates[i];
    start += out.cones[i].dim;
  }
  write_guess(list, out);
  return out;
}

}  // namespace conebench::dem
