#include "dem/hierarchical_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "problems/error.h"

namespace conebench::test {
namespace {

using dem::BodyPair;
using dem::Bounds;
using dem::Candidates;
using dem::HierarchicalGrid;
using Eigen::Vector3d;

struct Things {
  std::vector<Vector3d> centres;
  std::vector<double> radii;
  std::vector<Bounds> boxes;

  void add_ball(const Vector3d& centre, double radius) {
    centres.push_back(centre);
    radii.push_back(radius);
  }
};

bool closer(const Bounds& a, const Bounds& b, double margin) {
  for (int k = 0; k < 3; ++k) {
    if (a.low[k] - b.high[k] >= margin || b.low[k] - a.high[k] >= margin) return false;
  }
  return true;
}

Candidates brute_force(const Things& things, double margin) {
  const auto& [centres, radii, boxes] = things;
  Candidates all;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    if (radii[i] < 0.0) continue;
    for (std::size_t j = i + 1; j < centres.size(); ++j) {
      const double reach = radii[i] + radii[j] + margin;
      if (radii[j] >= 0.0 && (centres[i] - centres[j]).squaredNorm() < reach * reach) {
        all.balls.push_back({static_cast<int>(i), static_cast<int>(j)});
      }
    }
    const Bounds around{centres[i].array() - radii[i], centres[i].array() + radii[i]};
    for (std::size_t j = 0; j < boxes.size(); ++j) {
      if (closer(around, boxes[j], margin)) {
        all.ball_box.push_back({static_cast<int>(i), static_cast<int>(j)});
      }
    }
  }
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (std::size_t j = i + 1; j < boxes.size(); ++j) {
      if (closer(boxes[i], boxes[j], margin)) {
        all.boxes.push_back({static_cast<int>(i), static_cast<int>(j)});
      }
    }
  }
  return all;
}

Candidates pairs_of(HierarchicalGrid& grid, const Things& things, double margin) {
  Candidates found;
  grid.find_pairs(things.centres, things.radii, things.boxes, margin, found);
  return found;
}

// Brute force gives each pair once and in increasing order, so equality is order and uniqueness
// too.
void expect_brute_force(HierarchicalGrid& grid, const Things& things, double margin,
                        const std::string& what) {
  const Candidates found = pairs_of(grid, things, margin);
  const Candidates expected = brute_force(things, margin);
  EXPECT_EQ(found.balls, expected.balls) << what;
  EXPECT_EQ(found.ball_box, expected.ball_box) << what;
  EXPECT_EQ(found.boxes, expected.boxes) << what;
}

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}

  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  // Over `decades` decades below 1.
  double size(double decades) { return std::pow(10.0, between(-decades, 0.0)); }
  int count(int most) { return static_cast<int>(engine_() % static_cast<unsigned>(most + 1)); }
  Vector3d place(double extent) {
    return {between(-extent, extent), between(-extent, extent), between(-extent, extent)};
  }
  Bounds box(const Vector3d& centre, const Vector3d& sides) {
    return {centre - 0.5 * sides, centre + 0.5 * sides};
  }
  // Small ones near each other and near the large ones, so that all sizes meet.
  Things mix(double decades, const Vector3d& origin) {
    Things things;
    std::vector<Vector3d> hubs{origin};
    for (int k = count(4); k >= 0; --k) hubs.push_back(origin + place(2.0));
    const auto near_hub = [&] {
      return Vector3d(hubs[static_cast<std::size_t>(count(static_cast<int>(hubs.size()) - 1))] +
                      place(2.0 * size(decades)));
    };
    for (int k = count(200); k > 0; --k) {
      const double radius = count(9) == 0 ? -1.0 : 0.3 * size(decades);
      things.add_ball(near_hub(), radius);
    }
    for (int k = count(100); k > 0; --k) {
      const Vector3d sides(size(decades), size(decades), size(decades));
      things.boxes.push_back(box(near_hub(), sides));
    }
    return things;
  }

 private:
  std::mt19937 engine_;
};

