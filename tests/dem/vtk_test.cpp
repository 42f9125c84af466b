// ParaView files of a running simulation: balls as points, other bodies as faces.

#include <gmock/gmock.h>

#include <fstream>
#include <iterator>
#include <set>

#include "dem/vtk_writer.h"
#include "tests/dem/scene_helper.h"
#include "tests/engine/own_folder.h"
#include "tests/engine/xml.h"

namespace conebench::test {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;
using testing::ElementsAre;

class DemVtk : public OwnFolder {
 protected:
  // The files of one step of a scene that stands as it was placed.
  void write(const dem::Scene& scene) {
    const dem::Placement start = dem::place_bodies(scene, "scene");
    const dem::ContactList contacts(scene, start);
    dem::VtkWriter writer(folder_, scene.step_s, start, 1);
    dem::StepView view;
    view.step = 7;
    view.time_s = 0.007;
    view.bodies = &start.bodies;
    view.contacts = &contacts;
    writer(view);
    writer.finish();
  }
  XmlElement read(const std::string& name) const {
    std::ifstream file(folder_ / name);
    return parse_xml(std::string(std::istreambuf_iterator<char>(file), {}));
  }
  static std::vector<double> array(const XmlElement& file, const std::string& name) {
    return numbers_in(file.find("DataArray", "Name", name).text);
  }
};

// A ball that stands, a box that moves and turns, a fixed cylinder.
dem::Scene mixed() {
  dem::Scene scene = small_scene({.friction = 0.5});
  add_shape(scene, "box", dem::Box{{0.01, 0.02, 0.03}});
  add_shape(scene, "cylinder", dem::Cylinder{0.01, 0.02});
  add_body(scene, {0.1, 0.0, 0.0}, 0.02);
  dem::Body& box = add_body(scene, {0.0, 0.0, 0.5}, "box");
  box.velocity_m_s = {1.0, 0.0, 0.0};
  box.angular_velocity_rad_s = {0.0, 0.0, 10.0};
  add_body(scene, {-0.1, 0.0, 0.0}, "cylinder").fixed = true;
  return scene;
}

TEST_F(DemVtk, BallsArePointsAndOtherBodiesFaces) {
  write(mixed());
  const XmlElement spheres = read("spheres_000007.vtp");
  EXPECT_EQ(spheres.all("Piece").at(0)->attribute("NumberOfPoints"), "1");
  EXPECT_THAT(array(spheres, "points"), ElementsAre(0.1, 0.0, 0.0));
  EXPECT_THAT(array(spheres, "radius_m"), ElementsAre(0.02));

  const XmlElement solids = read("solids_000007.vtp");
  EXPECT_EQ(solids.all("Piece").at(0)->attribute("NumberOfPoints"), "40");  // 8 and 2 x 16
  EXPECT_EQ(solids.all("Piece").at(0)->attribute("NumberOfPolys"), "24");   // 6 and 18
  const std::vector<double> body = array(solids, "body"), free = array(solids, "free");
  ASSERT_EQ(body.size(), 24u);
  for (std::size_t k = 0; k < body.size(); ++k) {
    EXPECT_EQ(body[k], k < 6 ? 1.0 : 2.0);
    EXPECT_EQ(free[k], k < 6 ? 1.0 : 0.0);
  }
}

// Connectivity and offsets make the closed surfaces of the bodies, turned outwards: their volumes
// by the divergence theorem.
TEST_F(DemVtk, FacesEncloseTheBodies) {
  write(mixed());
  const XmlElement solids = read("solids_000007.vtp");
  const std::vector<double> points = array(solids, "points"), body = array(solids, "body");
  const std::vector<double> corners = array(solids, "connectivity");
  const std::vector<double> ends = array(solids, "offsets");
  ASSERT_EQ(ends.size(), body.size());
  ASSERT_EQ(ends.back(), static_cast<double>(corners.size()));
  const auto point = [&](std::size_t corner) {
    const auto at = 3 * static_cast<std::size_t>(corners.at(corner));
    return Vector3d(points.at(at), points.at(at + 1), points.at(at + 2));
  };
  double volume[3] = {0.0, 0.0, 0.0};
  std::size_t begin = 0;
  for (std::size_t face = 0; face < ends.size(); ++face) {
    const auto end = static_cast<std::size_t>(ends[face]);
    ASSERT_GE(end, begin + 3);
    for (std::size_t k = begin + 2; k < end; ++k) {
      volume[static_cast<std::size_t>(body[face])] +=
          point(begin).dot(point(k - 1).cross(point(k))) / 6.0;
    }
    begin = end;
  }
  EXPECT_NEAR(volume[1], 8.0 * 0.01 * 0.02 * 0.03, 1e-15);
  const double circle = 0.5 * 16 * std::sin(2.0 * std::numbers::pi / 16) * 0.01 * 0.01;
  EXPECT_NEAR(volume[2], circle * 0.04, 1e-15);
}

TEST_F(DemVtk, FacesMoveAsTheirMiddlesDo) {
  write(mixed());
  const XmlElement solids = read("solids_000007.vtp");
  const std::vector<double> velocity = array(solids, "velocity_m_s");
  const std::vector<double> speed = array(solids, "speed_m_s");
  // v + omega x arm: the six middles lie at +- 0.01 x, +- 0.02 y, +- 0.03 z.
  std::multiset<std::pair<long, long>> found;
  for (std::size_t k = 0; k < 6; ++k) {
    found.emplace(std::lround(1e6 * velocity[3 * k]), std::lround(1e6 * velocity[3 * k + 1]));
    EXPECT_EQ(velocity[3 * k + 2], 0.0);
    EXPECT_NEAR(speed[k], std::hypot(velocity[3 * k], velocity[3 * k + 1]), 1e-15);
  }
  EXPECT_THAT(found, ElementsAre(std::pair(800000L, 0L), std::pair(1000000L, -100000L),
                                 std::pair(1000000L, 0L), std::pair(1000000L, 0L),
                                 std::pair(1000000L, 100000L), std::pair(1200000L, 0L)));
  for (std::size_t k = 6; k < speed.size(); ++k) EXPECT_EQ(speed[k], 0.0);
}

TEST_F(DemVtk, OnlyKindsThatAreThereHaveFiles) {
  dem::Scene scene = mixed();
  scene.bodies.erase(scene.bodies.begin());
  write(scene);
  EXPECT_EQ(count(), 4u);
  EXPECT_TRUE(fs::exists(folder_ / "solids.pvd"));
  EXPECT_FALSE(fs::exists(folder_ / "spheres.pvd"));
  const XmlElement series = read("solids.pvd");
  EXPECT_EQ(series.all("DataSet").at(0)->attribute("file"), "solids_000007.vtp");
  EXPECT_EQ(series.all("DataSet").at(0)->attribute("timestep"), "0.007");
}

}  // namespace
}  // namespace conebench::test
