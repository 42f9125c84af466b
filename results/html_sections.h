#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "results/profiles.h"
#include "results/report_sections.h"

namespace conebench::results {

/// A group as HTML that reads without scripts, its plots as SVG; the script finds them by their
/// data attributes. `prefix` starts every id: "g0-".
std::string html_verdict(const Verdict& verdict, const std::string& prefix);
std::string html_section(const Section& section, const std::string& prefix);

/// The hardest problems as a table; the script puts one of all problems in its place.
std::string html_problems(const TimeTable& table, const std::string& prefix);

/// The plots of the sections, as the script reads them: one object an id.
nlohmann::json plots_json(std::span<const Section> sections);

}  // namespace conebench::results