TEST(HierarchicalGrid, FindsWhatBruteForceFindsInMixesOfSizes) {
  HierarchicalGrid grid;  // one for all: what a call leaves behind does not matter to the next
  std::size_t balls = 0, ball_box = 0, boxes = 0;
  for (unsigned seed = 0; seed < 400; ++seed) {
    Random random(seed);
    const double decades = 0.2 + 0.1 * (seed % 40);
    const Things things = random.mix(decades, Vector3d::Zero());
    const double margin = seed % 3 == 0 ? 0.0 : 0.1 * random.size(decades);
    expect_brute_force(grid, things, margin, "seed " + std::to_string(seed));
    const Candidates found = pairs_of(grid, things, margin);
    balls += found.balls.size();
    ball_box += found.ball_box.size();
    boxes += found.boxes.size();
  }
  // The mixes are not all empty space.
  EXPECT_GT(balls, 20'000u);
  EXPECT_GT(ball_box, 20'000u);
  EXPECT_GT(boxes, 20'000u);
}

TEST(HierarchicalGrid, WorksFarFromTheOrigin) {
  HierarchicalGrid grid;
  for (unsigned seed = 0; seed < 60; ++seed) {
    Random random(seed);
    const double far = seed % 2 == 0 ? 1e6 : 1e12;
    const Things things = random.mix(4.0, far * random.place(1.0));
    expect_brute_force(grid, things, 1e-3, "seed " + std::to_string(seed));
  }
}

TEST(HierarchicalGrid, WorksWhereClustersAreFarApart) {
  HierarchicalGrid grid;
  Random random(5);
  Things things;
  for (int cluster = 0; cluster < 20; ++cluster) {
    const Vector3d centre = cluster == 0 ? Vector3d(0, 0, 0) : random.place(1e9);
    for (int k = 0; k < 20; ++k) things.add_ball(centre + random.place(5e-3), 1e-3);
  }
  things.add_ball({1e90, -1e90, 1e90}, 1e-3);
  expect_brute_force(grid, things, 0.0, "clusters");
}

// Pairs at almost exactly the width of a row, where rounding could put them two rows apart.
TEST(HierarchicalGrid, MissesNoPairAtTheEndOfItsReach) {
  HierarchicalGrid grid;
  for (unsigned seed = 0; seed < 200; ++seed) {
    Random random(seed);
    const double origin = std::pow(10.0, random.between(-3.0, 7.0));
    Things things;
    for (int k = 0; k < 20; ++k) {
      const Vector3d at = random.place(origin);
      const int axis = k % 3;
      things.add_ball(at, 1e-3);
      things.add_ball(at + (2e-3 * (1.0 - 1e-15)) * Vector3d::Unit(axis), 1e-3);
      const Vector3d place = random.place(origin), side = Vector3d::Constant(0.01);
      things.boxes.push_back({place, place + side});
      things.boxes.push_back({place + (0.01 - 1e-17) * Vector3d::Unit(axis), place + 2.0 * side});
    }
    expect_brute_force(grid, things, 0.0, "seed " + std::to_string(seed));
  }
}

TEST(HierarchicalGrid, FindsCoincidentCentresAndTouchesOfNoSize) {
  HierarchicalGrid grid;
  Things things;
  for (int k = 0; k < 5; ++k) things.add_ball({-1, 2, -3}, 0.1);
  things.add_ball({-1, 2, -3}, 0.0);
  things.add_ball({-1, 2, -3}, 0.0);
  things.boxes.assign(3, {{-1, 2, -3}, {-1, 2, -3}});
  expect_brute_force(grid, things, 0.0, "without margin");
  expect_brute_force(grid, things, 1e-9, "with margin");
  EXPECT_EQ(pairs_of(grid, things, 0.0).balls.size(), 20u);  // all but the two points
  EXPECT_EQ(pairs_of(grid, things, 1e-9).boxes.size(), 3u);
}

TEST(HierarchicalGrid, FindsPointsAndSheetsInsideWallsAndPosts) {
  HierarchicalGrid grid;
  Things things;
  things.boxes.push_back({{0, 0, 0}, {1, 1, 1e-3}});
  things.boxes.push_back({{0, 0, 0}, {1e-3, 1e-3, 1}});
  for (int k = 1; k < 64; ++k) {
    things.add_ball({k / 64.0, k / 64.0, 5e-4}, 0.0);
    things.add_ball({5e-4, 5e-4, k / 64.0}, 0.0);
    things.boxes.push_back({{k / 64.0, 0.2, 0}, {k / 64.0, 0.8, 1}});
  }
  expect_brute_force(grid, things, 0.0, "walls and posts");
}

TEST(HierarchicalGrid, FindsGrainsAroundWallsAndStaves) {
  HierarchicalGrid grid;
  Random random(11);
  Things things;
  for (int k = 0; k < 2000; ++k)
    things.add_ball(random.place(0.5), 0.01 * random.between(0.8, 1.2));
  things.boxes.push_back({{-0.5, -0.5, -0.501}, {0.5, 0.5, -0.5}});
  things.boxes.push_back({{-0.5, -0.501, -0.5}, {0.5, -0.5, 0.5}});
  things.boxes.push_back({{-5, -5, -5}, {5, 5, -0.49}});
  for (int k = 0; k < 30; ++k) {
    Vector3d sides = Vector3d::Constant(0.01);
    sides[k % 3] = 1.0;
    sides[(k + 1) % 3] = 0.1;
    things.boxes.push_back(random.box(random.place(0.5), sides));
  }
  expect_brute_force(grid, things, 1e-3, "walls");
}

TEST(HierarchicalGrid, TakesNothingAndOneThing) {
  HierarchicalGrid grid;
  Candidates found{{{1, 2}}, {{3, 4}}, {{5, 6}}};
  grid.find_pairs({}, {}, {}, 0.0, found);
  EXPECT_TRUE(found.balls.empty() && found.ball_box.empty() && found.boxes.empty());
  for (const double radius : {1.0, 0.0, -1.0}) {
    Things one;
    one.add_ball({0, 0, 0}, radius);
    expect_brute_force(grid, one, 0.0, "a ball");
    one.boxes.push_back({{-1, -1, -1}, {0, 0, 0}});
    expect_brute_force(grid, one, 1e-3, "a ball and a box");
  }
  Things nowhere;  // not a ball: its centre does not matter
  nowhere.add_ball(Vector3d::Constant(std::nan("")), -1.0);
  nowhere.add_ball({0, 0, 0}, 1.0);
  nowhere.add_ball({1, 0, 0}, 1.0);
  EXPECT_EQ(pairs_of(grid, nowhere, 0.0).balls, (std::vector<BodyPair>{{1, 2}}));
}

TEST(HierarchicalGrid, RefusesWhatIsNoPlace) {
  HierarchicalGrid grid;
  const double infinity = std::numeric_limits<double>::infinity();
  const auto error_of = [&](const Things& things) -> std::string {
    try {
      pairs_of(grid, things, 0.0);
    } catch (const problems::InputError& error) {
      return error.what();
    }
    return "no error";
  };
  for (const double bad : {infinity, -infinity, std::nan(""), 1e200}) {
    for (int axis = 0; axis < 3; ++axis) {
      Things balls;
      balls.add_ball({0, 0, 0}, 1.0);
      balls.add_ball({0, 0, 0}, 1.0);
      balls.centres[1][axis] = bad;
      EXPECT_NE(error_of(balls).find("broad phase: ball 1 has its centre at ("), std::string::npos);
      Things boxes;
      boxes.boxes.assign(2, {{0, 0, 0}, {1, 1, 1}});
      boxes.boxes[1].high[axis] = bad;
      EXPECT_NE(error_of(boxes).find("broad phase: box 1 reaches from ("), std::string::npos);
    }
  }
  for (const double bad : {infinity, std::nan("")}) {
    Things balls;
    balls.add_ball({0, 0, 0}, bad);
    EXPECT_NE(error_of(balls).find("broad phase: ball 0"), std::string::npos);
  }
  Things flipped;
  flipped.boxes.push_back({{0, 0, 1}, {1, 1, 0}});
  EXPECT_NE(error_of(flipped).find("expected increasing numbers"), std::string::npos);
  Things sound;
  sound.add_ball({0, 0, 0}, 1.0);
  EXPECT_EQ(error_of(sound), "no error");
  for (const double bad : {infinity, std::nan(""), -1.0}) {
    EXPECT_THROW(pairs_of(grid, sound, bad), problems::InputError);
  }
}

}  // namespace
}  // namespace conebench::test
