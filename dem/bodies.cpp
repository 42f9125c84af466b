#include "dem/bodies.h"

namespace conebench::dem {

Eigen::Matrix3d Bodies::inertia(int i) const {
  const auto b = static_cast<std::size_t>(i);
  if (is_ball(i)) return moments[b].asDiagonal();
  const Eigen::Matrix3d R = orientation[b].toRotationMatrix();
  const Eigen::Matrix3d J = R * moments[b].asDiagonal() * R.transpose();
  return 0.5 * (J + J.transpose());
}

Eigen::Vector3d spin(const Bodies& bodies, int i) {
  const auto b = static_cast<std::size_t>(i);
  if (bodies.is_ball(i)) return bodies.moments[b].cwiseProduct(bodies.angular_velocity[b]);
  const Eigen::Quaterniond& q = bodies.orientation[b];
  const Eigen::Vector3d own = q.conjugate() * bodies.angular_velocity[b];
  return q * Eigen::Vector3d(bodies.moments[b].cwiseProduct(own));
}

Eigen::Vector3d gyroscopic(const Bodies& bodies, int i) {
  if (bodies.is_ball(i)) return Eigen::Vector3d::Zero();
  return bodies.angular_velocity[static_cast<std::size_t>(i)].cross(spin(bodies, i));
}

}  // namespace conebench::dem
