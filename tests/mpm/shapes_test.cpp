// Shape functions against products of tents written out in the helper.

#include <gtest/gtest.h>

#include "tests/mpm/cloud_helper.h"

namespace conebench::test {
namespace {

using Eigen::Vector3d;
using mpm::Scene;

class Shapes : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(In, Shapes, testing::Values(2, 3), dimension_name);

template <int D>
void expect_shapes() {
  const Scene scene = uneven(D, mpm::Condition::kFree);
  const mpm::Grid& grid = scene.grid;
  constexpr double kStep = 1e-6;  // [m]; the functions are multilinear: only rounding is left
  for (const Vector3d& x : cloud(scene, 200).position) {
    const auto s = mpm::stencil_at<D>(grid, x);
    double sum = 0.0;
    mpm::Vec<D> gradients = mpm::Vec<D>::Zero(), reach = mpm::Vec<D>::Zero();
    for (std::size_t k = 0; k < s.node.size(); ++k) {
      EXPECT_NEAR(s.weight[k], shape(grid, s.node[k], x), 1e-13);
      const Vector3d reach_of_node = grid.position(s.node[k]) - x;
      EXPECT_LT((s.reach[k] - reach_of_node.template head<D>()).norm(), 1e-15);
      for (int a = 0; a < D; ++a) {
        const Vector3d e = kStep * Vector3d::Unit(a);
        const double slope =
            (shape(grid, s.node[k], x + e) - shape(grid, s.node[k], x - e)) / (2.0 * kStep);
        EXPECT_NEAR(s.gradient[k][a], slope, 1e-8);
      }
      sum += s.weight[k];
      gradients += s.gradient[k];
      reach += s.weight[k] * s.reach[k];
    }
    EXPECT_NEAR(sum, 1.0, 1e-15);
    EXPECT_LT(gradients.norm(), 1e-14 / grid.smallest_spacing());
    EXPECT_LT(reach.norm(), 1e-15);
  }
}

TEST_P(Shapes, SumToOneAndTheirGradientsAreTheirSlopes) {
  GetParam() == 2 ? expect_shapes<2>() : expect_shapes<3>();
}

TEST_P(Shapes, GridsCornersAreInsideIt) {
  const Scene scene = uneven(GetParam(), mpm::Condition::kFree);
  const Vector3d high = scene.grid.low_m + scene.grid.size_m;
  ASSERT_TRUE(scene.grid.contains(high));
  const int last = scene.grid.node_count() - 1;
  if (GetParam() == 2) {
    EXPECT_EQ(mpm::stencil_at<2>(scene.grid, high).node.back(), last);
    EXPECT_NEAR(mpm::stencil_at<2>(scene.grid, high).weight.back(), 1.0, 1e-14);
  } else {
    EXPECT_EQ(mpm::stencil_at<3>(scene.grid, high).node.back(), last);
    EXPECT_NEAR(mpm::stencil_at<3>(scene.grid, high).weight.back(), 1.0, 1e-14);
  }
}

}  // namespace
}  // namespace conebench::test
