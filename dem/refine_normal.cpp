#include "dem/refine_normal.h"

#include <Eigen/Dense>

#include <cmath>
#include <optional>
#include <vector>

namespace conebench::dem {
namespace {

using Eigen::Vector3d;

constexpr double kNearlySquare = 1e-3;
constexpr double kBetter = 1e-14;
constexpr double kRounding = 1e-15;
constexpr double kQuadratic = 1e-4;  // steps below it need no check
constexpr double kExact = 1e-15;
constexpr double kSmallest = 1e-12;  // sine of an angle to a disc's axis, or between two sides
constexpr int kMaxSteps = 20;
constexpr int kMaxRounds = 10;

// At most two sides, as columns; the first `own` belong to the first piece.
using Sides = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, 2>;
using Tangents = Sides;
using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 2, 2>;

// What of a core is nearly at its support.
struct Top {
  std::vector<Vector3d> corners;
  std::vector<Vector3d> sides;  // unit length
};

Top top_of(const Placed& placed, const Vector3d& outward) {
  const auto& points = placed.points;
  const auto at = [](int k) { return static_cast<std::size_t>(k); };
  const double least = outward.dot(points[at(placed.farthest(outward))]) - kNearlySquare;
  Top top;
  for (const Vector3d& point : points) {
    if (outward.dot(point) >= least) top.corners.push_back(point);
  }
  for (const Convex::Edge& edge : placed.convex->edges) {
    if (outward.dot(points[at(edge.from)]) < least && outward.dot(points[at(edge.to)]) < least) {
      continue;
    }
    top.sides.push_back(placed.along(edge).normalized());
  }
  return top;
}

// An orthonormal basis of what is square to the sides and to the normal.
Tangents tangents(const Vector3d& normal, const Sides& sides) {
  Tangents basis(3, 2 - sides.cols());
  if (sides.cols() == 0) {
    basis.col(0) = normal.unitOrthogonal();
    basis.col(1) = normal.cross(basis.col(0));
  } else if (sides.cols() == 1) {
    basis.col(0) = normal.cross(sides.col(0)).normalized();
  }
  return basis;
}

// The nearest unit vector that is square to the sides.
std::optional<Vector3d> square_to(const Sides& sides, const Vector3d& normal) {
  Vector3d square = normal;
  if (sides.cols() == 1) square -= sides.col(0) * sides.col(0).dot(normal);
  if (sides.cols() == 2) {
    square = sides.col(0).cross(sides.col(1));
    if (square.dot(normal) < 0.0) square = -square;
  }
  if (square.norm() < kSmallest) return std::nullopt;
  return square.normalized();
}

// Less the second derivative of the reach of a disc along n: (R / sine) t t^T, t along the rim.
bool add_curvature(const Placed& placed, const Vector3d& normal, Eigen::Matrix3d& curvature) {
  if (placed.disc == 0.0) return true;
  const Vector3d along_rim = placed.axis().cross(normal);
  const double sine = along_rim.norm();
  if (sine < kSmallest) return false;
  curvature -= along_rim * along_rim.transpose() * (placed.disc / (sine * sine * sine));
  return true;
}

// The support of the second to that of the first, for fixed points and the discs about them.
Vector3d apart_along(const Placed& first, const Placed& second, const Vector3d& base,
                     const Vector3d& normal) {
  return base + first.to_rim(-normal) - second.to_rim(normal);
}

// The step of Newton's method towards where apart_along() is along the normal, but for its part
// along the sides.
std::optional<Vector3d> newton_step(const Placed& first, const Placed& second,
                                    const Vector3d& apart, const Sides& sides,
                                    const Vector3d& normal) {
  Eigen::Matrix3d curvature = -normal.dot(apart) * Eigen::Matrix3d::Identity();
  if (!add_curvature(first, normal, curvature) || !add_curvature(second, normal, curvature)) {
    return std::nullopt;
  }
  const Tangents basis = tangents(normal, sides);
  const Square matrix = basis.transpose() * curvature * basis;
  const Vector3d step = -basis * matrix.fullPivLu().solve(basis.transpose() * apart);
  return step.allFinite() ? std::optional(step) : std::nullopt;
}

// Where the supports are right above each other, as near as steps uphill lead.
std::optional<Vector3d> stationary(const Placed& first, const Placed& second, const Vector3d& base,
                                   const Sides& sides, Vector3d normal) {
  if (sides.cols() == 2) return normal;
  for (int count = 0; count < kMaxSteps; ++count) {
    const Vector3d apart = apart_along(first, second, base, normal);
    const auto step = newton_step(first, second, apart, sides, normal);
    if (!step) return std::nullopt;
    double part = 1.0;
    Vector3d next;
    do {
      next = (normal + part * *step).normalized();
      part *= 0.5;
    } while (step->norm() > kQuadratic && part > kSmallest &&
             next.dot(apart_along(first, second, base, next)) <
                 normal.dot(apart) - kRounding * apart.norm());
    if (part <= kSmallest) return normal;
    normal = next;
    if (step->norm() < kRounding) break;
  }
  return normal;
}

// A guess of what is square to the normal; the first `of_first` columns are sides of the first.
struct Guess {
  Sides sides;
  Eigen::Index of_first = 0;
};

std::vector<Guess> guesses(const Top& first, const Top& second) {
  std::vector<Vector3d> all = first.sides;
  all.insert(all.end(), second.sides.begin(), second.sides.end());
  const std::size_t own = first.sides.size();
  std::vector<Guess> guesses = {{Sides(3, 0), 0}};
  for (std::size_t i = 0; i < all.size(); ++i) {
    guesses.push_back({all[i], i < own ? 1 : 0});
    for (std::size_t j = i + 1; j < all.size(); ++j) {
      Sides two(3, 2);
      two << all[i], all[j];
      guesses.push_back({two, (i < own ? 1 : 0) + (j < own ? 1 : 0)});
    }
  }
  return guesses;
}

// Moves the points along the sides until one is right above the other.
void meet(const Guess& guess, ClosestPoints& closest) {
  if (guess.sides.cols() == 0) return;
  const Vector3d miss = closest.distance * closest.normal - (closest.on_first - closest.on_second);
  const Eigen::VectorXd way = guess.sides.colPivHouseholderQr().solve(miss);
  for (Eigen::Index k = 0; k < guess.sides.cols(); ++k) {
    if (k < guess.of_first) closest.on_first += way(k) * guess.sides.col(k);
    if (k >= guess.of_first) closest.on_second -= way(k) * guess.sides.col(k);
  }
}

// How far the points are from right above each other.
double miss_of(const ClosestPoints& closest) {
  return (closest.on_first - closest.on_second - closest.distance * closest.normal).norm();
}

bool better(const ClosestPoints& one, const ClosestPoints& other) {
  if (one.distance > other.distance + kBetter) return true;
  return one.distance >= other.distance - kBetter && miss_of(one) < miss_of(other);
}

// The stationary point of a guess, with its closest points.
std::optional<ClosestPoints> follow(const Placed& first, const Placed& second, const Guess& guess,
                                    const Vector3d& a, const Vector3d& b, const Vector3d& start) {
  const auto square = square_to(guess.sides, start);
  if (!square) return std::nullopt;
  const auto normal = stationary(first, second, a - b, guess.sides, *square);
  if (!normal) return std::nullopt;
  ClosestPoints closest{*normal, separation(first, second, *normal), a + first.to_rim(-*normal),
                        b + second.to_rim(*normal)};
  meet(guess, closest);
  return closest;
}

// Straight uphill, as far as is best; for starts from which no guess leads on.
bool walk(const Placed& first, const Placed& second, ClosestPoints& closest) {
  const Vector3d a = first.support(-closest.normal), b = second.support(closest.normal);
  const Vector3d uphill = (a - b) - closest.distance * closest.normal;
  ClosestPoints best = closest;
  for (double angle = 1.0; angle > kNearlySquare * kNearlySquare; angle *= 0.5) {
    const Vector3d normal = (closest.normal + angle * uphill.stableNormalized()).normalized();
    const double here = separation(first, second, normal);
    if (here > best.distance + kBetter) best = {normal, here, a, b};
  }
  if (best.normal == closest.normal) return false;
  closest = best;
  return true;
}

}  // namespace

void refine_normal(const Placed& first, const Placed& second, ClosestPoints& closest) {
  closest.distance = separation(first, second, closest.normal);
  for (int round = 0; round < kMaxRounds && miss_of(closest) > kExact; ++round) {
    const Vector3d start = closest.normal;
    const Top top_a = top_of(first, -start), top_b = top_of(second, start);
    for (const Guess& guess : guesses(top_a, top_b)) {
      for (const Vector3d& a : top_a.corners) {
        for (const Vector3d& b : top_b.corners) {
          const auto found = follow(first, second, guess, a, b, start);
          if (found && better(*found, closest)) closest = *found;
        }
      }
    }
    if (closest.normal == start && !walk(first, second, closest)) return;
  }
}

}  // namespace conebench::dem
