#include "results/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "results/text.h"

namespace conebench::results {
namespace {

constexpr double kVisible = 1.0 / 400.0;  // of the plot's width or height
constexpr int kMostTicks = 9;

double scaled(Scale scale, double value) {
  switch (scale) {
    case Scale::kLinear:
      return value;
    case Scale::kLog2:
      return std::log2(value);
    case Scale::kLog10:
      return std::log10(value);
  }
  return value;
}

double unscaled(Scale scale, double value) {
  switch (scale) {
    case Scale::kLinear:
      return value;
    case Scale::kLog2:
      return std::exp2(value);
    case Scale::kLog10:
      return std::pow(10.0, value);
  }
  return value;
}

// 1, 2 or 5 times a power of ten, whole on logarithmic scales, so that few enough fit.
double tick_step(double width, bool whole) {
  double step = whole ? 1.0 : std::pow(10.0, std::floor(std::log10(width / kMostTicks)));
  for (const double factor : {2.0, 2.5, 2.0, 2.0, 2.5, 2.0}) {
    if (width / step <= kMostTicks) break;
    step *= whole ? 2.0 : factor;
  }
  return step;
}

// A tick is a round number: no more digits than it needs, and enough to differ from the next.
std::string tick_label(Quantity quantity, double value, double step) {
  if (quantity == Quantity::kRatio && value != 0.0) {
    const double digits = std::floor(std::log10(std::abs(value))) - std::floor(std::log10(step));
    return fmt::format("{:.{}g}", value, std::clamp(static_cast<int>(digits) + 2, 3, 15));
  }
  if (quantity != Quantity::kTime) return format_value(quantity, value);
  if (value < 0.9995e-6) return fmt::format("{:.3g} ns", value * 1e9);
  if (value < 0.9995e-3) return fmt::format("{:.3g} us", value * 1e6);
  if (value < 0.9995) return fmt::format("{:.3g} ms", value * 1e3);
  return fmt::format("{:.3g} s", value);
}

}  // namespace

double Axis::place(double value) const {
  const double from = scaled(scale, low), to = scaled(scale, high);
  const bool below = scale != Scale::kLinear && value <= 0.0;
  const double share =
      below ? 0.0 : std::clamp((scaled(scale, value) - from) / (to - from), 0.0, 1.0);
  return falling ? 1.0 - share : share;
}

std::vector<Tick> ticks(const Axis& axis) {
  std::vector<Tick> labels;
  if (axis.quantity == Quantity::kName) {
    for (std::size_t i = 0; i < axis.categories.size(); ++i) {
      labels.push_back({static_cast<double>(i), axis.categories[i]});
    }
    return labels;
  }
  const double from = scaled(axis.scale, axis.low), to = scaled(axis.scale, axis.high);
  const bool one_decade = axis.scale == Scale::kLog10 && to - from < 1.5;
  const double step = tick_step(to - from, axis.scale != Scale::kLinear);
  for (double at = std::ceil(from / step - 1e-9) * step; at <= to + 1e-9 * step; at += step) {
    const double value = unscaled(axis.scale, std::abs(at) < 1e-9 * step ? 0.0 : at);
    const double apart = axis.scale == Scale::kLinear ? step : std::abs(value);
    labels.push_back({value, tick_label(axis.quantity, value, apart)});
    if (!one_decade) continue;
    for (const double part : {2.0 * value, 5.0 * value}) {
      if (part < axis.high) labels.push_back({part, tick_label(axis.quantity, part, part)});
    }
  }
  return labels;
}

std::string format_value(Quantity quantity, double value) {
  switch (quantity) {
    case Quantity::kShare:
      return fmt::format("{:.3g} %", 100 * value);
    case Quantity::kTime:
      return format_time(value);
    case Quantity::kRatio:
      return fmt::format("{:.3g}", value);
    case Quantity::kEta:
      return fmt::format("{:.0e}", value);
    case Quantity::kCount:
    case Quantity::kName:
      return fmt::format("{:.0f}", value);
  }
  return {};
}

std::vector<PlotPoint> thinned(std::vector<PlotPoint> points, const Axis& x, const Axis& y) {
  std::vector<PlotPoint> kept;
  const auto far = [&](const PlotPoint& a, const PlotPoint& b) {
    return std::abs(x.place(a.x) - x.place(b.x)) > kVisible ||
           std::abs(y.place(a.y) - y.place(b.y)) > kVisible;
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool last = i + 1 == points.size();
    if (kept.empty() || last || far(points[i + 1], kept.back())) kept.push_back(points[i]);
  }
  return kept;
}

std::vector<PlotPoint> points_of(std::span<const Step> steps, const Axis& x, const Axis& y) {
  std::vector<PlotPoint> points;
  for (const Step& step : steps) {
    if (step.value <= x.high) points.push_back({.x = step.value, .y = step.share});
  }
  return thinned(std::move(points), x, y);
}

Axis linear_axis(std::string label, Quantity quantity, std::span<const double> values) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  if (low > high) low = 0.0, high = 1.0;
  constexpr double kRoom = 0.08;
  const double width = high - low;
  // Rounding of equal values is no range to show.
  const double alone = high != 0.0 ? kRoom * std::abs(high) : 1.0;
  const double room = width > 1e-9 * std::abs(high) ? kRoom * width : alone;
  return {.label = std::move(label), .quantity = quantity, .low = low - room, .high = high + room};
}

Axis log_axis(std::string label, Quantity quantity, std::span<const double> values) {
  double low = 1e300, high = 0.0;
  for (const double value : values) {
    if (!std::isfinite(value) || value <= 0.0) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  if (high == 0.0) low = 1e-3, high = 1.0;
  const double first = std::floor(std::log10(low));
  const double last = std::max(std::ceil(std::log10(high)), first + 1.0);
  return {.label = std::move(label),
          .quantity = quantity,
          .scale = Scale::kLog10,
          .low = std::pow(10.0, first),
          .high = std::pow(10.0, last)};
}

}  // namespace conebench::results
