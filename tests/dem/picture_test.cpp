// Pictures of bodies, as SVG.

#include <gmock/gmock.h>

#include "dem/svg_frame.h"
#include "tests/dem/scene_helper.h"
#include "tests/engine/xml.h"

namespace conebench::test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::Each;
using testing::HasSubstr;
using testing::SizeIs;

// A box, a capsule and a compound of two boxes side by side on a floor.
dem::Scene three_bodies() {
  dem::Scene scene = small_scene({.friction = 0.5});
  add_floor(scene);
  add_shape(scene, "box", dem::Box{{0.02, 0.02, 0.03}});
  add_shape(scene, "capsule", dem::Capsule{0.01, 0.02});
  add_shape(scene, "compound", dem::Box{{0.03, 0.01, 0.01}});
  scene.shapes.back().parts.push_back(
      {dem::Box{{0.01, 0.01, 0.01}}, {-0.02, 0.0, 0.02}, Vector3d::Zero(), {}});
  add_body(scene, {-0.1, 0.0, 0.03}, "box");
  add_body(scene, {0.0, 0.0, 0.03}, "capsule").velocity_m_s = {0.5, 0.0, 0.0};
  add_body(scene, {0.1, 0.0, 0.01}, "compound").velocity_m_s = {1.0, 0.0, 0.0};
  return scene;
}

struct Picture {
  explicit Picture(const dem::Scene& scene)
      : start(dem::place_bodies(scene, scene.name)),
        frame{0.0, start.bodies},
        view(dem::fit_view(scene, start.solids, {&frame, 1})),
        text(dem::draw_svg(scene, start, frame, view)),
        svg(parse_xml(text)) {}

  // What is drawn of bodies, and on floors.
  const XmlElement& bodies() const { return svg.find("g", "stroke-width", "0.8"); }
  const XmlElement& shadows() const { return svg.find("g", "opacity", "0.16"); }

  dem::Placement start;
  dem::Frame frame;
  dem::View view;
  std::string text;
  XmlElement svg;
};

Vector3d colour(const std::string& hex) {
  const auto part = [&](std::size_t at) { return std::stoi(hex.substr(at, 2), nullptr, 16); };
  return {static_cast<double>(part(1)), static_cast<double>(part(3)), static_cast<double>(part(5))};
}

// Whether shading, which makes a colour lighter or darker, can make `found` of `base`.
bool is_shade(const Vector3d& base, const Vector3d& found) {
  const Vector3d lit = 0.5 * base + Vector3d::Constant(127.0), dark = 0.55 * base;
  return ((found - dark).array() > -1.5).all() && ((lit - found).array() > -1.5).all();
}

std::vector<Vector2d> corners(const XmlElement& polygon) {
  const std::vector<double> numbers = numbers_in(polygon.attribute("points"));
  std::vector<Vector2d> out;
  for (std::size_t k = 0; k + 1 < numbers.size(); k += 2)
    out.emplace_back(numbers[k], numbers[k + 1]);
  return out;
}

double width_of(const XmlElement& polygon) {
  double low = 1e9, high = -1e9;
  for (const Vector2d& x : corners(polygon)) {
    low = std::min(low, x[0]);
    high = std::max(high, x[0]);
  }
  return high - low;
}

TEST(Picture, ShowsThreeFacesABoxAndAShadowAPart) {
  const Picture picture(three_bodies());
  EXPECT_THAT(picture.text, Not(HasSubstr("nan")));
  EXPECT_THAT(picture.text, Not(HasSubstr("inf")));
  EXPECT_THAT(picture.bodies().all("polygon"), SizeIs(9));   // of three boxes
  EXPECT_THAT(picture.shadows().all("polygon"), SizeIs(4));  // of four parts
  EXPECT_THAT(picture.svg.all("polygon"), SizeIs(14));       // and the floor
  EXPECT_FALSE(picture.bodies().all("path").empty());        // the capsule
}

