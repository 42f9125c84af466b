#include "dem/energy.h"

#include <algorithm>
#include <cmath>

namespace conebench::dem {

double EnergyLedger::closure_J() const {
  return kinetic_J + potential_J - initial_J - (bond_J + friction_J + impact_J + scheme_J);
}

double EnergyLedger::relative_closure() const {
  const double largest =
      std::max({std::abs(kinetic_J), std::abs(potential_J), std::abs(initial_J), std::abs(bond_J),
                std::abs(friction_J), std::abs(impact_J), std::abs(scheme_J)});
  return largest > 0.0 ? std::abs(closure_J()) / largest : 0.0;
}

double kinetic_energy(const Spheres& spheres) {
  double sum = 0.0;
  for (std::size_t i = 0; i < spheres.mass.size(); ++i) {
    sum += 0.5 * spheres.mass[i] * spheres.velocity[i].squaredNorm() +
           0.5 * spheres.inertia[i] * spheres.angular_velocity[i].squaredNorm();
  }
  return sum;
}

double potential_energy(const Scene& scene, const Spheres& spheres) {
  double sum = 0.0;
  for (std::size_t i = 0; i < spheres.mass.size(); ++i) {
    if (spheres.first_dof[i] < 0) continue;
    sum -= spheres.mass[i] * scene.gravity_m_s2.dot(spheres.position[i]);
  }
  return sum;
}

void book_work(const Eigen::Vector3d& r, double kappa, const Eigen::Vector3d& u_before,
               const Eigen::Vector3d& u_after, EnergyLedger& ledger) {
  const Eigen::Vector3d u = 0.5 * (u_before + u_after);
  ledger.bond_J -= kappa * u[0];
  ledger.impact_J += (r[0] + kappa) * u[0];
  ledger.friction_J += r.tail<2>().dot(u.tail<2>());
}

}  // namespace conebench::dem
