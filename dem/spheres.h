#pragma once

#include <Eigen/Geometry>
#include <vector>

namespace conebench::dem {

/// The state of all bodies, one entry a sphere in every array. World frame throughout.
struct Spheres {
  std::vector<Eigen::Vector3d> position;          ///< of the centre [m]
  std::vector<Eigen::Vector3d> velocity;          ///< [m/s]
  std::vector<Eigen::Vector3d> angular_velocity;  ///< [rad/s]
  std::vector<Eigen::Quaterniond> orientation;    ///< body frame to world frame
  std::vector<double> radius;                     ///< [m]
  std::vector<double> mass;                       ///< [kg]
  std::vector<double> inertia;                    ///< 2/5 m R^2, about any axis [kg m2]
  std::vector<int> material;                      ///< index in Scene::materials
  std::vector<int> first_dof;                     ///< of six: v, then omega; -1: held in place
  int dofs = 0;

  int count() const { return static_cast<int>(position.size()); }
};

}  // namespace conebench::dem
