#include "dem/energy.h"

#include <algorithm>
#include <cmath>

namespace conebench::dem {

double EnergyLedger::closure_J() const {
  return kinetic_J + potential_J - initial_J -
         (bond_J + friction_J + impact_J + driven_J + gyro_J + scheme_J);
}

double EnergyLedger::relative_closure() const {
  double largest = 0.0;
  for (const double entry : {kinetic_J, potential_J, initial_J, bond_J, friction_J, impact_J,
                             driven_J, gyro_J, scheme_J}) {
    largest = std::max(largest, std::abs(entry));
  }
  return largest > 0.0 ? std::abs(closure_J()) / largest : 0.0;
}

double kinetic_energy(const Bodies& bodies) {
  double sum = 0.0;
  for (int i = 0; i < bodies.count(); ++i) {
    if (!bodies.is_free(i)) continue;
    const auto b = static_cast<std::size_t>(i);
    sum += 0.5 * bodies.mass[b] * bodies.velocity[b].squaredNorm() +
           0.5 * bodies.angular_velocity[b].dot(spin(bodies, i));
  }
  return sum;
}

double potential_energy(const Scene& scene, const Bodies& bodies) {
  double sum = 0.0;
  for (int i = 0; i < bodies.count(); ++i) {
    if (!bodies.is_free(i)) continue;
    const auto b = static_cast<std::size_t>(i);
    sum -= bodies.mass[b] * scene.gravity_m_s2.dot(bodies.position[b]);
  }
  return sum;
}

void book_work(const Eigen::Vector3d& r, double kappa, const Eigen::Vector3d& u_before,
               const Eigen::Vector3d& u_after, const Eigen::Vector3d& driven,
               EnergyLedger& ledger) {
  const Eigen::Vector3d u = 0.5 * (u_before + u_after);
  ledger.bond_J -= kappa * u[0];
  ledger.impact_J += (r[0] + kappa) * u[0];
  ledger.friction_J += r.tail<2>().dot(u.tail<2>());
  ledger.driven_J -= r.dot(driven);
}

void book_scheme(const Scene& scene, const Bodies& before, const Bodies& after,
                 EnergyLedger& ledger) {
  const double h = scene.step_s;
  for (int i = 0; i < after.count(); ++i) {
    if (!after.is_free(i)) continue;
    const auto b = static_cast<std::size_t>(i);
    const Eigen::Vector3d change = after.velocity[b] - before.velocity[b];
    ledger.scheme_J -= 0.5 * h * after.mass[b] * scene.gravity_m_s2.dot(change);
    if (after.is_ball(i)) continue;
    const Eigen::Vector3d& omega = after.angular_velocity[b];
    const Eigen::Vector3d middle = 0.5 * (before.angular_velocity[b] + omega);
    const Eigen::Matrix3d turned = after.inertia(i) - before.inertia(i);
    ledger.gyro_J += 0.5 * omega.dot(turned * omega) - h * gyroscopic(before, i).dot(middle);
  }
}

}  // namespace conebench::dem
