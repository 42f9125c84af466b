// Which cells are cut: those at the heap's boundary.

#include "mpm/refine.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "mpm/svg_frame.h"
#include "tests/engine/small_solver.h"
#include "tests/engine/xml.h"
#include "tests/mpm/engine_helper.h"

namespace conebench::test {
namespace {

using Eigen::Vector3d;
using mpm::Scene;

// Row by row from the top; '#' is cut.
std::vector<std::string> picture(const Scene& scene) {
  const std::vector<bool> cut = mpm::boundary_cells(scene, particles_of(scene));
  const mpm::Grid& grid = scene.grid;
  std::vector<std::string> rows;
  for (int y = grid.cells[1] - 1; y >= 0; --y) {
    std::string& row = rows.emplace_back();
    for (int x = 0; x < grid.cells[0]; ++x) {
      row += cut[static_cast<std::size_t>(grid.cell({x, y, 0}))] ? '#' : '.';
    }
  }
  return rows;
}

using Picture = std::vector<std::string>;

TEST(Refine, CutsALayerOnBothSidesOfTheSurfaceAndNoneAtWalls) {
  Scene scene = box_scene({8, 6});
  add_block(scene, Vector3d::Zero(), {5.0, 4.0, 0.0});
  const Picture expected = {"........",  //
                            "######..",  //
                            "######..",  //
                            "....##..",  //
                            "....##..",  //
                            "....##.."};
  EXPECT_EQ(picture(scene), expected);
}

TEST(Refine, CutsNothingWhereSandFillsTheGrid) {
  Scene scene = box_scene({4, 3});
  add_block(scene, Vector3d::Zero(), {4.0, 3.0, 0.0});
  const Picture expected = {"....", "....", "...."};
  EXPECT_EQ(picture(scene), expected);
}

// The surface is where a cell is half full: a strewn layer on the heap is outside of it.
TEST(Refine, TakesCellsLessThanHalfFullForOutside) {
  Scene scene = box_scene({3, 7});
  add_block(scene, Vector3d::Zero(), {3.0, 4.0, 0.0});
  mpm::Block& strewn = add_block(scene, {0.0, 4.0, 0.0}, {3.0, 5.0, 0.0});
  strewn.fraction = 0.45 * scene.material.phi_max;
  const Picture outside = {"...", "###", "###", "###", "...", "...", "..."};
  EXPECT_EQ(picture(scene), outside);
  scene.blocks[1].fraction = 0.55 * scene.material.phi_max;
  const Picture inside = {"...", "###", "###", "...", "...", "...", "..."};
  EXPECT_EQ(picture(scene), inside);
}

// A block in the corner of a grid of three dimensions: its outermost cells and those around them.
TEST(Refine, CutsEdgesAndCornersInSpace) {
  Scene scene = box_scene({7, 7, 7});
  add_block(scene, Vector3d::Zero(), {4.0, 4.0, 4.0});
  const std::vector<bool> cut = mpm::boundary_cells(scene, particles_of(scene));
  for (int cell = 0; cell < scene.grid.cell_count(); ++cell) {
    const int farthest = scene.grid.cell_place(cell).maxCoeff();
    EXPECT_EQ(cut[static_cast<std::size_t>(cell)], farthest == 3 || farthest == 4);
  }
}

TEST(Refine, LeavesAGridAloneThatAsksForNone) {
  Scene scene = box_scene({8, 6});
  add_block(scene, Vector3d::Zero(), {5.0, 4.0, 0.0});
  const mpm::Particles particles = particles_of(scene);
  EXPECT_TRUE(mpm::mesh_for(scene, particles).regular());
  EXPECT_EQ(mpm::mesh_for(scene, particles).grid().cells, scene.grid.cells);
  scene.grid.refine = mpm::Refine::kBoundary;
  EXPECT_FALSE(mpm::mesh_for(scene, particles).regular());
  EXPECT_EQ(mpm::mesh_for(scene, particles).grid().cells, Eigen::Vector3i(16, 12, 0));
}

TEST(Refine, PicturesHaveALineAlongEachAxisInEveryCutCell) {
  Scene scene = box_scene({8, 6});
  scene.grid.refine = mpm::Refine::kBoundary;
  add_block(scene, Vector3d::Zero(), {5.0, 4.0, 0.0});
  const mpm::Frame frame = mpm::make_frame(mpm::Simulation(scene, small_solver(1e-3)));
  EXPECT_EQ(std::count(frame.cut.begin(), frame.cut.end(), true), 18);
  const std::string picture = mpm::draw_svg(scene, frame, {});
  const std::string lines = parse_xml(picture).find("path", "stroke", "#e0e4e7").attribute("d");
  EXPECT_EQ(std::count(lines.begin(), lines.end(), 'M'), 7 + 5 + 2 * 18);
}

}  // namespace
}  // namespace conebench::test
