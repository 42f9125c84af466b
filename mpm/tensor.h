#pragma once

#include <Eigen/Core>
#include <cmath>

namespace conebench::mpm {

template <int D>
using Vec = Eigen::Matrix<double, D, 1>;

/// Independent entries of a symmetric tensor: 3 in two dimensions, 6 in three.
template <int D>
inline constexpr int kEntries = D*(D + 1) / 2;

/// Coordinates of a symmetric tensor a in which a : b = 2 abar . bbar, the trace first:
///
///   2D  ((a11 + a22)/2, (a11 - a22)/2, a12)
///   3D  (tr a / sqrt 6, (a11 - a22)/2, (2 a33 - a11 - a22)/(2 sqrt 3), a12, a13, a23)
///
/// so that the pressure is p = sqrt(2/d) abar_0 and |Dev a|_F = sqrt 2 |abar_t|.
template <int D>
using Sym = Eigen::Matrix<double, kEntries<D>, 1>;

/// Row of the strain operator for one velocity node with shape gradient g: 2 Dbar(v) = sum of
/// strain_block(g_k) v_k.
template <int D>
Eigen::Matrix<double, kEntries<D>, D> strain_block(const Vec<D>& g) {
  Eigen::Matrix<double, kEntries<D>, D> b;
  if constexpr (D == 2) {
    b << g[0], g[1], g[0], -g[1], g[1], g[0];
  } else {
    const double third = std::sqrt(2.0 / 3.0), root = 1.0 / std::sqrt(3.0);
    b << third * g[0], third * g[1], third * g[2],      //
        g[0], -g[1], 0.0,                               //
        -root * g[0], -root * g[1], 2.0 * root * g[2],  //
        g[1], g[0], 0.0, g[2], 0.0, g[0], 0.0, g[2], g[1];
  }
  return b;
}

/// The coordinates of a symmetric tensor, and back.
template <int D>
Sym<D> to_sym(const Eigen::Matrix<double, D, D>& a) {
  Sym<D> s;
  if constexpr (D == 2) {
    s << 0.5 * (a(0, 0) + a(1, 1)), 0.5 * (a(0, 0) - a(1, 1)), a(0, 1);
  } else {
    s << a.trace() / std::sqrt(6.0), 0.5 * (a(0, 0) - a(1, 1)),
        (2.0 * a(2, 2) - a(0, 0) - a(1, 1)) / (2.0 * std::sqrt(3.0)), a(0, 1), a(0, 2), a(1, 2);
  }
  return s;
}

template <int D>
Eigen::Matrix<double, D, D> to_tensor(const Sym<D>& s) {
  Eigen::Matrix<double, D, D> a;
  if constexpr (D == 2) {
    a << s[0] + s[1], s[2], s[2], s[0] - s[1];
  } else {
    const double mean = s[0] * std::sqrt(6.0) / 3.0, last = s[2] / std::sqrt(3.0);
    a << mean + s[1] - last, s[3], s[4], s[3], mean - s[1] - last, s[5], s[4], s[5],
        mean + 2.0 * last;
  }
  return a;
}

/// Drucker-Prager sqrt(J2) <= mu p + c in these coordinates is the cone K of coefficient
/// mu sqrt(2/d), its tip at -(c/mu) sqrt(d/2).
inline double cone_friction(int dim, double mu) { return mu * std::sqrt(2.0 / dim); }
inline double cone_tip(int dim, double mu, double cohesion) {
  return cohesion == 0.0 ? 0.0 : cohesion / mu * std::sqrt(dim / 2.0);
}
/// Pressure of the coordinates of a stress.
inline double pressure(int dim, double first) { return std::sqrt(2.0 / dim) * first; }

}  // namespace conebench::mpm
