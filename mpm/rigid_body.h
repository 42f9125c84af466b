#pragma once

#include <Eigen/Geometry>

#include "mpm/scene.h"

namespace conebench::mpm {

/// State of a rigid body: what moves, and what it weighs.
struct RigidBody {
  Body body;  ///< as the scene says
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();          ///< [m/s]
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();  ///< world frame [rad/s]
  double mass = 0.0;                                           ///< [kg, per metre in 2D]
  Eigen::Vector3d inertia = Eigen::Vector3d::Zero();           ///< principal, body frame [kg m2]

  bool moves_freely() const { return body.motion == Motion::kFree; }
  Eigen::Vector3d velocity_at(const Eigen::Vector3d& x) const {
    return velocity + angular_velocity.cross(x - centre_m);
  }
  /// In the world frame; in two dimensions only the entry (2, 2) counts.
  Eigen::Matrix3d inertia_tensor() const {
    const Eigen::Matrix3d R = orientation.toRotationMatrix();
    return R * inertia.asDiagonal() * R.transpose();
  }
};

/// Distance to the body's surface [m], < 0 inside, and the unit normal out of the body there.
struct Distance {
  double value = 0.0;
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();
};
Distance distance_to(const RigidBody& body, int dim, const Eigen::Vector3d& x);

RigidBody make_body(const Body& body, int dim);

/// Where a ball or a box can touch a wall: its extreme point along -`normal`, or its corners.
std::vector<Eigen::Vector3d> surface_points(const RigidBody& body, int dim,
                                            const Eigen::Vector3d& normal);

/// Moves the body by h times its velocities.
void advance(RigidBody& body, double h);

}  // namespace conebench::mpm
