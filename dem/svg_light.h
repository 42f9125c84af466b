#pragma once

#include <Eigen/Core>

namespace conebench::dem {

/// Where the light of a picture comes from: unit vector; right, up, towards the eye.
inline Eigen::Vector3d to_light() { return Eigen::Vector3d(-0.40, 0.80, 0.45).normalized(); }

}  // namespace conebench::dem