TEST(Picture, ColoursBodiesByTheirSpeed) {
  const Picture picture(three_bodies());
  EXPECT_EQ(picture.view.fastest_m_s, 1.0);
  int at_rest = 0, fast = 0;
  for (const XmlElement* polygon : picture.bodies().all("polygon")) {
    const Vector3d fill = colour(polygon->attribute("fill"));
    if (is_shade(engine::viridis(0.0), fill)) ++at_rest;
    if (is_shade(engine::viridis(1.0), fill)) ++fast;
  }
  EXPECT_EQ(at_rest, 3);
  EXPECT_EQ(fast, 6);
  for (const XmlElement* path : picture.bodies().all("path")) {
    EXPECT_TRUE(is_shade(engine::viridis(0.5), colour(path->attribute("stroke"))));
  }
}

// A free body at rest in numbers only is not painted as the fastest of all.
TEST(Picture, NoiseIsNotSpeed) {
  dem::Scene scene = three_bodies();
  scene.gravity_m_s2 = {0.0, 0.0, -9.81};
  for (dem::Body& body : scene.bodies) body.velocity_m_s *= 1e-9;
  const Picture picture(scene);
  for (const XmlElement* polygon : picture.bodies().all("polygon")) {
    EXPECT_TRUE(is_shade(engine::viridis(0.0), colour(polygon->attribute("fill"))));
  }
}

TEST(Picture, LightComesFromAbove) {
  const Picture picture(three_bodies());
  const XmlElement* top = nullptr;  // of the box at rest: the face with the highest middle
  double highest = 1e9, brightest = 0.0;
  for (const XmlElement* polygon : picture.bodies().all("polygon")) {
    const Vector3d fill = colour(polygon->attribute("fill"));
    if (!is_shade(engine::viridis(0.0), fill)) continue;
    double middle = 0.0;
    for (const Vector2d& x : corners(*polygon)) middle += 0.25 * x[1];
    brightest = std::max(brightest, fill.sum());
    if (middle < highest) {
      highest = middle;
      top = polygon;
    }
  }
  ASSERT_NE(top, nullptr);
  EXPECT_EQ(colour(top->attribute("fill")).sum(), brightest);
}

TEST(Picture, FixedAndDrivenBodiesAreGreyAndCastNoShadow) {
  dem::Scene scene = three_bodies();
  scene.motions.push_back({"slide", dem::Slide{{1.0, 0.0, 0.0}, 0.0, 1.0}});
  scene.bodies[0].fixed = true;
  scene.bodies[2].motion = "slide";
  scene.bodies[2].velocity_m_s.setZero();
  const Picture picture(scene);
  ASSERT_THAT(picture.bodies().all("polygon"), SizeIs(9));
  for (const XmlElement* polygon : picture.bodies().all("polygon")) {
    EXPECT_TRUE(is_shade({200.0, 206.0, 210.0}, colour(polygon->attribute("fill"))));
  }
  EXPECT_THAT(picture.shadows().all("polygon"), SizeIs(1));
}

// Four walls about a ball: the two between it and the eye are glass, the others are not; a fifth
// one, in front of nothing, is not either.
TEST(Picture, WallsBeforeFreeBodiesAreGlass) {
  dem::Scene scene = small_scene({.friction = 0.5});
  add_floor(scene);
  add_shape(scene, "along", dem::Box{{0.05, 0.005, 0.05}});
  add_shape(scene, "across", dem::Box{{0.005, 0.04, 0.05}});
  add_body(scene, {0.0, 0.0, 0.03}, 0.02);
  add_body(scene, {0.0, -0.05, 0.05}, "along").fixed = true;
  add_body(scene, {0.0, 0.05, 0.05}, "along").fixed = true;
  add_body(scene, {-0.06, 0.0, 0.05}, "across").fixed = true;
  add_body(scene, {0.2, -0.1, 0.05}, "along").fixed = true;
  const Picture picture(scene);
  EXPECT_EQ(picture.view.glass, (std::vector<bool>{false, true, false, false, false}));
  int glass = 0, opaque = 0;
  for (const XmlElement* polygon : picture.bodies().all("polygon")) {
    ++(polygon->attribute("fill-opacity").empty() ? opaque : glass);
  }
  EXPECT_EQ(glass, 3);
  EXPECT_EQ(opaque, 9);
}

