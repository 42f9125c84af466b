#include "problems/engine/svg.h"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace conebench::engine {
namespace {

constexpr double kWidth_px = 800.0;
constexpr double kMargin_px = 24.0;
constexpr double kCaption_px = 64.0;
constexpr double kAspect = 1.4;  // of the window, at least
constexpr double kSide_rad = 24.0 * std::numbers::pi / 180.0;
constexpr double kAbove_rad = 14.0 * std::numbers::pi / 180.0;

}  // namespace

// At nine equally spaced places (matplotlib's table, CC0), interpolated in between.
Colour viridis(double t) {
  static const std::array<Colour, 9> kTable = {
      Colour(68, 1, 84),    Colour(71, 45, 123),  Colour(59, 82, 139),
      Colour(44, 114, 142), Colour(33, 145, 140), Colour(40, 174, 128),
      Colour(94, 201, 98),  Colour(173, 220, 48), Colour(253, 231, 37)};
  const double place = std::clamp(t, 0.0, 1.0) * 8.0;
  const auto low = std::min<std::size_t>(7, static_cast<std::size_t>(place));
  const double share = place - static_cast<double>(low);
  return (1.0 - share) * kTable[low] + share * kTable[low + 1];
}

std::string hex(const Colour& colour) {
  return fmt::format("#{:02x}{:02x}{:02x}", std::lround(colour[0]), std::lround(colour[1]),
                     std::lround(colour[2]));
}

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) out += c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
  return out;
}

void Window::widen() {
  const double missing = kAspect * (high[1] - low[1]) - (high[0] - low[0]);
  low[0] -= 0.5 * std::max(missing, 0.0);
  high[0] += 0.5 * std::max(missing, 0.0);
}

Eigen::Matrix3d level_axes(const Eigen::Vector3d& gravity) {
  const Eigen::Vector3d up =
      gravity.norm() > 0.0 ? Eigen::Vector3d(-gravity.normalized()) : Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d ahead =
      std::abs(up.y()) < 0.9 ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitX();
  Eigen::Matrix3d axes;
  axes.row(0) = ahead.cross(up).normalized();
  axes.row(1) = up;
  axes.row(2) = axes.row(0).cross(axes.row(1));
  return axes;
}

Eigen::Matrix3d oblique_axes(const Eigen::Vector3d& gravity) {
  const Eigen::Matrix3d level = level_axes(gravity);
  const Eigen::Vector3d right = level.row(0), up = level.row(1), front = level.row(2);
  const Eigen::Vector3d beside = std::cos(kSide_rad) * front + std::sin(kSide_rad) * right;
  const Eigen::Vector3d eye = std::cos(kAbove_rad) * beside + std::sin(kAbove_rad) * up;
  Eigen::Matrix3d axes;
  axes.row(2) = eye;
  axes.row(0) = up.cross(eye).normalized();
  axes.row(1) = eye.cross(Eigen::Vector3d(axes.row(0)));
  return axes;
}

Camera::Camera(const Window& window)
    : window_(window), scale_((kWidth_px - 2.0 * kMargin_px) / (window.high[0] - window.low[0])) {}

double Camera::width_px() const { return kWidth_px; }

double Camera::height_px() const {
  return scale_ * (window_.high[1] - window_.low[1]) + 2.0 * kMargin_px + kCaption_px;
}

Eigen::Vector2d Camera::operator()(const Eigen::Vector3d& x) const {
  const Eigen::Vector2d at = (window_.axes * x).head<2>();
  return {kMargin_px + scale_ * (at[0] - window_.low[0]),
          kMargin_px + kCaption_px + scale_ * (window_.high[1] - at[1])};
}

Eigen::Vector3d Camera::place(const Eigen::Vector3d& x) const {
  const Eigen::Vector2d at = (*this)(x);
  return {at[0], at[1], scale_ * depth(x)};
}

std::string svg_start(double height_px) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:.0f} {:.0f}\" "
      "font-family=\"sans-serif\" font-size=\"20\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n",
      kWidth_px, height_px);
}

std::string scale_gradient() {
  std::string out = "<linearGradient id=\"scale\">\n";
  for (int k = 0; k <= 8; ++k) {
    out += fmt::format("<stop offset=\"{}\" stop-color=\"{}\"/>\n", k / 8.0, hex(viridis(k / 8.0)));
  }
  return out + "</linearGradient>\n";
}

std::string caption(const Caption& caption) {
  const double left = kWidth_px - kMargin_px - 220.0;
  return fmt::format(
      "<text x=\"{0:.0f}\" y=\"36\" font-weight=\"bold\" fill=\"#263238\">{2}</text>\n"
      "<text x=\"{0:.0f}\" y=\"62\" fill=\"#455a64\">{3}</text>\n"
      "<rect x=\"{1:.0f}\" y=\"22\" width=\"220\" height=\"14\" fill=\"url(#scale)\"/>\n"
      "<g font-size=\"16\" fill=\"#455a64\"><text x=\"{1:.0f}\" y=\"56\">0</text>"
      "<text x=\"{4:.0f}\" y=\"35\" text-anchor=\"end\">{6}</text>"
      "<text x=\"{5:.0f}\" y=\"56\" text-anchor=\"end\">{7}</text></g>\n",
      kMargin_px, left, escaped(caption.title), caption.moment, left - 10.0, left + 220.0,
      caption.meaning, caption.end);
}

}  // namespace conebench::engine
