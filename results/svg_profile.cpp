#include "results/svg_profile.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace conebench::results {
namespace {

constexpr double kLeft = 70, kTop = 48, kPlotWidth = 480, kPlotHeight = 320;
constexpr double kLegendLeft = kLeft + kPlotWidth + 24, kLegendStep = 22;
constexpr int kShareLines = 5;

constexpr std::array kColours = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                 "#E69F00", "#56B4E9", "#000000", "#8C6D00"};
constexpr std::array kDashes = {"none", "7 3", "2 3", "9 3 2 3"};

struct Axes {
  int octaves = 1;  // the ratio axis ends at 2^octaves
  double x(double ratio) const {
    return kLeft + kPlotWidth * std::min(1.0, std::log2(ratio) / octaves);
  }
  static double y(double share) { return kTop + kPlotHeight * (1.0 - share); }
};

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else if (c == '&') {
      out += "&amp;";
    } else {
      out += c;
    }
  }
  return out;
}

Axes axes_for(const std::vector<std::vector<ProfileStep>>& profiles) {
  double largest = 2.0;
  for (const auto& profile : profiles) {
    if (!profile.empty()) largest = std::max(largest, profile.back().ratio);
  }
  const double octaves = std::ceil(std::log2(std::min(largest, kLargestRatio)) + 0.25);
  return {.octaves = static_cast<int>(octaves)};
}

std::string text_at(double x, double y, const char* anchor, const std::string& text) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", x, y, anchor,
                     escaped(text));
}

std::string line(double x1, double y1, double x2, double y2, const char* attributes) {
  return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" {}/>\n", x1, y1,
                     x2, y2, attributes);
}

std::string grid(const Axes& axes) {
  constexpr auto kGrid = "stroke=\"#d9d9d9\"";
  std::string svg;
  for (int i = 0; i <= kShareLines; ++i) {
    const double share = static_cast<double>(i) / kShareLines;
    svg += line(kLeft, Axes::y(share), kLeft + kPlotWidth, Axes::y(share), kGrid);
    svg += text_at(kLeft - 8, Axes::y(share) + 4, "end", fmt::format("{:.0f} %", 100 * share));
  }
  for (int octave = 0; octave <= axes.octaves; ++octave) {
    const double x = axes.x(std::exp2(octave));
    svg += line(x, kTop, x, kTop + kPlotHeight, kGrid);
    svg += text_at(x, kTop + kPlotHeight + 18, "middle", fmt::format("{}", 1 << octave));
  }
  svg += fmt::format(
      "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#595959\"/>\n",
      kLeft, kTop, kPlotWidth, kPlotHeight);
  svg += text_at(kLeft + kPlotWidth / 2, kTop + kPlotHeight + 42, "middle",
                 "time over the fastest solver's time on the same problem [-], log2 axis");
  svg += fmt::format(
      "<text transform=\"translate(18 {:.1f}) rotate(-90)\" text-anchor=\"middle\">"
      "problems solved [% of all]</text>\n",
      kTop + kPlotHeight / 2);
  return svg;
}

std::string stroke(std::size_t place) {
  return fmt::format("stroke=\"{}\" stroke-dasharray=\"{}\" stroke-width=\"2.2\" fill=\"none\"",
                     kColours[place % kColours.size()],
                     kDashes[(place + place / kColours.size()) % kDashes.size()]);
}

std::string curve(const Axes& axes, std::span<const ProfileStep> profile, std::size_t place) {
  std::string points = fmt::format("M{:.1f} {:.1f}", axes.x(1.0), Axes::y(0.0));
  for (const ProfileStep& step : profile) {
    if (std::log2(step.ratio) > axes.octaves) break;
    points += fmt::format("H{:.1f}V{:.1f}", axes.x(step.ratio), Axes::y(step.share));
  }
  return fmt::format("<path d=\"{}H{:.1f}\" {}/>\n", points, kLeft + kPlotWidth, stroke(place));
}

std::string legend_entry(const Rank& rank, std::size_t place) {
  const double y = kTop + 8 + kLegendStep * static_cast<double>(place);
  return line(kLegendLeft, y, kLegendLeft + 30, y, stroke(place).c_str()) +
         text_at(kLegendLeft + 38, y + 4, "start",
                 fmt::format("{} ({}/{})", rank.solver, rank.solved, rank.problems));
}

}  // namespace

std::string profile_svg(const TimeTable& table, std::span<const Rank> ranking,
                        const std::string& title) {
  const auto profiles = performance_profiles(table);
  const Axes axes = axes_for(profiles);
  std::size_t longest = 20;
  for (const Rank& rank : ranking) longest = std::max(longest, rank.solver.size() + 10);
  const double total_width = kLegendLeft + 56 + 7.2 * static_cast<double>(longest);
  const double total_height = std::max(
      kTop + kPlotHeight + 60, kTop + kLegendStep * (1.0 + static_cast<double>(ranking.size())));

  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" "
      "height=\"{1:.0f}\" role=\"img\" font-family=\"sans-serif\" font-size=\"13\" "
      "fill=\"#262626\">\n<title>{2}</title>\n"
      "<rect width=\"100%\" height=\"100%\" rx=\"8\" fill=\"#ffffff\"/>\n",
      total_width, total_height, escaped(title));
  svg += text_at(kLeft, 28, "start", title);
  svg += grid(axes);
  for (std::size_t place = ranking.size(); place-- > 0;) {
    const auto solver =
        std::find(table.solvers.begin(), table.solvers.end(), ranking[place].solver);
    const auto index = static_cast<std::size_t>(solver - table.solvers.begin());
    svg += curve(axes, profiles[index], place) + legend_entry(ranking[place], place);
  }
  return svg + "</svg>\n";
}

}  // namespace conebench::results
