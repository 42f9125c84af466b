#pragma once

#include <string>
#include <string_view>

#include "results/plot.h"

namespace conebench::results {

/// The plot as an SVG image with axes, title and legend, best solver first. Colours (Okabe and Ito)
/// and dashes tell the curves apart without colour vision too.
///
/// For a file it is complete, on an opaque panel that reads on dark pages. In the page the colours
/// come from the page's style sheet: the classes are s0, s1, ... (colours), d0, ... (dashes), grid,
/// frame and panel.
enum class SvgUse { kFile, kPage };
std::string svg(const Plot& plot, SvgUse use);

/// The number of different colours and of dashes.
inline constexpr std::size_t kSvgColours = 8, kSvgDashes = 4;
std::size_t dash_of(std::size_t style);

/// Where every row of dots is a solver of its own, the rows are the legend.
bool has_legend(const Plot& plot);

/// With <, >, & and " as entities, and "<= " with the sign for it.
std::string escaped(std::string_view text);

}  // namespace conebench::results