// A plate before the ball and one behind it, as one body: that behind it is not glass.
TEST(Picture, OnlyThePartsBeforeFreeBodiesAreGlass) {
  dem::Scene scene = small_scene({.friction = 0.5});
  add_shape(scene, "plates", dem::Box{{0.03, 0.005, 0.03}});
  dem::ScenePart behind = scene.shapes.back().parts[0];
  behind.position_m = {0.0, 0.06, 0.0};
  scene.shapes.back().parts.push_back(behind);
  add_body(scene, {0.0, 0.0, 0.03}, 0.02);
  add_body(scene, {0.0, -0.03, 0.03}, "plates").fixed = true;
  const Picture picture(scene);
  const std::vector<const XmlElement*> faces = picture.bodies().all("polygon");
  ASSERT_THAT(faces, SizeIs(6));
  for (std::size_t k = 0; k < 6; ++k) {  // far ones first
    EXPECT_EQ(faces[k]->attribute("fill-opacity").empty(), k < 3);
  }
}

TEST(Picture, BothSidesOfAMeshAreSeen) {
  dem::Scene scene = small_scene({.friction = 0.5});
  const std::vector<Vector3d> square{
      {-0.04, -0.04, 0.0}, {0.04, -0.04, 0.0}, {0.04, 0.04, 0.0}, {-0.04, 0.04, 0.0}};
  add_shape(scene, "up", dem::Mesh{square, {{0, 1, 2}, {0, 2, 3}}});
  add_shape(scene, "down", dem::Mesh{square, {{0, 2, 1}, {0, 3, 2}}});
  add_body(scene, {0.0, 0.0, 0.05}, 0.02);
  add_body(scene, {0.0, 0.0, 0.0}, "up").fixed = true;
  const Picture up(scene);
  scene.bodies[1].shape = "down";
  const Picture down(scene);
  EXPECT_THAT(up.bodies().all("polygon"), SizeIs(2));
  EXPECT_THAT(down.bodies().all("polygon"), SizeIs(2));
}

TEST(Picture, LooksStraightAlongYInTwoDimensions) {
  dem::Scene scene = three_bodies();
  scene.dimension = 2;
  const Picture picture(scene);
  EXPECT_NEAR((picture.view.axes.row(2).transpose() + Vector3d::UnitY()).norm(), 0.0, 1e-15);
  EXPECT_THAT(picture.bodies().all("polygon"), SizeIs(3));  // of three boxes
  EXPECT_THAT(picture.svg.all("polygon"), SizeIs(4));       // and the ground
  const double scale = engine::Camera(picture.view).scale();
  std::vector<double> widths;
  for (const XmlElement* polygon : picture.bodies().all("polygon")) {
    widths.push_back(width_of(*polygon));
  }
  std::sort(widths.begin(), widths.end());
  EXPECT_NEAR(widths[0], 0.02 * scale, 0.11);  // coordinates are rounded to 0.1 px
  EXPECT_NEAR(widths[1], 0.04 * scale, 0.11);
  EXPECT_NEAR(widths[2], 0.06 * scale, 0.11);
}

