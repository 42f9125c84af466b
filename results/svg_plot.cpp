#include "results/svg_plot.h"

#include <fmt/format.h>

#include <algorithm>

namespace conebench::results {
namespace {

constexpr double kTop = 48, kWidth = 480, kCurveHeight = 320, kRowHeight = 26,
                 kSharedRowHeight = 46;
constexpr double kLegendGap = 24, kLegendStep = 22, kCharacter = 7.2;
constexpr double kDotRadius = 5;

constexpr auto kFileStyle =
    "<style>.panel{fill:#fff}.band{fill:#000;fill-opacity:.1}.grid{stroke:#d9d9d9}.frame{stroke:#"
    "595959;fill:none}"
    ".c{fill:none;stroke-width:2.2}"
    ".s0{stroke:#0072b2;color:#0072b2}.s1{stroke:#d55e00;color:#d55e00}"
    ".s2{stroke:#009e73;color:#009e73}.s3{stroke:#cc79a7;color:#cc79a7}"
    ".s4{stroke:#e69f00;color:#e69f00}.s5{stroke:#56b4e9;color:#56b4e9}"
    ".s6{stroke:#000;color:#000}.s7{stroke:#8c6d00;color:#8c6d00}"
    ".dot{fill:currentColor}"
    ".d1{stroke-dasharray:7 3}.d2{stroke-dasharray:2 3}.d3{stroke-dasharray:9 3 2 3}</style>\n";

std::size_t longest(const std::vector<std::string>& texts) {
  std::size_t size = 0;
  for (const std::string& text : texts) size = std::max(size, text.size());
  return size;
}

struct Canvas {
  explicit Canvas(const Plot& shown) : plot(shown) {
    if (shown.mark != Mark::kDots) return;
    left = 24 + kCharacter * static_cast<double>(longest(shown.y.categories));
    row = has_legend(shown) ? kSharedRowHeight : kRowHeight;
    height = row * static_cast<double>(shown.y.categories.size());
  }

  double x(double value) const { return left + kWidth * plot.x.place(value); }
  double y(double value) const {
    if (plot.mark == Mark::kDots) return kTop + row * (value + 0.5);
    return kTop + height * (1.0 - plot.y.place(value));
  }
  double bottom() const { return kTop + height; }
  double right() const { return left + kWidth; }

  const Plot& plot;
  double left = 74, height = kCurveHeight, row = kRowHeight;
};

std::string text_at(double x, double y, const char* anchor, const std::string& text) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", x, y, anchor,
                     escaped(text));
}

std::string line(double x1, double y1, double x2, double y2, const std::string& classes) {
  return fmt::format(
      "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" class=\"{}\"/>\n", x1, y1, x2,
      y2, classes);
}

std::string classes_of(std::size_t style) {
  return fmt::format("c s{} d{}", style % kSvgColours, dash_of(style));
}

std::string axes(const Canvas& c) {
  std::string svg;
  for (const Tick& tick : ticks(c.plot.y)) {
    const double y = c.y(tick.value);
    svg += line(c.left, y, c.right(), y, "grid") + text_at(c.left - 8, y + 4, "end", tick.label);
  }
  for (const Tick& tick : ticks(c.plot.x)) {
    const double x = c.x(tick.value);
    svg += line(x, kTop, x, c.bottom(), "grid") + text_at(x, c.bottom() + 18, "middle", tick.label);
  }
  svg += fmt::format(
      "<rect x=\"{:.0f}\" y=\"{:.0f}\" width=\"{:.0f}\" height=\"{:.0f}\" class=\"frame\"/>\n",
      c.left, kTop, kWidth, c.height);
  svg += text_at(c.left + kWidth / 2, c.bottom() + 40, "middle", c.plot.x.label);
  if (c.plot.mark == Mark::kDots) return svg;
  return svg + fmt::format(
                   "<text transform=\"translate(16 {:.1f}) rotate(-90)\" "
                   "text-anchor=\"middle\">{}</text>\n",
                   kTop + c.height / 2, escaped(c.plot.y.label));
}

std::string steps(const Canvas& c, const Series& series) {
  std::string path = fmt::format("M{:.1f} {:.1f}", c.x(c.plot.x.low), c.y(c.plot.y.low));
  // A falling step starts where its first point is, not at the bottom.
  if (!series.points.empty() && series.points.front().x <= c.plot.x.low) path.clear();
  for (const PlotPoint& p : series.points) {
    path += path.empty() ? fmt::format("M{:.1f} {:.1f}", c.x(p.x), c.y(p.y))
                         : fmt::format("H{:.1f}V{:.1f}", c.x(p.x), c.y(p.y));
  }
  return fmt::format("<path d=\"{}H{:.1f}\" class=\"{}\"/>\n", path, c.right(),
                     classes_of(series.style));
}

