#include "dem/orientation.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <vector>

namespace conebench::dem {
namespace {

using Eigen::Vector3d;

int sign(double x) { return (x > 0.0) - (x < 0.0); }

// A sum held as parts that do not overlap, the largest last: nothing is rounded away. Compiled
// without contraction to fused products, which would change what is left over.
class ExactSum {
 public:
  void add(double term) {
    std::size_t kept = 0;
    for (const double part : parts_) {
      const double sum = term + part;
      const double of_part = sum - term;
      const double left_over = (term - (sum - of_part)) + (part - of_part);
      if (left_over != 0.0) parts_[kept++] = left_over;
      term = sum;
    }
    parts_.resize(kept);
    if (term != 0.0) parts_.push_back(term);
  }

  void add_product(double x, double y, double z) {
    const double high = x * y;
    for (const double factor : {high, std::fma(x, y, -high)}) {
      const double product = factor * z;
      add(product);
      add(std::fma(factor, z, -product));
    }
  }

  // sign * x . (y x z)
  void add_triple(double sign, const Vector3d& x, const Vector3d& y, const Vector3d& z) {
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      add_product(sign * x(i), y(j), z(k));
      add_product(-sign * x(i), y(k), z(j));
    }
  }

  int sign_of() const { return parts_.empty() ? 0 : sign(parts_.back()); }

 private:
  std::vector<double> parts_;
};

}  // namespace

int orientation(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
  constexpr double kUnit = std::numeric_limits<double>::epsilon() / 2.0;
  constexpr double kErrorShare = (7.0 + 56.0 * kUnit) * kUnit;

  const Vector3d x = a - d, y = b - d, z = c - d;
  double volume = 0.0, size = 0.0;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const double forth = x(j) * y(k), back = x(k) * y(j);
    volume += z(i) * (forth - back);
    size += std::abs(z(i)) * (std::abs(forth) + std::abs(back));
  }
  if (std::abs(volume) > kErrorShare * size) return -sign(volume);

  // (b - a) . ((c - a) x (d - a)), multiplied out.
  ExactSum sum;
  sum.add_triple(1.0, b, c, d);
  sum.add_triple(-1.0, a, c, d);
  sum.add_triple(1.0, a, b, d);
  sum.add_triple(-1.0, a, b, c);
  return sum.sign_of();
}

}  // namespace conebench::dem
