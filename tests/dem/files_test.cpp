// What the engine writes: problem files, ParaView files, pictures.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "dem/export.h"
#include "dem/simulation.h"
#include "dem/svg_frame.h"
#include "dem/vtk_writer.h"
#include "problems/error.h"
#include "problems/problem_file.h"
#include "problems/residual.h"
#include "tests/dem/scene_helper.h"
#include "tests/engine/own_folder.h"
#include "tests/engine/small_solver.h"
#include "tests/engine/xml.h"

namespace conebench::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Files : public OwnFolder {
 protected:
  static std::string read(const fs::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
  }
};

// Falls for 0.02 s, then lies on the floor with a bond; a second sphere lies beside it.
dem::Scene falling() {
  dem::Scene scene =
      small_scene({.friction = 0.5, .tensile_force_N = 0.2, .rupture_distance_m = 1e-4});
  scene.skin_m = 1e-3;
  add_floor(scene);
  add_body(scene, {0.0, 0.0, 0.023}, 0.02);
  return scene;
}

TEST_F(Files, ExportedProblemsReadBackWithGeometryGuessAndSolution) {
  dem::Simulation simulation(falling(), small_solver());
  dem::Exporter exporter(folder_, engine::parse_selection("every:10"), simulation.scene());
  simulation.add_observer(std::ref(exporter));
  simulation.run(60);
  exporter.finish();
  EXPECT_EQ(exporter.written() + exporter.without_contacts(), 6);
  EXPECT_GE(exporter.without_contacts(), 1);
  EXPECT_EQ(count(), static_cast<std::size_t>(exporter.written()));

  const auto file = problems::read_problem_file(folder_ / "small_000050.h5");
  EXPECT_EQ(file.problem.metadata().engine, "dem");
  EXPECT_EQ(file.problem.metadata().step, 50);
  EXPECT_EQ(file.problem.metadata().sampling_weight, 10.0);
  EXPECT_EQ(file.problem.metadata().step_size_s, 1e-3);
  EXPECT_DOUBLE_EQ(file.problem.cones()[0].kappa, 0.2e-3);
  ASSERT_TRUE(file.solution && file.geometry);
  const problems::Problem standard = file.problem.shifted();
  EXPECT_LT(problems::evaluate_eta(standard, file.solution->r), 1e-12);
  EXPECT_LT((standard.rate(file.solution->r) - file.solution->u).norm(), 1e-15);
  EXPECT_EQ(file.guess.size(), 3);
  EXPECT_EQ(file.geometry->bodies_of_cone(0, 0), 0);
  EXPECT_EQ(file.geometry->bodies_of_cone(0, 1), -1);
  EXPECT_NEAR(file.geometry->points(0, 2), 0.0, 1e-12);
  EXPECT_EQ(file.geometry->frames(0, 2), 1.0);
  EXPECT_EQ(file.geometry->body_radii[0], 0.02);
}

TEST_F(Files, UnwritableFolderIsAnOutputError) {
  std::ofstream(folder_) << "a file, not a folder";
  EXPECT_THROW(dem::Exporter(folder_ / "in", {}, falling()), problems::OutputError);
  EXPECT_THROW(dem::VtkWriter(folder_ / "in", 1e-3, {}, 1), problems::OutputError);
}

TEST_F(Files, VtkHoldsOneSeriesOfSpheresAndOneOfContacts) {
  dem::Simulation simulation(falling(), small_solver());
  dem::VtkWriter writer(folder_, 1e-3, simulation.placement(), 20);
  simulation.add_observer(std::ref(writer));
  simulation.run(60);
  writer.finish();
  EXPECT_EQ(count(), 8u);
  EXPECT_THAT(read(folder_ / "spheres.pvd"),
              HasSubstr("timestep=\"0.041\" part=\"0\" file=\"spheres_000040.vtp\""));
  const std::string spheres = read(folder_ / "spheres_000040.vtp");
  EXPECT_THAT(spheres, HasSubstr("NumberOfPoints=\"1\""));
  EXPECT_THAT(spheres, HasSubstr("Name=\"radius_m\""));
  EXPECT_THAT(read(folder_ / "contacts_000040.vtp"), HasSubstr("Name=\"force_N\""));
  EXPECT_THAT(read(folder_ / "contacts_000000.vtp"), HasSubstr("NumberOfPoints=\"0\""));
}

TEST_F(Files, PictureShowsEverySphereInsideItsWindow) {
  const dem::Scene scene = dem::load_scene("stack");
  const dem::Placement start = dem::place_bodies(scene, "stack");
  const dem::Frame frame{0.0, start.bodies};
  const dem::View view = dem::fit_view(scene, start.solids, {&frame, 1});
  EXPECT_NEAR((view.axes * view.axes.transpose() - Eigen::Matrix3d::Identity()).norm(), 0.0, 1e-14);
  EXPECT_NEAR(view.axes.determinant(), 1.0, 1e-14);
  const XmlElement svg = parse_xml(dem::draw_svg(scene, start, frame, view));
  const std::vector<const XmlElement*> circles = svg.all("circle");
  EXPECT_EQ(circles.size(), 5u);
  const std::vector<double> box = numbers_in(svg.attribute("viewBox"));
  for (const XmlElement* circle : circles) {
    const double x = std::stod(circle->attribute("cx")), y = std::stod(circle->attribute("cy"));
    const double r = std::stod(circle->attribute("r"));
    EXPECT_TRUE(x > r && x < box[2] - r && y > r && y < box[3] - r) << x << ", " << y;
  }
  EXPECT_EQ(svg.all("text").at(0)->text, "stack");
}

}  // namespace
}  // namespace conebench::test