std::string lines(const Canvas& c, const Series& series) {
  std::string path, dots;
  for (const PlotPoint& p : series.points) {
    if (p.y_interval) {
      dots += line(c.x(p.x), c.y(p.y_interval->low), c.x(p.x), c.y(p.y_interval->high),
                   fmt::format("c s{}", series.style % kSvgColours));
    }
    path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", c.x(p.x), c.y(p.y));
    dots += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.5\" class=\"dot s{}\"/>\n",
                        c.x(p.x), c.y(p.y), series.style % kSvgColours);
  }
  if (path.empty()) return {};
  if (series.points.size() > 40) dots.clear();
  return fmt::format("<path d=\"{}\" class=\"{}\"/>\n", path, classes_of(series.style)) + dots;
}

std::string dots(const Canvas& c, const Series& series) {
  std::string svg;
  for (const PlotPoint& p : series.points) {
    const std::size_t colour = series.style % kSvgColours;
    if (p.x_interval) {
      svg += line(c.x(p.x_interval->low), c.y(p.y), c.x(p.x_interval->high), c.y(p.y),
                  fmt::format("c s{}", colour));
    }
    svg += fmt::format(
        "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" class=\"dot s{}\"><title>{}: {}</title>"
        "</circle>\n",
        c.x(p.x), c.y(p.y), kDotRadius, colour, escaped(series.name),
        escaped(format_value(c.plot.x.quantity, p.x)));
  }
  return svg;
}

std::string marks(const Canvas& c, const Series& series) {
  switch (c.plot.mark) {
    case Mark::kSteps:
      return steps(c, series);
    case Mark::kLines:
      return lines(c, series);
    case Mark::kDots:
      return dots(c, series);
  }
  return {};
}

std::string band_rectangle(double x, double y, double width, double height) {
  return fmt::format(
      "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" class=\"band\"/>\n", x, y,
      width, height);
}

std::string band(const Canvas& c, const Band& band) {
  const double top = c.y(band.range.high);
  return band_rectangle(c.left, top, kWidth, std::max(1.0, c.y(band.range.low) - top));
}

std::string legend_text(const Series& series) {
  return series.note.empty() ? series.name : fmt::format("{} ({})", series.name, series.note);
}

std::string legend(const Canvas& c) {
  const double left = c.right() + kLegendGap;
  std::string svg;
  double y = kTop + 8;
  for (const Series& series : c.plot.series) {
    svg += line(left, y, left + 30, y, classes_of(series.style)) +
           text_at(left + 38, y + 4, "start", legend_text(series));
    y += kLegendStep;
  }
  if (c.plot.band) {
    svg +=
        band_rectangle(left, y - 7, 30, 14) + text_at(left + 38, y + 4, "start", c.plot.band->name);
  }
  return svg;
}

double total_width(const Canvas& c) {
  if (!has_legend(c.plot)) return c.right() + 32;
  std::size_t characters = 20;
  for (const Series& s : c.plot.series) characters = std::max(characters, legend_text(s).size());
  if (c.plot.band) characters = std::max(characters, c.plot.band->name.size());
  return c.right() + kLegendGap + 50 + kCharacter * static_cast<double>(characters);
}

}  // namespace

bool has_legend(const Plot& plot) {
  return plot.mark != Mark::kDots || plot.series.size() != plot.y.categories.size();
}

// Eight colours go with each dash in turn, shifted, so that neighbours differ in both.
std::size_t dash_of(std::size_t style) { return (style + style / kSvgColours) % kSvgDashes; }

std::string escaped(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text.substr(i).starts_with("<= ")) {
      out += "≤";
      ++i;
      continue;
    }
    switch (const char c = text[i]) {
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '&':
        out += "&amp;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string svg(const Plot& plot, SvgUse use) {
  const Canvas c(plot);
  const std::size_t shown = plot.series.size() + (plot.band ? 1 : 0);
  const auto entries = static_cast<double>(has_legend(plot) ? shown : 0);
  const double height = std::max(c.bottom() + 58, kTop + kLegendStep * (1.0 + entries));
  const std::string size = use == SvgUse::kFile ? fmt::format(" width=\"{:.0f}\" height=\"{:.0f}\"",
                                                              total_width(c), height)
                                                : "";
  const std::string title =
      plot.choice.empty() ? plot.title : fmt::format("{}, {}", plot.title, plot.choice);
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:.0f} {:.0f}\"{} role=\"img\" "
      "font-family=\"sans-serif\" font-size=\"13\">\n<title>{}</title>\n{}"
      "<rect width=\"100%\" height=\"100%\" rx=\"8\" class=\"panel\"/>\n",
      total_width(c), height, size, escaped(title), use == SvgUse::kFile ? kFileStyle : "");
  svg += text_at(c.left, 28, "start", title) + axes(c);
  if (plot.band) svg += band(c, *plot.band);
  for (std::size_t i = plot.series.size(); i-- > 0;) svg += marks(c, plot.series[i]);
  if (has_legend(plot)) svg += legend(c);
  return svg + "</svg>\n";
}

}  // namespace conebench::results
