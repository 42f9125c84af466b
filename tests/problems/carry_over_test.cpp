#include "problems/carry_over.h"

#include <gtest/gtest.h>

#include "problems/error.h"

namespace conebench::problems {
namespace {

using Points = std::vector<Eigen::Vector3d>;

// Contacts of d = 3 without coupling, W = 1, with the given places, bodies and frames.
ProblemFile contacts(const Points& points, const std::vector<std::pair<int, int>>& bodies,
                     const std::vector<Eigen::Matrix3d>& frames, double step_size_s) {
  const auto count = static_cast<int>(points.size());
  SparseMatrix W(3 * count, 3 * count);
  W.setIdentity();
  Metadata metadata;
  metadata.step_size_s = step_size_s;
  ProblemFile file{
      .problem = Problem(ReducedData{W, Eigen::VectorXd::Zero(3 * count)},
                         std::vector<Cone>(points.size(), Cone::coulomb(3, 0.5)), metadata),
      .geometry = Geometry{},
      .guess = {},
      .solution = {}};
  Geometry& geometry = *file.geometry;
  geometry.points.resize(count, 3);
  geometry.frames.resize(count, 9);
  geometry.bodies_of_cone.resize(count, 2);
  for (int i = 0; i < count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    geometry.points.row(i) = points[k];
    geometry.frames.row(i) = frames[k].reshaped();
    geometry.bodies_of_cone.row(i) << bodies[k].first, bodies[k].second;
  }
  return file;
}

const Eigen::Matrix3d kAxes = Eigen::Matrix3d::Identity();

TEST(CarryOver, FollowsBodiesAndTheNearestPointOfAPair) {
  const auto from = contacts({{0, 0, 0}, {1, 0, 0}, {5, 0, 0}}, {{0, 1}, {0, 1}, {1, 2}},
                             {kAxes, kAxes, kAxes}, 1e-3);
  const auto to = contacts({{5, 0, 0}, {1.1, 0, 0}, {0.1, 0, 0}, {9, 0, 0}},
                           {{1, 2}, {0, 1}, {0, 1}, {2, 3}}, {kAxes, kAxes, kAxes, kAxes}, 1e-3);
  Eigen::VectorXd r(9), expected(12);
  r << 1, 0.1, 0, 2, 0.2, 0, 3, 0.3, 0;
  expected << 3, 0.3, 0, 2, 0.2, 0, 1, 0.1, 0, 0, 0, 0;
  EXPECT_EQ(carry_over(from, r, to), expected);
}

TEST(CarryOver, TurnsWithTheFrameAndGrowsWithTheStep) {
  Eigen::Matrix3d turned;  // about the normal by 90 degrees: the first tangent becomes the second
  turned << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  const auto from = contacts({{0, 0, 0}}, {{0, -1}}, {kAxes}, 1e-3);
  const auto to = contacts({{0, 0, 0}}, {{0, -1}}, {turned}, 2e-3);
  EXPECT_TRUE(carry_over(from, Eigen::Vector3d(1.0, 0.3, 0.1), to)
                  .isApprox(Eigen::Vector3d(2.0, 0.2, -0.6), 1e-14));
}

TEST(CarryOver, LiesInTheConesOfTheNewStep) {
  const auto from = contacts({{0, 0, 0}}, {{0, -1}}, {kAxes}, 0.0);
  const Eigen::VectorXd guess = carry_over(from, Eigen::Vector3d(1.0, 3.0, 0.0), from);
  EXPECT_LE(guess.tail(2).norm(), 0.5 * guess(0) * (1.0 + 1e-14));
}

TEST(CarryOver, NodesOfAMediumKeepTheirAxesAndMatchByPlace) {
  auto from = contacts({{0, 0, 0}, {1, 0, 0}}, {{-1, -1}, {-1, -1}}, {kAxes, kAxes}, 1e-3);
  auto to = contacts({{1, 0, 0}, {2, 0, 0}}, {{-1, -1}, {-1, -1}}, {kAxes, kAxes}, 1e-3);
  from.geometry->state = {0, 2};
  to.geometry->state = {2, 2};
  Eigen::VectorXd r(6), expected(6);
  r << 1, 0.1, 0, 2, 0.2, 0.3;
  expected << 2, 0.2, 0.3, 0, 0, 0;
  EXPECT_EQ(carry_over(from, r, to), expected);
}

TEST(CarryOver, WithoutGeometryGoesByOrderOrNotAtAll) {
  auto from = contacts({{0, 0, 0}, {1, 0, 0}}, {{0, 1}, {0, 2}}, {kAxes, kAxes}, 0.0);
  auto to = contacts({{7, 0, 0}, {8, 0, 0}}, {{3, 4}, {3, 5}}, {kAxes, kAxes}, 0.0);
  Eigen::VectorXd r(6);
  r << 1, 0.1, 0, 2, 0.2, 0;
  EXPECT_EQ(carry_over(from, r, to), Eigen::VectorXd::Zero(6));
  to.geometry.reset();
  EXPECT_EQ(carry_over(from, r, to), r);
  const auto fewer = contacts({{0, 0, 0}}, {{0, 1}}, {kAxes}, 0.0);
  EXPECT_EQ(carry_over(fewer, r.head(3), to), Eigen::VectorXd::Zero(6));
  EXPECT_THROW(carry_over(fewer, r, to), InputError);
}

}  // namespace
}  // namespace conebench::problems
