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
#include "tests/dem/step_solver_helper.h"

namespace conebench::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// A folder of its own for the running test, removed at the end.
class Files : public testing::Test {
 protected:
  Files() {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() / (std::string("conebench-dem-") + info->name());
    fs::remove_all(folder_);
  }
  ~Files() override { fs::remove_all(folder_); }

  static std::string read(const fs::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  std::size_t count() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder_), fs::directory_iterator{}));
  }

  fs::path folder_;
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
  dem::Exporter exporter(folder_, engine::parse_selection("every:10"));
  simulation.add_observer(std::ref(exporter));
  simulation.run(60);
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

TEST_F(Files, SelectionsPickTheirSteps) {
  EXPECT_TRUE(engine::parse_selection("all").contains(17));
  const auto range = engine::parse_selection("10..20");
  EXPECT_FALSE(range.contains(9));
  EXPECT_TRUE(range.contains(10) && range.contains(20));
  EXPECT_FALSE(range.contains(21));
  for (const char* wrong : {"every:0", "every:x", "20..10", "-1..3", "none", ""}) {
    EXPECT_THROW(engine::parse_selection(wrong), problems::InputError) << wrong;
  }
}

TEST_F(Files, UnwritableFolderIsAnOutputError) {
  std::ofstream(folder_) << "a file, not a folder";
  EXPECT_THROW(dem::Exporter(folder_ / "in", {}), problems::OutputError);
  EXPECT_THROW(dem::VtkWriter(folder_ / "in", 1e-3, 1), problems::OutputError);
}

TEST_F(Files, VtkHoldsOneSeriesOfSpheresAndOneOfContacts) {
  dem::Simulation simulation(falling(), small_solver());
  dem::VtkWriter writer(folder_, 1e-3, 20);
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
  dem::Simulation simulation(scene, small_solver());
  const std::vector<dem::Frame> frames{dem::make_frame(simulation.spheres(), 0.0)};
  const dem::View view = dem::fit_view(scene, frames);
  EXPECT_NEAR((view.axes * view.axes.transpose() - Eigen::Matrix3d::Identity()).norm(), 0.0, 1e-14);
  EXPECT_NEAR(view.axes.determinant(), 1.0, 1e-14);
  const std::string svg = dem::draw_svg(scene, frames[0], view);
  std::size_t circles = 0;
  for (auto at = svg.find("<circle"); at != std::string::npos; at = svg.find("<circle", at + 1)) {
    ++circles;
  }
  EXPECT_EQ(circles, 5u);
  EXPECT_THAT(svg, HasSubstr("stack"));
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

}  // namespace
}  // namespace conebench::test
