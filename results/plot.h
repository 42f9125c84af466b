#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "results/bootstrap.h"
#include "results/shares.h"

namespace conebench::results {

/// What the numbers of an axis are, which says how they are written.
enum class Quantity {
  kShare,  ///< in [0, 1], written as a percentage
  kTime,   ///< [s], written with a prefix
  kRatio,  ///< [-]
  kEta,    ///< [-], written as a power of ten
  kCount,  ///< a number of things
  kName,   ///< the index of a category
};

enum class Scale { kLinear, kLog2, kLog10 };

struct Axis {
  std::string label{};  ///< with the unit: "solver time [s]"
  Quantity quantity = Quantity::kShare;
  Scale scale = Scale::kLinear;
  double low = 0.0, high = 1.0;           ///< > 0 on a logarithmic scale
  bool falling = false;                   ///< `high` is where the axis begins
  std::vector<std::string> categories{};  ///< of Quantity::kName: what 0, 1, ... are

  /// Where a value lies on the axis, from 0 to 1; values beyond it lie at its ends.
  double place(double value) const;
};

struct PlotPoint {
  double x = 0.0, y = 0.0;
  std::optional<Interval> x_interval{};
};

/// One solver's curve, or dots.
struct Series {
  std::string name{};
  std::string note{};     ///< in the legend: "48/82"
  std::size_t style = 0;  ///< colour and dash: the solver's place in the ranking
  std::vector<PlotPoint> points{};
  /// Of a performance profile: the solver's time on each problem [s], infinite where not solved,
  /// nothing where not run, for the page, which compares those that are shown.
  std::vector<std::optional<double>> times_s{};
};

enum class Mark {
  kSteps,  ///< constant from a point on, to the end of the axis
  kLines,  ///< points and straight lines between them
  kDots,   ///< dots with intervals, in rows: y is a category, give or take less than a half
};

/// Everything that is drawn of a plot: the page, SVG, LaTeX and CSV all show this.
struct Plot {
  std::string id{};       ///< unique in a report; plots of one id differ by their `choice`
  std::string choice{};   ///< "eta <= 1e-06": which of several plots of one id; else empty
  std::string title{};    ///< what is shown, in words
  std::string reading{};  ///< how to read it, a sentence or two
  Mark mark = Mark::kSteps;
  Axis x{}, y{};
  std::vector<Series> series{};
};

/// A label of an axis.
struct Tick {
  double value = 0.0;
  std::string label{};
};
std::vector<Tick> ticks(const Axis& axis);

/// "45 %", "1.38 ms", "3.1e-09", ...
std::string format_value(Quantity quantity, double value);

/// Fewer points, for curves that have more than can be seen: of those that lie within 1/400 of the
/// plot's size of the last one that was kept, only the last stays. The ends stay.
std::vector<PlotPoint> thinned(std::vector<PlotPoint> points, const Axis& x, const Axis& y);

/// Points of a distribution, thinned.
std::vector<PlotPoint> points_of(std::span<const Step> steps, const Axis& x, const Axis& y);

/// An axis from a power of ten to a power of ten around finite values > 0; [1e-3, 1] for none.
Axis log_axis(std::string label, Quantity quantity, std::span<const double> values);

}  // namespace conebench::results