// The shadow of a ball that touches the floor begins below the ball; a floor that has gone down
// takes it along.
TEST(Picture, FloorsAreWhereTheyAreNow) {
  dem::Scene scene = small_scene({.friction = 0.5});
  add_floor(scene);
  add_body(scene, {0.0, 0.0, 0.02}, 0.02);
  Picture picture(scene);
  const auto shadow_y = [&](const std::string& text) {
    return std::stod(parse_xml(text).all("ellipse").at(0)->attribute("cy"));
  };
  const double before = shadow_y(picture.text);
  picture.frame.bodies.position.back().z() -= 0.01;
  const double after = shadow_y(dem::draw_svg(scene, picture.start, picture.frame, picture.view));
  // The light leaves the level of the ball's middle, 0.02 above the floor, then 0.03.
  const engine::Camera camera(picture.view);
  const Vector3d light = picture.view.axes.transpose() * Vector3d(-0.40, 0.80, 0.45).normalized();
  const auto cast_y = [&](double height) {
    return camera(Vector3d(0.0, 0.0, 0.02) - height / light.z() * light)[1];
  };
  EXPECT_NEAR(before, cast_y(0.02), 0.051);  // rounded to 0.1 px
  EXPECT_NEAR(after, cast_y(0.03), 0.051);
}

TEST(Picture, HoldsFreeBodiesOfAllFramesAndSolidsOfTheirSize) {
  dem::Scene scene = three_bodies();
  add_shape(scene, "post", dem::Box{{0.01, 0.01, 0.1}});
  add_shape(scene, "ground", dem::Box{{5.0, 5.0, 0.1}});
  add_body(scene, {-0.2, 0.0, 0.1}, "post").fixed = true;
  add_body(scene, {0.0, 0.0, -0.11}, "ground").fixed = true;
  const dem::Placement start = dem::place_bodies(scene, "scene");
  std::vector<dem::Frame> frames(2, {0.0, start.bodies});
  frames[1].bodies.position[0].x() += 0.4;
  const dem::View view = dem::fit_view(scene, start.solids, frames);
  const auto is_shown = [&](const Vector3d& x) {
    const Vector3d at = view.axes * x;
    return (at.array() > view.low.array()).all() && (at.array() < view.high.array()).all();
  };
  EXPECT_TRUE(is_shown({-0.12, -0.02, 0.0}));  // corners of the box, in both frames
  EXPECT_TRUE(is_shown({0.32, 0.02, 0.06}));
  EXPECT_TRUE(is_shown({-0.21, 0.0, 0.2}));   // of the post
  EXPECT_FALSE(is_shown({4.9, 4.9, -0.05}));  // of the ground
}

TEST(Picture, ATowerOfAHundredPlanksIsASmallFile) {
  dem::Scene scene = small_scene({.friction = 0.5});
  add_floor(scene);
  add_shape(scene, "plank", dem::Box{{0.0585, 0.0117, 0.0039}});
  for (int k = 0; k < 100; ++k) {
    const int level = k / 4;
    const double aside = 0.03 * (k % 4) - 0.045, height = 0.0039 + 0.0078 * level;
    if (level % 2 == 0) {
      add_body(scene, {0.0, aside, height}, "plank");
    } else {
      add_body(scene, {aside, 0.0, height}, "plank").rotation_rad = {0.0, 0.0,
                                                                     std::numbers::pi / 2};
    }
  }
  const Picture picture(scene);
  EXPECT_THAT(picture.bodies().all("polygon"), SizeIs(300));
  EXPECT_LT(picture.text.size(), 200'000u);
}

TEST(Picture, RoundBodiesHaveAsManyFacetsAsTheyNeed) {
  const auto polygons = [](double beside_m) {
    dem::Scene scene = small_scene({.friction = 0.5});
    add_shape(scene, "cylinder", dem::Cylinder{0.02, 0.02});
    add_body(scene, {0.0, 0.0, 0.0}, "cylinder");
    add_body(scene, {beside_m, 0.0, 0.0}, 0.02);
    return Picture(scene).bodies().all("polygon").size();
  };
  const std::size_t large = polygons(0.1), small = polygons(10.0);
  EXPECT_EQ(small, 7u);  // its top, and half of 12
  EXPECT_GT(large, 2 * small);
}

}  // namespace
}  // namespace conebench::test
