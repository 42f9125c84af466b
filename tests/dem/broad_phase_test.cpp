#include "dem/broad_phase.h"

#include <gtest/gtest.h>

#include <random>

#include "dem/contacts.h"

namespace conebench::test {
namespace {

using dem::BodyPair;
using Eigen::Vector3d;

std::vector<BodyPair> brute_force(const std::vector<Vector3d>& positions,
                                  const std::vector<double>& radii, double margin) {
  std::vector<BodyPair> pairs;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    for (std::size_t j = i + 1; j < positions.size(); ++j) {
      const double reach = radii[i] + radii[j] + margin;
      if ((positions[i] - positions[j]).squaredNorm() < reach * reach) {
        pairs.push_back({static_cast<int>(i), static_cast<int>(j)});
      }
    }
  }
  return pairs;
}

TEST(BroadPhase, FindsThePairsThatBruteForceFinds) {
  dem::CellList cells;
  std::vector<BodyPair> pairs;
  for (unsigned seed = 0; seed < 50; ++seed) {
    std::mt19937 random(seed);
    const int count = 1 + static_cast<int>(random() % 200);
    const double size = 0.1 + 0.05 * (seed % 10);
    std::uniform_real_distribution<double> place(-size, size), radius(0.005, 0.04);
    std::vector<Vector3d> positions;
    std::vector<double> radii;
    for (int i = 0; i < count; ++i) {
      positions.emplace_back(place(random), place(random), place(random));
      radii.push_back(radius(random));
    }
    const double margin = seed % 2 ? 0.0 : 0.01;
    cells.find_pairs(positions, radii, margin, pairs);
    EXPECT_EQ(pairs, brute_force(positions, radii, margin)) << "seed " << seed;
  }
}

TEST(BroadPhase, TakesNoBodiesAndBodiesFarApart) {
  dem::CellList cells;
  std::vector<BodyPair> pairs{{1, 2}};
  cells.find_pairs({}, {}, 0.0, pairs);
  EXPECT_TRUE(pairs.empty());
  const std::vector<Vector3d> positions{{0, 0, 0}, {1e7, 0, 0}, {1e7, 0.015, 0}, {-1e7, 0, 3e7}};
  const std::vector<double> radii(4, 0.01);
  cells.find_pairs(positions, radii, 0.0, pairs);
  EXPECT_EQ(pairs, (std::vector<BodyPair>{{1, 2}}));
}

TEST(Frame, IsRightHandedAndOrthonormalAroundAnyNormal) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (int k = 0; k < 200; ++k) {
    Vector3d n(normal(random), normal(random), normal(random));
    if (k < 3) n = Vector3d::Unit(k);
    const Eigen::Matrix3d frame = dem::frame_around(n.normalized());
    EXPECT_LT((frame.transpose() * frame - Eigen::Matrix3d::Identity()).norm(), 1e-15 * 10);
    EXPECT_NEAR(frame.determinant(), 1.0, 1e-14);
    EXPECT_EQ(frame.col(0), n.normalized());
  }
}

}  // namespace
}  // namespace conebench::test
