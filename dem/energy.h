#pragma once

#include "dem/contacts.h"
#include "dem/scene.h"

namespace conebench::dem {

/// Where the energy went since the start [J]. Exact for the scheme, not only for small steps:
///
///   kinetic + potential - initial = bond + friction + impact + driven + gyro + scheme
///
/// up to rounding, with the work of the reactions taken at (v_minus + v) / 2, and the scheme's own
/// parts: -1/2 h f_ext . (v - v_minus), which positions moved with the new velocity bring in, and
/// that of the turning inertia and its gyroscopic torque, zero for balls.
struct EnergyLedger {
  double kinetic_J = 0.0;
  double potential_J = 0.0;
  double initial_J = 0.0;   ///< kinetic + potential at the start
  double bond_J = 0.0;      ///< work of the tensile strength, -kappa u_n
  double friction_J = 0.0;  ///< work of the tangential reactions
  double impact_J = 0.0;    ///< work of the normal reactions above the strength, r'_n u_n
  double driven_J = 0.0;    ///< work of driven bodies and planes on the others
  double gyro_J = 0.0;      ///< of the gyroscopic torque and the inertia's turning with its body
  double scheme_J = 0.0;

  /// What the ledger fails to explain [J].
  double closure_J() const;
  /// The same over the largest entry [-].
  double relative_closure() const;
};

/// Of the free bodies; the potential is zero at the origin of the scene.
double kinetic_energy(const Bodies& bodies);
double potential_energy(const Scene& scene, const Bodies& bodies);

/// Books the work of one contact's reaction `r` (local frame, unshifted, [N s]) while the relative
/// velocity goes from `u_before` to `u_after`, of which `driven` is not the free bodies' (all in
/// the local frame).
void book_work(const Eigen::Vector3d& r, double kappa, const Eigen::Vector3d& u_before,
               const Eigen::Vector3d& u_after, const Eigen::Vector3d& driven, EnergyLedger& ledger);

/// Books what the step's own arithmetic brings in, for bodies that went from `before` to `after`.
void book_scheme(const Scene& scene, const Bodies& before, const Bodies& after,
                 EnergyLedger& ledger);

}  // namespace conebench::dem
