#pragma once

#include <Eigen/Core>

namespace conebench::dem {

/// Where d lies of the plane through a, b and c: > 0 on the side from which they turn
/// anticlockwise, 0 in the plane, < 0 behind. Exact for numbers that are zero or between 1e-60 and
/// 1e60 in size: rounded arithmetic with a bound of its error, then sums without rounding where
/// that leaves the sign open.
///
/// Source  Shewchuk, Discrete Comput. Geom. 18, 1997: Theorem 10 (sums) and the bound of ORIENT3D's
///         first stage (numbers as in the paper's section 4.3; not checked). Differs: no stages
///         between the first and the exact one.
int orientation(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                const Eigen::Vector3d& d);

}  // namespace conebench::dem
