// Shape functions of a mesh with whole and cut cells.

#include "mpm/mesh.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/mpm/cloud_helper.h"

namespace conebench::test {
namespace {

using Eigen::Vector3d;
using mpm::Grid;
using mpm::Mesh;

class MeshIn : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Dimensions, MeshIn, testing::Values(2, 3), dimension_name);

mpm::Scene refined(int dim) {
  mpm::Scene scene = uneven(dim, mpm::Condition::kFree);
  scene.grid.refine = mpm::Refine::kBoundary;
  return scene;
}

std::vector<bool> all_cells(const Grid& grid, bool cut) {
  return std::vector<bool>(static_cast<std::size_t>(grid.cell_count()), cut);
}

// Every other cell or so is cut.
Mesh patchwork(const Grid& grid) {
  Random random;
  std::vector<bool> cut = all_cells(grid, false);
  for (std::size_t cell = 0; cell < cut.size(); ++cell) cut[cell] = random.number() > 0.0;
  return Mesh(grid, cut);
}

template <int D>
void expect_linear_fields() {
  const mpm::Scene scene = refined(D);
  const Mesh mesh = patchwork(scene.grid);
  for (const Vector3d& x : cloud(scene, 500).position) {
    const auto s = mpm::stencil_at<D>(mesh, x);
    EXPECT_EQ(std::set<int>(s.node.begin(), s.node.end()).size(), s.node.size());
    double sum = 0.0;
    mpm::Vec<D> gradients = mpm::Vec<D>::Zero(), reach = mpm::Vec<D>::Zero();
    Eigen::Matrix<double, D, D> slopes = Eigen::Matrix<double, D, D>::Zero();
    for (std::size_t k = 0; k < s.node.size(); ++k) {
      EXPECT_FALSE(mesh.hangs(s.node[k]));
      EXPECT_GE(s.weight[k], 0.0);
      const Vector3d to_node = mesh.grid().position(s.node[k]) - x;
      EXPECT_LT((s.reach[k] - to_node.template head<D>()).norm(), 1e-15);
      sum += s.weight[k];
      gradients += s.gradient[k];
      reach += s.weight[k] * s.reach[k];
      slopes += s.reach[k] * s.gradient[k].transpose();
    }
    EXPECT_NEAR(sum, 1.0, 1e-15);
    EXPECT_LT(gradients.norm(), 1e-14 / mesh.grid().smallest_spacing());
    EXPECT_LT(reach.norm(), 1e-15);
    EXPECT_LT((slopes - Eigen::Matrix<double, D, D>::Identity()).norm(), 1e-14);
  }
}

TEST_P(MeshIn, LinearFieldsAndTheirGradientsAreReproduced) {
  GetParam() == 2 ? expect_linear_fields<2>() : expect_linear_fields<3>();
}

template <int D>
double value_at(const Mesh& mesh, const std::vector<double>& field, const Vector3d& x) {
  const auto s = mpm::stencil_at<D>(mesh, x);
  double value = 0.0;
  for (std::size_t k = 0; k < s.node.size(); ++k) {
    value += s.weight[k] * field[static_cast<std::size_t>(s.node[k])];
  }
  return value;
}

// Points on faces of halves, seen from both sides; inside, the gradients are slopes.
template <int D>
void expect_continuous_field() {
  constexpr double kStep = 1e-7;  // [m]
  const mpm::Scene scene = refined(D);
  const Mesh mesh = patchwork(scene.grid);
  const Grid& fine = mesh.grid();
  Random random;
  std::vector<double> field;
  for (int node = 0; node < fine.node_count(); ++node) field.push_back(random.number());
  // Values in [-1, 1] on nodes a half apart at least: no slope is steeper.
  const double steepest = 2.0 / fine.smallest_spacing();
  for (const Vector3d& x : cloud(scene, 500).position) {
    for (int a = 0; a < D; ++a) {
      Vector3d low = x, high = x;
      const int plane = std::max(1, fine.cell_around(x)[a]);
      const double face = fine.low_m[a] + plane * fine.spacing(a);
      low[a] = face - kStep;
      high[a] = face + kStep;
      const double jump = value_at<D>(mesh, field, high) - value_at<D>(mesh, field, low);
      EXPECT_LE(std::abs(jump), 2.0 * kStep * steepest);
      const auto s = mpm::stencil_at<D>(mesh, x);
      double slope = 0.0;
      for (std::size_t k = 0; k < s.node.size(); ++k) {
        slope += s.gradient[k][a] * field[static_cast<std::size_t>(s.node[k])];
      }
      const Vector3d e = 1e-3 * kStep * Vector3d::Unit(a);  // within the half, all but surely
      const double rise = value_at<D>(mesh, field, x + e) - value_at<D>(mesh, field, x - e);
      EXPECT_NEAR(rise / (2e-3 * kStep), slope, 1e-5 * steepest);
    }
  }
}

TEST_P(MeshIn, FieldsAreContinuousAndTheirGradientsAreTheirSlopes) {
  GetParam() == 2 ? expect_continuous_field<2>() : expect_continuous_field<3>();
}

template <int D>
void expect_volumes() {
  const mpm::Scene scene = refined(D);
  const Mesh mesh = patchwork(scene.grid);
  const Grid& fine = mesh.grid();
  // Shape functions are multilinear on halves: the midpoint rule is exact.
  std::vector<double> expected(static_cast<std::size_t>(fine.node_count()), 0.0);
  for (int cell = 0; cell < fine.cell_count(); ++cell) {
    Vector3d middle = fine.low_m;
    for (int a = 0; a < D; ++a) middle[a] += (fine.cell_place(cell)[a] + 0.5) * fine.spacing(a);
    const auto s = mpm::stencil_at<D>(mesh, middle);
    for (std::size_t k = 0; k < s.node.size(); ++k) {
      expected[static_cast<std::size_t>(s.node[k])] += s.weight[k] * fine.cell_volume();
    }
  }
  double sum = 0.0;
  int hanging = 0;
  for (int node = 0; node < fine.node_count(); ++node) {
    hanging += mesh.hangs(node);
    if (mesh.hangs(node)) continue;
    const double volume = mesh.node_volume(node);
    EXPECT_NEAR(volume, expected[static_cast<std::size_t>(node)], 1e-14 * scene.grid.cell_volume());
    sum += volume;
  }
  const double whole = scene.grid.size_m.template head<D>().prod();
  EXPECT_NEAR(sum, whole, 1e-13 * whole);
  EXPECT_GT(hanging, 0);
}

TEST_P(MeshIn, VolumesOfNodesAreTheIntegralsOfTheirShapeFunctionsAndFillTheGrid) {
  GetParam() == 2 ? expect_volumes<2>() : expect_volumes<3>();
}

template <int D>
void expect_the_grid_of_halves() {
  const mpm::Scene scene = refined(D);
  const Mesh mesh(scene.grid, all_cells(scene.grid, true));
  const Grid fine = scene.grid.finest();
  for (const Vector3d& x : cloud(scene, 100).position) {
    const auto s = mpm::stencil_at<D>(mesh, x), expected = mpm::stencil_at<D>(fine, x);
    EXPECT_EQ(s.node, expected.node);
    EXPECT_EQ(s.weight, expected.weight);
    EXPECT_EQ(s.gradient, expected.gradient);
    EXPECT_EQ(s.reach, expected.reach);
  }
  for (int node = 0; node < fine.node_count(); ++node) {
    EXPECT_EQ(mesh.node_volume(node), fine.node_volume(node));
  }
}

TEST_P(MeshIn, OfCutCellsOnlyIsTheGridOfHalvesBitForBit) {
  GetParam() == 2 ? expect_the_grid_of_halves<2>() : expect_the_grid_of_halves<3>();
}

template <int D>
void expect_the_scenes_grid() {
  const mpm::Scene scene = refined(D);
  const Grid& grid = scene.grid;
  const Mesh mesh(grid, all_cells(grid, false));
  for (const Vector3d& x : cloud(scene, 100).position) {
    const auto s = mpm::stencil_at<D>(mesh, x);
    for (std::size_t k = 0; k < s.node.size(); ++k) {
      const Eigen::Vector3i at = mesh.grid().place(s.node[k]);
      const int node = grid.node(at / 2);
      EXPECT_EQ(grid.position(node), mesh.grid().position(s.node[k]));
      EXPECT_NEAR(s.weight[k], shape(grid, node, x), 1e-14);
      const Vector3d slope = shape_gradient(grid, node, x);
      EXPECT_LT((s.gradient[k] - slope.template head<D>()).norm(), 1e-13 / grid.smallest_spacing());
      EXPECT_NEAR(mesh.node_volume(s.node[k]), grid.node_volume(node), 1e-14 * grid.cell_volume());
    }
  }
}

TEST_P(MeshIn, OfWholeCellsOnlyIsTheScenesGrid) {
  GetParam() == 2 ? expect_the_scenes_grid<2>() : expect_the_scenes_grid<3>();
}

// Two cells side by side, the left one cut: of the nodes on their face, the one in its middle
// hangs.
TEST(MeshOfTwoCells, TheMiddleOfTheirFaceIsTheMeanOfItsEnds) {
  mpm::Scene scene = open_scene({2, 1});
  scene.grid.refine = mpm::Refine::kBoundary;
  const Mesh mesh(scene.grid, {true, false});
  const Grid& fine = mesh.grid();
  const auto node = [&](int x, int y) { return fine.node({x, y, 0}); };
  std::set<int> hanging;
  for (int i = 0; i < fine.node_count(); ++i) {
    if (mesh.hangs(i)) hanging.insert(i);
  }
  EXPECT_EQ(hanging, std::set<int>({node(2, 1), node(3, 0), node(3, 1), node(3, 2), node(4, 1)}));
  // A quarter left of the middle of the face, in the upper half cell.
  const auto s = mpm::stencil_at<2>(mesh, {0.0875, 0.05, 0.0});
  const std::array<int, 4> nodes = {node(1, 1), node(2, 0), node(1, 2), node(2, 2)};
  const std::array<double, 4> weights = {0.25, 0.375, 0.0, 0.375};
  EXPECT_EQ(s.node, nodes);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(s.weight[k], weights[k], 1e-14) << k;
  EXPECT_EQ(mesh.next(node(2, 0), 0, 1), node(4, 0));
  EXPECT_EQ(mesh.next(node(2, 0), 0, -1), node(1, 0));
}

}  // namespace
}  // namespace conebench::test
