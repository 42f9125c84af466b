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

constexpr double kWidth_px = 800.0;
constexpr double kMargin_px = 24.0;
constexpr double kCaption_px = 64.0;
constexpr double kAspect = 1.4;  // of the window, at least
constexpr int kColours = 32;
constexpr double kSide_rad = 24.0 * std::numbers::pi / 180.0;
constexpr double kAbove_rad = 14.0 * std::numbers::pi / 180.0;

using engine::Colour;
using engine::escaped;
using engine::hex;
using engine::viridis;

// World to picture.
class Camera {
 public:
  explicit Camera(const View& view) : view_(view) {
    scale_ = (kWidth_px - 2.0 * kMargin_px) / (view.high[0] - view.low[0]);
  }

  double scale() const { return scale_; }
  double height_px() const {
    return scale_ * (view_.high[1] - view_.low[1]) + 2.0 * kMargin_px + kCaption_px;
  }
  double depth(const Eigen::Vector3d& x) const { return view_.axes.row(2).dot(x); }

  Eigen::Vector2d operator()(const Eigen::Vector3d& x) const {
    const Eigen::Vector2d at = (view_.axes * x).head<2>();
    return {kMargin_px + scale_ * (at[0] - view_.low[0]),
            kMargin_px + kCaption_px + scale_ * (view_.high[1] - at[1])};
  }

 private:
  const View& view_;
  double scale_;
};

class Drawing {
 public:
  Drawing(const Scene& scene, const Frame& frame, const View& view)
      : scene_(scene), frame_(frame), view_(view), camera_(view) {}

  std::string draw() {
    print(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:.0f} {:.0f}\" "
        "font-family=\"sans-serif\" font-size=\"20\">\n"
        "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n",
        kWidth_px, camera_.height_px());
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
    out_ += "<linearGradient id=\"scale\">\n";
    for (int k = 0; k <= 8; ++k) {
      print("<stop offset=\"{}\" stop-color=\"{}\"/>\n", k / 8.0, hex(viridis(k / 8.0)));
    }
    out_ += "</linearGradient>\n</defs>\n";
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
    print("<text x=\"{:.0f}\" y=\"36\" font-weight=\"bold\" fill=\"#263238\">{}</text>\n",
          kMargin_px, escaped(scene_.name));
    print("<text x=\"{:.0f}\" y=\"62\" fill=\"#455a64\">t = {:.3f} s{}</text>\n", kMargin_px,
          frame_.time_s, held ? ", held by walls" : "");
    const double left = kWidth_px - kMargin_px - 220.0;
    print("<rect x=\"{:.0f}\" y=\"22\" width=\"220\" height=\"14\" fill=\"url(#scale)\"/>\n", left);
    print(
        "<g font-size=\"16\" fill=\"#455a64\"><text x=\"{:.0f}\" y=\"56\">0</text>"
        "<text x=\"{:.0f}\" y=\"56\" text-anchor=\"middle\">speed</text>"
        "<text x=\"{:.0f}\" y=\"56\" text-anchor=\"end\">{:.2g} m/s</text></g>\n",
        left, left + 110.0, left + 220.0, view_.fastest_m_s);
  }

  const Scene& scene_;
  const Frame& frame_;
  const View& view_;
  Camera camera_;
  std::string out_;
};

// Rows right, up, towards the eye.
Eigen::Matrix3d view_axes(const Eigen::Vector3d& gravity) {
  const Eigen::Vector3d up =
      gravity.norm() > 0.0 ? Eigen::Vector3d(-gravity.normalized()) : Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d ahead =
      std::abs(up.y()) < 0.9 ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitX();
  const Eigen::Vector3d right = ahead.cross(up).normalized();
  const Eigen::Vector3d front = right.cross(up).normalized();  // towards the eye, level
  const Eigen::Vector3d level = std::cos(kSide_rad) * front + std::sin(kSide_rad) * right;
  const Eigen::Vector3d eye = std::cos(kAbove_rad) * level + std::sin(kAbove_rad) * up;
  Eigen::Matrix3d axes;
  axes.row(2) = eye;
  axes.row(0) = up.cross(eye).normalized();
  axes.row(1) = eye.cross(Eigen::Vector3d(axes.row(0)));
  return axes;
}

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
  view.axes = view_axes(scene.gravity_m_s2);
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
  const double missing = kAspect * (view.high[1] - view.low[1]) - (view.high[0] - view.low[0]);
  view.low[0] -= 0.5 * std::max(missing, 0.0);
  view.high[0] += 0.5 * std::max(missing, 0.0);
  return view;
}

}  // namespace conebench::dem
