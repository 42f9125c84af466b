#include "dem/svg_frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <numeric>

#include "problems/engine/svg.h"

namespace conebench::dem {
namespace {

constexpr int kColours = 32;
using engine::Colour;
using engine::hex;
using engine::viridis;

class Drawing {
 public:
  Drawing(const Scene& scene, const Frame& frame, const View& view)
      : scene_(scene), frame_(frame), view_(view), camera_(view) {}

  std::string draw() {
    out_ = engine::svg_start(camera_.height_px());
    define_colours();
    for (const Plane& plane : scene_.planes) {
      if (is_floor(plane)) draw_floor(plane);
    }
    draw_spheres();
    draw_caption();
    return std::move(out_) + "</svg>\n";
  }

 private:
  template <class... Args>
  void print(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(out_), format, std::forward<Args>(args)...);
  }

  // A ball with light from the upper left and a dark rim.
  void define_ball(std::string_view id, const Colour& base) {
    print(
        "<radialGradient id=\"{}\" cx=\"0.36\" cy=\"0.32\" r=\"0.72\"><stop offset=\"0\" "
        "stop-color=\"{}\"/><stop offset=\"0.45\" stop-color=\"{}\"/><stop offset=\"1\" "
        "stop-color=\"{}\"/></radialGradient>\n",
        id, hex(0.5 * base + Colour::Constant(127.0)), hex(base), hex(0.55 * base));
  }

  void define_colours() {
    out_ += "<defs>\n";
    for (int k = 0; k < kColours; ++k) {
      define_ball(fmt::format("s{}", k), viridis(k / (kColours - 1.0)));
    }
    define_ball("fixed", Colour(200, 206, 210));
    out_ += engine::scale_gradient() + "</defs>\n";
  }

  bool is_floor(const Plane& plane) const {
    return frame_.time_s < plane.until_s && view_.axes.row(1).dot(plane.normal) > 0.3 &&
           view_.axes.row(2).dot(plane.normal) > 0.0;
  }

  // The part of the plane below what is shown, and the shadow of every sphere on it.
  void draw_floor(const Plane& plane) {
    const Eigen::Vector3d right =
        Eigen::Vector3d(view_.axes.row(2)).cross(plane.normal).normalized() * -1.0;
    const Eigen::Vector3d away = plane.normal.cross(right);
    Eigen::AlignedBox2d patch;
    for (int k = 0; k < 8; ++k) {
      const Eigen::Vector3d corner(k & 1 ? view_.high[0] : view_.low[0],
                                   k & 2 ? view_.high[1] : view_.low[1],
                                   k & 4 ? view_.high[2] : view_.low[2]);
      const Eigen::Vector3d x = view_.axes.transpose() * corner - plane.point_m;
      patch.extend(Eigen::Vector2d(right.dot(x), away.dot(x)));
    }
    print("<polygon fill=\"#eceff1\" stroke=\"#b0bec5\" points=\"");
    using Box = Eigen::AlignedBox2d;
    for (const auto corner : {Box::BottomLeft, Box::BottomRight, Box::TopRight, Box::TopLeft}) {
      const Eigen::Vector2d place = patch.corner(corner);
      const Eigen::Vector2d at = camera_(plane.point_m + place[0] * right + place[1] * away);
      print("{:.1f},{:.1f} ", at[0], at[1]);
    }
    print("\"/>\n<g fill=\"#37474f\" fill-opacity=\"0.13\">\n");
    for (std::size_t i = 0; i < frame_.positions.size(); ++i) {
      if (!frame_.fixed[i]) draw_shadow(plane, i);
    }
    out_ += "</g>\n";
  }

  void draw_shadow(const Plane& plane, std::size_t i) {
    const Eigen::Vector3d& x = frame_.positions[i];
    const double height = plane.normal.dot(x - plane.point_m);
    const Eigen::Vector2d at = camera_(x - height * plane.normal);
    const double radius = camera_.scale() * frame_.radii[i];
    const double flat = view_.axes.row(2).dot(plane.normal);
    const double turn =
        std::atan2(-view_.axes.row(0).dot(plane.normal), view_.axes.row(1).dot(plane.normal));
    print(
        "<ellipse cx=\"{0:.1f}\" cy=\"{1:.1f}\" rx=\"{2:.1f}\" ry=\"{3:.1f}\" "
        "transform=\"rotate({4:.1f} {0:.1f} {1:.1f})\"/>\n",
        at[0], at[1], radius, radius * flat, -turn * 180.0 / std::numbers::pi);
  }

  void draw_spheres() {
    std::vector<std::size_t> order(frame_.positions.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return camera_.depth(frame_.positions[a]) < camera_.depth(frame_.positions[b]);
    });
    for (const std::size_t i : order) {
      const Eigen::Vector2d at = camera_(frame_.positions[i]);
      if (frame_.fixed[i]) {
        print("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" fill=\"url(#fixed)\"/>\n", at[0],
              at[1], camera_.scale() * frame_.radii[i]);
        continue;
      }
      const double share = std::clamp(frame_.speeds[i] / view_.fastest_m_s, 0.0, 1.0);
      print("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" fill=\"url(#s{})\"/>\n", at[0], at[1],
            camera_.scale() * frame_.radii[i], std::lround(share * (kColours - 1)));
    }
  }

  void draw_caption() {
    const bool held = std::any_of(scene_.planes.begin(), scene_.planes.end(), [&](const auto& p) {
      return std::isfinite(p.until_s) && frame_.time_s < p.until_s;
    });
    out_ += engine::caption(
        {.title = scene_.name,
         .moment = fmt::format("t = {:.3f} s{}", frame_.time_s, held ? ", held by walls" : ""),
         .meaning = "speed",
         .end = fmt::format("{:.2g} m/s", view_.fastest_m_s)});
  }

  const Scene& scene_;
  const Frame& frame_;
  const View& view_;
  engine::Camera camera_;
  std::string out_;
};

}  // namespace

Frame make_frame(const Spheres& spheres, double time_s) {
  Frame frame{time_s, spheres.position, spheres.radius, {}, {}};
  for (const Eigen::Vector3d& v : spheres.velocity) frame.speeds.push_back(v.norm());
  for (const int dof : spheres.first_dof) frame.fixed.push_back(dof < 0);
  return frame;
}

std::string draw_svg(const Scene& scene, const Frame& frame, const View& view) {
  return Drawing(scene, frame, view).draw();
}

View fit_view(const Scene& scene, std::span<const Frame> frames) {
  View view;
  view.axes = engine::oblique_axes(scene.gravity_m_s2);
  view.low.setConstant(std::numeric_limits<double>::infinity());
  view.high = -view.low;
  double fastest = 0.0;
  for (const Frame& frame : frames) {
    for (std::size_t i = 0; i < frame.positions.size(); ++i) {
      if (frame.fixed[i]) continue;
      const Eigen::Vector3d at = view.axes * frame.positions[i];
      const auto reach = Eigen::Vector3d::Constant(1.1 * frame.radii[i]);
      view.low = view.low.cwiseMin(at - reach);
      view.high = view.high.cwiseMax(at + reach);
      fastest = std::max(fastest, frame.speeds[i]);
    }
  }
  if (fastest > 0.0) view.fastest_m_s = fastest;
  view.widen();
  return view;
}

}  // namespace conebench::dem
