#include "solvers/local/quartic_roots.h"

#include <algorithm>
#include <cmath>
#include <complex>

namespace conebench::solvers {
namespace {

using Complex = std::complex<double>;

constexpr double kNearlyReal = 1e-4;

// The largest real root of y^3 + b y^2 + c y + d, polished.
double largest_cubic_root(double b, double c, double d) {
  const double shift = b / 3.0;
  const double p = c - b * shift, q = d - c * shift + 2.0 * shift * shift * shift;
  const double half_q = 0.5 * q, third_p = p / 3.0;
  const double discriminant = half_q * half_q + third_p * third_p * third_p;
  double x;
  if (discriminant >= 0.0) {
    const double root = std::sqrt(discriminant);
    const double u = std::cbrt(half_q > 0.0 ? -half_q - root : -half_q + root);
    x = u - (u != 0.0 ? third_p / u : 0.0);
  } else {
    const double radius = std::sqrt(-third_p);
    const double angle = std::acos(std::clamp(-half_q / (radius * radius * radius), -1.0, 1.0));
    x = 2.0 * radius * std::cos(angle / 3.0);
  }
  double y = x - shift;
  for (int step = 0; step < 3; ++step) {
    const double slope = (3.0 * y + 2.0 * b) * y + c;
    const double move = slope != 0.0 ? (((y + b) * y + c) * y + d) / slope : 0.0;
    if (!std::isfinite(move)) break;
    y -= move;
  }
  return y;
}

}  // namespace

// x = y - c3/4 gives y^4 + p y^2 + q y + r; with m > 0 a root of the resolvent
// m^3 + 2 p m^2 + (p^2 - 4 r) m - q^2, it is (y^2 + s y + A)(y^2 - s y + B), s = sqrt(m).
int nearly_real_quartic_roots(double c3, double c2, double c1, double c0, double roots[4]) {
  const double h = 0.25 * c3;
  const double p = c2 - 6.0 * h * h;
  const double q = c1 - 2.0 * c2 * h + 8.0 * h * h * h;
  const double r = c0 - c1 * h + c2 * h * h - 3.0 * h * h * h * h;
  const double m = std::max(0.0, largest_cubic_root(2.0 * p, p * p - 4.0 * r, -q * q));
  const double s = std::sqrt(m);
  Complex A, B;
  if (s > 0.0) {
    A = 0.5 * (p + m - q / s);
    B = 0.5 * (p + m + q / s);
  } else {  // biquadratic
    const Complex split = std::sqrt(Complex(0.25 * p * p - r));
    A = 0.5 * p + split;
    B = 0.5 * p - split;
  }
  const Complex left = std::sqrt(0.25 * m - A), right = std::sqrt(0.25 * m - B);
  const Complex all[4] = {-0.5 * s + left - h, -0.5 * s - left - h, 0.5 * s + right - h,
                          0.5 * s - right - h};
  int count = 0;
  for (const Complex& root : all) {
    if (std::abs(root.imag()) <= kNearlyReal * std::abs(root)) roots[count++] = root.real();
  }
  return count;
}

}  // namespace conebench::solvers
