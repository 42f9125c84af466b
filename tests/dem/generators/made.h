#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "dem/neighbours.h"
#include "dem/placement.h"

namespace conebench::test {

/// Of the only material of made_head().
constexpr double kDensity = 2000.0;

/// The mass of a ball of it.
double ball_mass(double radius_m);

/// A scene up to where a generator's table may follow, with the material "stone", the motion
/// "turn" and the shapes "box" (0.02 x 0.03 x 0.04), "capsule" and "hammer" (two parts, which fill
/// the box from (-0.02, -0.01, 0) to (0.02, 0.01, 0.06)).
std::string made_head();

/// The line that ends a table.
inline const std::string kStone = "material = \"stone\"\n";

/// The scene in two dimensions.
std::string in_the_plane(const std::string& text);

/// What the parser complains of, or "no error".
std::string error_of(const std::string& text);

/// That the last material of the scene, misspelt, is refused with a suggestion.
void expect_material_is_checked(std::string text);

/// A scene at time 0. Expects that it prints and reads back the same, and that nothing overlaps but
/// by rounding.
struct Made {
  explicit Made(const std::string& text);

  std::vector<dem::Near> near_within(double reach_m) const;
  /// The pairs of bodies that touch, and how many of them are of one body.
  std::set<std::pair<int, int>> touching() const;
  std::size_t touching(int body) const;
  double mass_kg() const;
  /// The box about all that can move.
  Eigen::AlignedBox3d bounds() const;

  /// [m] Sizes in these tests are 5 mm and more: a share of 1e-9 of them.
  static constexpr double kRounding = 5e-12;

  dem::Scene scene;
  dem::Placement placement;
  const dem::Bodies& bodies;
};

/// That the box about all that can move is this one.
void expect_box(const Made& made, const Eigen::Vector3d& low, const Eigen::Vector3d& high);

/// That the scene is the same each time, and another one with another seed, or the same.
void expect_same_places(const std::string& text, bool depends_on_seed);

}  // namespace conebench::test
