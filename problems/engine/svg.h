#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>

namespace conebench::engine {

/// Red, green, blue, 0 to 255.
using Colour = Eigen::Vector3d;

/// Viridis, which colour-blind readers can read, at t in [0, 1]; clamped.
Colour viridis(double t);

/// "#rrggbb".
std::string hex(const Colour& colour);

/// Text as it may stand between tags.
std::string escaped(std::string_view text);

/// Where the eye is and what it sees, in parallel projection.
struct Window {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< rows: right, up, towards the eye
  Eigen::Vector3d low = Eigen::Vector3d::Zero();       ///< corner of what is shown, in axes [m]
  Eigen::Vector3d high = Eigen::Vector3d::Ones();      ///< opposite corner [m]

  /// Adds room at both sides until it is at least 1.4 times as wide as high.
  void widen();
};

/// Axes straight along +y (+x where that is up), up against gravity (z without gravity).
Eigen::Matrix3d level_axes(const Eigen::Vector3d& gravity);

/// Axes along +y, slightly from the side and from above: level_axes() turned.
Eigen::Matrix3d oblique_axes(const Eigen::Vector3d& gravity);

/// World to picture, below the room that caption() takes.
class Camera {
 public:
  explicit Camera(const Window& window);

  double scale() const { return scale_; }  ///< [px/m]
  double width_px() const;                 ///< of the whole picture
  double height_px() const;                ///< of the whole picture
  /// Towards the eye [m].
  double depth(const Eigen::Vector3d& x) const { return window_.axes.row(2).dot(x); }
  Eigen::Vector2d operator()(const Eigen::Vector3d& x) const;
  /// The same, and the depth, to the same scale [px].
  Eigen::Vector3d place(const Eigen::Vector3d& x) const;

 private:
  Window window_;
  double scale_;
};

/// The first tags of a picture of this height; close it with "</svg>\n".
std::string svg_start(double height_px);

/// The gradient "scale" that caption() refers to; it belongs between <defs> and </defs>.
std::string scale_gradient();

struct Caption {
  std::string title;         ///< the scene
  std::string moment;        ///< "t = 0.100 s"
  std::string meaning, end;  ///< of the colour scale, which starts at 0, and its end with unit
};
std::string caption(const Caption& caption);

}  // namespace conebench::engine
