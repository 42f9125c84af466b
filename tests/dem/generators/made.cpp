#include "tests/dem/generators/made.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/engine/scene_text.h"

namespace conebench::test {

double ball_mass(double radius_m) {
  return 4.0 / 3.0 * std::numbers::pi * radius_m * radius_m * radius_m * kDensity;
}

std::string made_head() {
  return R"(schema = 1
engine = "dem"
name = "made"
step_s = 1e-3
duration_s = 0.1
skin_m = 1e-3

[default_pair]
friction = 0.5

[[materials]]
name = "stone"
density_kg_m3 = 2000

[[motions]]
name = "turn"
kind = "turn"
rate_rad_s = 1

[[shapes]]
name = "box"
kind = "box"
size_m = [0.02, 0.03, 0.04]

[[shapes]]
name = "capsule"
kind = "capsule"
radius_m = 0.01
length_m = 0.03

[[shapes]]
name = "hammer"
[[shapes.parts]]
kind = "box"
size_m = [0.04, 0.02, 0.02]
position_m = [0, 0, 0.05]
[[shapes.parts]]
kind = "cylinder"
radius_m = 0.005
length_m = 0.04
position_m = [0, 0, 0.02]

)";
}

std::string in_the_plane(const std::string& text) {
  return changed(text, "skin_m", "dimension = 2\nskin_m");
}

std::string error_of(const std::string& text) {
  return input_error("made.toml", [&] { dem::parse_scene(text, "made.toml"); });
}

void expect_material_is_checked(std::string text) {
  text.replace(text.rfind("stone"), 5, "stne");
  const std::string error = error_of(text);
  EXPECT_NE(error.find("no material \"stne\" (did you mean 'stone'?)"), std::string::npos) << error;
}

Made::Made(const std::string& text)
    : scene(dem::parse_scene(text, "made.toml")),
      placement(dem::place_bodies(scene, "made.toml")),
      bodies(placement.bodies) {
  const std::string printed = dem::to_toml(scene);
  EXPECT_EQ(dem::to_toml(dem::parse_scene(printed, "printed")), printed);
  for (const dem::Near& near : near_within(0.0)) EXPECT_GT(near.touch.gap, -kRounding);
}

std::vector<dem::Near> Made::near_within(double reach_m) const {
  std::vector<dem::Near> found;
  dem::Neighbours(placement, scene.dimension).find(bodies, reach_m, 0.0, found);
  return found;
}

std::set<std::pair<int, int>> Made::touching() const {
  std::set<std::pair<int, int>> pairs;
  for (const dem::Near& near : near_within(kRounding)) pairs.emplace(near.body, near.other);
  return pairs;
}

std::size_t Made::touching(int body) const {
  std::size_t count = 0;
  for (const auto& [a, b] : touching()) count += a == body || b == body ? 1 : 0;
  return count;
}

double Made::mass_kg() const {
  double sum = 0.0;
  for (const double mass : bodies.mass) sum += mass;
  return sum;
}

Eigen::AlignedBox3d Made::bounds() const {
  Eigen::AlignedBox3d box;
  const auto add = [&](const dem::Piece& piece, const dem::Pose& pose) {
    const dem::Bounds bounds = dem::bounds_of(piece, pose);
    box.extend(bounds.low);
    box.extend(bounds.high);
  };
  for (int i = 0; i < bodies.count(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (!bodies.is_free(i)) continue;
    if (bodies.is_ball(i)) {
      add(dem::Ball{bodies.radius[k]}, bodies.pose(i));
      continue;
    }
    for (const dem::Part& part :
         placement.solids[static_cast<std::size_t>(bodies.solid[k])].parts) {
      add(part.piece, bodies.pose(i) * part.pose);
    }
  }
  return box;
}

// Sizes here are a few metres at most.
void expect_box(const Made& made, const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  const Eigen::AlignedBox3d box = made.bounds();
  EXPECT_LT((box.min() - low).norm(), 1e-14) << box.min().transpose();
  EXPECT_LT((box.max() - high).norm(), 1e-14) << box.max().transpose();
}

void expect_same_places(const std::string& text, bool depends_on_seed) {
  const Made first(text), again(text);
  const Made other(changed(text, "skin_m", "seed = 2\nskin_m"));
  const auto turns = [](const Made& made) {
    std::vector<Eigen::Vector4d> out;
    for (const Eigen::Quaterniond& q : made.bodies.orientation) out.push_back(q.coeffs());
    return out;
  };
  const auto same = [&](const Made& a, const Made& b) {
    return a.bodies.position == b.bodies.position && a.bodies.radius == b.bodies.radius &&
           a.bodies.solid == b.bodies.solid && turns(a) == turns(b);
  };
  EXPECT_TRUE(same(first, again));
  EXPECT_NE(same(first, other), depends_on_seed);
}

}  // namespace conebench::test
