#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "dem/shape.h"

namespace conebench::dem {

/// Along a direction at one speed, from `from_s` until `until_s`; then it stays where it is.
struct Slide {
  Eigen::Vector3d velocity_m_s = Eigen::Vector3d::Zero();
  double from_s = 0.0;
  double until_s = 0.0;
};
/// About an axis at one rate, from `from_s` until `until_s`; then it stays where it is.
struct Turn {
  Eigen::Vector3d point_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitY();  ///< unit length
  double rate_rad_s = 0.0;
  double from_s = 0.0;
  double until_s = 0.0;
};
/// amplitude sin(2 pi frequency (t - from_s)), from `from_s` until `until_s`; then it stays where
/// it is.
struct Shake {
  Eigen::Vector3d amplitude_m = Eigen::Vector3d::Zero();
  double frequency_Hz = 0.0;
  double from_s = 0.0;
  double until_s = 0.0;
};
/// Places read from a file, joined by straight lines; the first before, the last after its times.
struct Table {
  std::filesystem::path file;
  Eigen::Vector3d point_m = Eigen::Vector3d::Zero();
  std::vector<double> t_s;  ///< increasing
  std::vector<Pose> poses;  ///< position: of the point, from its place at rest; orientation: of the
                            ///< body about it, joined by the shortest turn
};

struct Motion {
  std::string name;
  std::variant<Slide, Turn, Shake, Table> kind;

  /// Where what was at x at rest is at time t: displacement(t) * x. Identity for t <= from_s of the
  /// first three.
  Pose displacement(double t_s) const;
};

/// A velocity field: v(x) = velocity + rate x (x - about).
struct Twist {
  Eigen::Vector3d velocity_m_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d rate_rad_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d about_m = Eigen::Vector3d::Zero();

  Eigen::Vector3d at(const Eigen::Vector3d& x) const {
    return velocity_m_s + rate_rad_s.cross(x - about_m);
  }
};

/// The mean twist from t to t + h about the point that is at `about_m` at time t: that point gets
/// exactly to its place at t + h, and exp(h rate) is exactly the turn. Zero, without rounding,
/// while the motion rests. `h_s` > 0; a table must turn by less than pi in the step.
Twist mean_twist(const Motion& motion, double t_s, double h_s, const Eigen::Vector3d& about_m);

/// Reads a motion's table: comma-separated, a first line with the names of the columns
///
///   t_s,x_m,y_m,z_m    or    t_s,x_m,y_m,z_m,rx_rad,ry_rad,rz_rad
///
/// and then a line a time. (rx, ry, rz) is a rotation vector about `point_m`, not wrapped: from
/// line to line it changes by less than pi, so that the way from one to the next is the shortest
/// turn. Blank lines, spaces around numbers and both kinds of line ends are allowed.
///
/// Errors: InputError with `subject`, which is what errors call the scene's key, the file, and
/// where there is one line and column: unreadable file, other columns, a wrong count of numbers,
/// not a finite number, times that do not increase, a turn of pi or more, fewer than two lines.
Table read_table(const std::filesystem::path& file, const Eigen::Vector3d& point_m,
                 std::string_view subject);

}  // namespace conebench::dem
