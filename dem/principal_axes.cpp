#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "dem/shape.h"

namespace conebench::dem {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Of the largest moment: nearer ones are taken as equal.
constexpr double kEqualMoments = 1e-9;
// Of two frames that are as near to identity as each other, but for rounding, the first is taken.
constexpr double kNearer = 1e-9;

// The frame nearest to identity one axis of which is +-`single`: the shortest turn of the
// coordinate axis that is nearest to it.
Matrix3d turned_to(const Vector3d& single) {
  int nearest = 0;
  for (int i = 1; i < 3; ++i) {
    if (std::abs(single(i)) > std::abs(single(nearest)) + kNearer) nearest = i;
  }
  const Vector3d axis = single(nearest) < 0.0 ? Vector3d(-single) : single;
  return Eigen::Quaterniond::FromTwoVectors(Vector3d::Unit(nearest), axis).toRotationMatrix();
}

// Of the 24 right-handed frames of the columns of `axes` and their negatives the one nearest to
// identity: the one of the largest trace.
Matrix3d reordered(const Matrix3d& axes) {
  Matrix3d nearest = Matrix3d::Identity();
  double largest = -3.0;
  std::array<int, 3> order = {0, 1, 2};
  do {
    for (const double first : {1.0, -1.0}) {
      for (const double second : {1.0, -1.0}) {
        Matrix3d frame;
        frame.col(0) = first * axes.col(order[0]);
        frame.col(1) = second * axes.col(order[1]);
        frame.col(2) = frame.col(0).cross(frame.col(1));
        if (frame.trace() <= largest + kNearer) continue;
        largest = frame.trace();
        nearest = frame;
      }
    }
  } while (std::next_permutation(order.begin(), order.end()));
  return nearest;
}

}  // namespace

PrincipalAxes principal_axes(const Matrix3d& inertia) {
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(inertia);
  const Vector3d& moments = solver.eigenvalues();  // rising
  const Matrix3d& vectors = solver.eigenvectors();
  const double low_gap = moments(1) - moments(0), high_gap = moments(2) - moments(1);
  const double equal = kEqualMoments * moments.cwiseAbs().maxCoeff();

  PrincipalAxes principal;
  if (low_gap + high_gap > equal) {
    principal.axes = low_gap <= equal && low_gap <= high_gap ? turned_to(vectors.col(2))
                     : high_gap <= equal                     ? turned_to(vectors.col(0))
                                                             : reordered(vectors);
  }
  principal.moments = (principal.axes.transpose() * inertia * principal.axes).diagonal();
  return principal;
}

}  // namespace conebench::dem
