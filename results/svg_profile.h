#pragma once

#include <span>
#include <string>
#include <vector>

#include "results/profiles.h"

namespace conebench::results {

/// A performance profile as a stand-alone SVG image: share of problems solved over log2 of the
/// time ratio, best solver first in the legend. Colours (Okabe and Ito) and dashes tell the curves
/// apart without colour vision too; the panel is opaque, so that it reads on dark pages.
std::string profile_svg(const TimeTable& table, std::span<const Rank> ranking,
                        const std::string& title);

}  // namespace conebench::results
