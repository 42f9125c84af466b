#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "dem/shape.h"

namespace conebench::dem {

/// The state of all bodies and walls, one entry each in every array: the bodies, then the planes.
/// World frame throughout. The frame of a body has its centre of mass as origin and its principal
/// axes; that of a plane any point of it as origin and its normal along z.
struct Bodies {
  static constexpr int kBall = -1, kPlane = -2;

  std::vector<Eigen::Vector3d> position;          ///< of the centre [m]
  std::vector<Eigen::Vector3d> velocity;          ///< [m/s]
  std::vector<Eigen::Vector3d> angular_velocity;  ///< [rad/s]
  std::vector<Eigen::Quaterniond> orientation;    ///< body frame to world frame
  std::vector<double> radius;                     ///< of a ball; -1 of anything else [m]
  std::vector<double> mass;                       ///< [kg]; 0 where nothing moves freely
  std::vector<Eigen::Vector3d> moments;           ///< of inertia about the body's axes [kg m2]
  std::vector<int> material;                      ///< index in Scene::materials
  std::vector<int> solid;      ///< index in Placement::solids, or kBall, or kPlane
  std::vector<int> first_dof;  ///< -1: moves as it is told, or not at all
  int dofs = 0;
  int planes = 0;

  int count() const { return static_cast<int>(position.size()) - planes; }
  bool is_free(int i) const { return first_dof[static_cast<std::size_t>(i)] >= 0; }
  bool is_ball(int i) const { return solid[static_cast<std::size_t>(i)] == kBall; }
  bool is_plane(int i) const { return i >= count(); }
  Pose pose(int i) const {
    return {position[static_cast<std::size_t>(i)], orientation[static_cast<std::size_t>(i)]};
  }
  Eigen::Vector3d plane_normal(int i) const {
    return orientation[static_cast<std::size_t>(i)] * Eigen::Vector3d::UnitZ();
  }
  /// R diag(moments) R^T [kg m2].
  Eigen::Matrix3d inertia(int i) const;
};

/// J omega [N m s], and omega x J omega [N m]: zero for a ball.
Eigen::Vector3d spin(const Bodies& bodies, int i);
Eigen::Vector3d gyroscopic(const Bodies& bodies, int i);

}  // namespace conebench::dem
