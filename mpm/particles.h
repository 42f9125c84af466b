#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace conebench::mpm {

/// The material points, one entry a particle in every array. In two dimensions third components
/// are 0 and volumes are per metre of thickness.
struct Particles {
  using Stress = Eigen::Matrix<double, 6, 1>;

  std::vector<Eigen::Vector3d> position;  ///< [m]
  std::vector<Eigen::Vector3d> velocity;  ///< [m/s]
  std::vector<Eigen::Matrix3d> affine;    ///< C_p, row a: gradient of velocity a [1/s]
  std::vector<double> volume;             ///< of solid, V_p [m3]
  std::vector<double> cohesion;           ///< shear strength at zero pressure [Pa]
  std::vector<double> inertial_number;    ///< I [-], of the last step
  std::vector<Stress> stress;             ///< compression > 0, tensor.h's coordinates [Pa]

  std::size_t count() const { return position.size(); }

  void add(const Eigen::Vector3d& x, const Eigen::Vector3d& v, double solid_volume, double c) {
    position.push_back(x);
    velocity.push_back(v);
    affine.push_back(Eigen::Matrix3d::Zero());
    volume.push_back(solid_volume);
    cohesion.push_back(c);
    inertial_number.push_back(0.0);
    stress.push_back(Stress::Zero());
  }

  /// Removes every particle for which `gone(index)` holds; the others keep their order.
  template <class Predicate>
  void remove_if(const Predicate& gone) {
    std::size_t kept = 0;
    for (std::size_t p = 0; p < count(); ++p) {
      if (gone(p)) continue;
      position[kept] = position[p];
      velocity[kept] = velocity[p];
      affine[kept] = affine[p];
      volume[kept] = volume[p];
      cohesion[kept] = cohesion[p];
      inertial_number[kept] = inertial_number[p];
      stress[kept] = stress[p];
      ++kept;
    }
    position.resize(kept);
    velocity.resize(kept);
    affine.resize(kept);
    volume.resize(kept);
    cohesion.resize(kept);
    inertial_number.resize(kept);
    stress.resize(kept);
  }
};

}  // namespace conebench::mpm
