// What walls and bodies make of the dofs, rows and cones of a step.

#include <gtest/gtest.h>

#include "mpm/walls.h"
#include "tests/mpm/cloud_helper.h"

namespace conebench::test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using mpm::Scene;

class Boundary : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(In, Boundary, testing::Values(2, 3), dimension_name);

TEST_P(Boundary, SlipWallsHoldTheNormalAndCarryNoShear) {
  const int dim = GetParam();
  const Scene scene = uneven(dim, mpm::Condition::kSlip);
  const Posed posed = pose(scene, cloud(scene, 400), 1e-3);
  const int entries = dim == 2 ? 3 : 6;
  // Shear rows of the components 12, 13, 23, and the axes they join.
  const std::vector<std::array<int, 3>> shears =
      dim == 2 ? std::vector<std::array<int, 3>>{{2, 0, 1}}
               : std::vector<std::array<int, 3>>{{3, 0, 1}, {4, 0, 2}, {5, 1, 2}};
  for (int i = 0; i < posed.nodes.count(); ++i) {
    const auto slot = static_cast<std::size_t>(i);
    const Eigen::Vector3i at = scene.grid.place(posed.nodes.index[slot]);
    std::array<bool, 3> on_wall{};
    for (int a = 0; a < dim; ++a) {
      const auto axis = static_cast<std::size_t>(a);
      on_wall[axis] = at[a] == 0 || at[a] == scene.grid.cells[a];
      EXPECT_EQ(posed.assembly.dof[slot][axis] < 0, on_wall[axis]);
    }
    for (const auto& [row, a, b] : shears) {
      const double size = posed.assembly.data.H.row(i * entries + row).norm();
      const bool silent =
          on_wall[static_cast<std::size_t>(a)] || on_wall[static_cast<std::size_t>(b)];
      EXPECT_EQ(size == 0.0, silent) << "node " << at.transpose() << ", row " << row;
    }
    EXPECT_EQ(posed.assembly.cones[slot].dim, entries);
  }
}

TEST_P(Boundary, StickWallsHoldEverythingAndSilenceNothing) {
  const int dim = GetParam();
  const Scene scene = uneven(dim, mpm::Condition::kStick);
  const Posed posed = pose(scene, cloud(scene, 400), 1e-3);
  for (int i = 0; i < posed.nodes.count(); ++i) {
    const auto slot = static_cast<std::size_t>(i);
    const Eigen::Vector3i at = scene.grid.place(posed.nodes.index[slot]);
    bool on_wall = false;
    for (int a = 0; a < dim; ++a) on_wall |= at[a] == 0 || at[a] == scene.grid.cells[a];
    for (int a = 0; a < dim; ++a) {
      EXPECT_EQ(posed.assembly.dof[slot][static_cast<std::size_t>(a)] < 0, on_wall);
    }
    for (int row = 0; row < (dim == 2 ? 3 : 6); ++row) {
      EXPECT_GT(posed.assembly.data.H.row(i * (dim == 2 ? 3 : 6) + row).norm(), 0.0);
    }
  }
}

TEST_P(Boundary, FrictionalWallsAddConesOverTheirArea) {
  const int dim = GetParam();
  Scene scene = open_scene(dim == 2 ? std::vector{4, 4} : std::vector{4, 4, 4});
  scene.walls[static_cast<std::size_t>(2 * dim - 2)] = {mpm::Condition::kFrictional, 0.3};
  add_block(scene, Vector3d::Zero(), Vector3d::Constant(4.0));
  const Posed posed = pose(scene, particles_of(scene), 1e-3);
  const auto& assembly = posed.assembly;
  double area = 0.0;
  for (std::size_t k = 0; k < assembly.interfaces.size(); ++k) {
    const mpm::Interface& contact = assembly.interfaces[k];
    const problems::Cone& cone = assembly.cones[static_cast<std::size_t>(posed.nodes.count()) + k];
    EXPECT_EQ(cone.dim, dim);
    EXPECT_EQ(cone.mu, 0.3);
    EXPECT_EQ(contact.frame.col(0), Vector3d::Unit(dim - 1));
    EXPECT_NEAR((contact.frame.transpose() * contact.frame - Matrix3d::Identity()).norm(), 0.0,
                1e-15);
    area += contact.weight / 0.6;
  }
  EXPECT_EQ(assembly.interfaces.size(), dim == 2 ? 5u : 25u);
  EXPECT_NEAR(area, dim == 2 ? 0.4 : 0.16, 1e-14);
}

// A half space up to a quarter of a cell above a plane of nodes: the midpoint rule is exact there.
TEST_P(Boundary, BodiesCoverTheVolumeInsideThem) {
  const int dim = GetParam();
  Scene scene = open_scene(dim == 2 ? std::vector{4, 4} : std::vector{4, 4, 4});
  add_block(scene, Vector3d::Zero(), Vector3d::Constant(4.0));
  mpm::Body floor;
  floor.shape = mpm::Shape::kHalfSpace;
  floor.normal = Vector3d::Unit(dim - 1);
  floor.centre_m = 0.125 * floor.normal;  // a quarter of the second cell
  const std::vector<mpm::RigidBody> bodies = {mpm::make_body(floor, dim)};
  const mpm::Particles particles = particles_of(scene);
  mpm::Nodes nodes;
  mpm::scatter(scene, particles, nodes);
  mpm::cover(scene, bodies, 0.0, nodes);
  for (int i = 0; i < nodes.count(); ++i) {
    const int layer = scene.grid.place(nodes.index[static_cast<std::size_t>(i)])[dim - 1];
    // Of a cell of length 1 above node `layer`: its tent from 0 to 1.25.
    const std::array<double, 5> covered = {0.5, 0.5 + 0.25 - 0.5 * 0.0625, 0.5 * 0.0625, 0.0, 0.0};
    const double full = layer == 0 || layer == 4 ? 0.5 : 1.0;
    const double share = covered[static_cast<std::size_t>(layer)] / full;
    EXPECT_NEAR(nodes.covered[i], share * nodes.volume[i], 1e-14) << layer;
  }
}

}  // namespace
}  // namespace conebench::test
