#include <fmt/format.h>

#include <cmath>

#include "results/latex.h"
#include "results/svg_plot.h"

namespace conebench::results {
namespace {

constexpr const char* kDashes[kSvgDashes] = {"solid", "dashed", "dotted", "dashdotted"};

// Curves are wide enough for their legend below; every row of dots has a height of its own.
std::string size_of(const Plot& plot) {
  if (plot.mark != Mark::kDots) return "width=12cm, height=8cm";
  return fmt::format("width=12cm, y=0.55cm, ymin=-0.6, ymax={:.1f}",
                     static_cast<double>(plot.y.categories.size()) - 0.4);
}

std::string scale_of(char axis, const Axis& a) {
  std::string text;
  if (a.scale != Scale::kLinear) {
    text += fmt::format(", {0}mode=log, log basis {0}={1}", axis, a.scale == Scale::kLog2 ? 2 : 10);
  }
  if (a.quantity != Quantity::kName) {
    text += fmt::format(", {0}min={1:.6g}, {0}max={2:.6g}", axis, a.low, a.high);
  }
  if (a.falling || a.quantity == Quantity::kName) text += fmt::format(", {} dir=reverse", axis);
  if (a.quantity == Quantity::kShare) {
    std::string at, labels;
    for (const Tick& tick : ticks(a)) {
      at += fmt::format("{}{:.6g}", at.empty() ? "" : ",", tick.value);
      labels += fmt::format("{}{:.3g}", labels.empty() ? "" : ",", 100 * tick.value);
    }
    text += fmt::format(", {0}tick={{{1}}}, {0}ticklabels={{{2}}}", axis, at, labels);
  }
  return text;
}

std::string names_of(const Axis& a) {
  std::string at, labels;
  for (const Tick& tick : ticks(a)) {
    at += fmt::format("{}{:.0f}", at.empty() ? "" : ",", tick.value);
    labels += fmt::format("{}{{{}}}", labels.empty() ? "" : ",", latex_text(tick.label));
  }
  return fmt::format(", ytick={{{}}}, yticklabels={{{}}}", at, labels);
}

std::string style_of(const Plot& plot, const Series& series) {
  const std::string colour = fmt::format("conebench{}", series.style % kSvgColours);
  if (plot.mark == Mark::kDots) {
    return colour + ", only marks, error bars/.cd, x dir=both, x explicit";
  }
  return fmt::format("{}, {}, thick{}", colour, kDashes[dash_of(series.style)],
                     plot.mark == Mark::kSteps ? ", const plot" : "");
}

// An end of an axis that a curve starts from or runs to is a point too.
std::vector<PlotPoint> drawn_points(const Plot& plot, const Series& series) {
  std::vector<PlotPoint> points = series.points;
  if (plot.mark != Mark::kSteps) return points;
  if (points.empty() || points.front().x > plot.x.low) {
    points.insert(points.begin(), {.x = plot.x.low, .y = plot.y.low});
  }
  points.push_back({.x = plot.x.high, .y = points.back().y});
  return points;
}

std::string coordinates(const Plot& plot, const Series& series) {
  std::string text;
  for (const PlotPoint& p : drawn_points(plot, series)) {
    text += fmt::format("({:.6g},{:.4g})", p.x, p.y);
    if (p.x_interval && std::isfinite(p.x_interval->high)) {
      text += fmt::format(" +- ({0:.4g},0) -= ({1:.4g},0)", p.x_interval->high - p.x,
                          p.x - p.x_interval->low);
    }
    text += " ";
  }
  return text;
}

}  // namespace

std::string latex_plot(const Plot& plot) {
  const bool dots = plot.mark == Mark::kDots;
  std::string text = fmt::format(
      "\\begin{{tikzpicture}}\n\\begin{{axis}}[{}{}{}{}, title={{{}}}, xlabel={{{}}}, "
      "ylabel={{{}}}, grid=major,\n  legend style={{font=\\footnotesize, at={{(1.02,1)}}, "
      "anchor=north west, cells={{anchor=west}}}}]\n",
      size_of(plot), scale_of('x', plot.x), scale_of('y', plot.y), dots ? names_of(plot.y) : "",
      latex_text(plot.choice.empty() ? plot.title : plot.title + ", " + plot.choice),
      latex_text(plot.x.label), dots ? "" : latex_text(plot.y.label));
  for (const Series& series : plot.series) {
    text += fmt::format("\\addplot[{}] coordinates {{{}}};\n", style_of(plot, series),
                        coordinates(plot, series));
    const std::string note = series.note.empty() ? "" : " (" + series.note + ")";
    if (has_legend(plot)) {
      text += fmt::format("\\addlegendentry{{{}}}\n", latex_text(series.name + note));
    }
  }
  return text + "\\end{axis}\n\\end{tikzpicture}\n";
}

}  // namespace conebench::results
