// ParaView files: what a reader finds in them.

#include "problems/engine/vtk.h"

#include <gmock/gmock.h>

#include <stdexcept>

#include "tests/engine/xml.h"

namespace conebench::test {
namespace {

using testing::ElementsAre;

std::vector<double> array(const XmlElement& file, const std::string& name) {
  return numbers_in(file.find("DataArray", "Name", name).text);
}

// What the tests of pictures and ParaView files stand on.
TEST(Xml, IsRefusedWhereItIsNotWellFormed) {
  const XmlElement root = parse_xml("<?xml version=\"1.0\"?>\n<a b=\"1 &lt; 2\"> x<c/>y </a>\n");
  EXPECT_EQ(root.attribute("b"), "1 < 2");
  EXPECT_EQ(root.text, " xy ");
  EXPECT_EQ(root.all("c").size(), 1u);
  for (const char* wrong : {"", "<a>", "<a></b>", "<a/><a/>", "<a b=1/>", "<a b=\"1/>", "<a>&</a>",
                            "<a b=\"1\" b=\"2\"/>", "<a b=\"<\"/>", "<a><b></a></b>", "<a", "<>"}) {
    EXPECT_THROW(parse_xml(wrong), std::runtime_error) << wrong;
  }
  EXPECT_THROW(numbers_in("1 2,nan? 3"), std::runtime_error);
}

TEST(Vtk, PointsAreOneCellEach) {
  engine::PolyData out(2);
  out.points([](int i) { return Eigen::Vector3d(i, 0.5, -1.0); });
  out.scalars("radius_m", [](int i) { return 0.1 * i; });
  const XmlElement file = parse_xml(out.finish());
  const XmlElement& piece = *file.all("Piece").at(0);
  EXPECT_EQ(piece.attribute("NumberOfPoints"), "2");
  EXPECT_EQ(piece.attribute("NumberOfVerts"), "2");
  EXPECT_EQ(piece.attribute("NumberOfPolys"), "0");
  EXPECT_THAT(array(file, "points"), ElementsAre(0, 0.5, -1, 1, 0.5, -1));
  EXPECT_THAT(array(file, "connectivity"), ElementsAre(0, 1));
  EXPECT_THAT(array(file, "offsets"), ElementsAre(1, 2));
  EXPECT_THAT(array(*file.all("PointData").at(0), "radius_m"), ElementsAre(0, 0.1));
}

TEST(Vtk, PolygonsAreTheCellsAndCarryTheArrays) {
  const std::vector<std::vector<int>> polygons{{0, 1, 2, 3}, {3, 2, 4}};
  engine::PolyData out(5, polygons);
  out.points([](int i) { return Eigen::Vector3d(i, i, 0.0); });
  out.vectors("velocity_m_s", [](int i) { return Eigen::Vector3d(i, 0.0, 7.0); });
  out.integers("body", [](int i) { return 4 - i; });
  const XmlElement file = parse_xml(out.finish());
  const XmlElement& piece = *file.all("Piece").at(0);
  EXPECT_EQ(piece.attribute("NumberOfPoints"), "5");
  EXPECT_EQ(piece.attribute("NumberOfVerts"), "0");
  EXPECT_EQ(piece.attribute("NumberOfPolys"), "2");
  EXPECT_TRUE(file.all("Verts").empty());
  const XmlElement& polys = *file.all("Polys").at(0);
  EXPECT_THAT(array(polys, "connectivity"), ElementsAre(0, 1, 2, 3, 3, 2, 4));
  EXPECT_THAT(array(polys, "offsets"), ElementsAre(4, 7));
  const XmlElement& cells = *file.all("CellData").at(0);
  EXPECT_THAT(array(cells, "velocity_m_s"), ElementsAre(0, 0, 7, 1, 0, 7));
  EXPECT_EQ(cells.find("DataArray", "Name", "velocity_m_s").attribute("NumberOfComponents"), "3");
  EXPECT_THAT(array(cells, "body"), ElementsAre(4, 3));
  EXPECT_TRUE(file.all("PointData").empty());
}

TEST(Vtk, NoPolygonsIsAFileToo) {
  engine::PolyData out(0, {});
  out.points([](int) { return Eigen::Vector3d::Zero().eval(); });
  out.scalars("speed_m_s", [](int) { return 0.0; });
  const XmlElement file = parse_xml(out.finish());
  EXPECT_EQ(file.all("Piece").at(0)->attribute("NumberOfPolys"), "0");
  EXPECT_TRUE(array(file, "offsets").empty());
  EXPECT_EQ(file.all("CellData").size(), 1u);
}

}  // namespace
}  // namespace conebench::test
