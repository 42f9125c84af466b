#pragma once

#include <span>
#include <string>
#include <variant>
#include <vector>

#include "results/block.h"
#include "results/plot.h"
#include "results/report.h"
#include "results/verdict.h"

namespace conebench::results {

/// A part of a section, in the order in which it is read. Plots of one id follow each other.
struct Part {
  std::variant<Block, Plot> content;
  bool folded = false;  ///< the numbers behind a plot, or more than most readers want
};

struct Section {
  std::string id, title;
  std::vector<Part> parts{};
  std::string missing{};  ///< where there is nothing to show: why, and how to get it
};

/// A group of settings in words, tables and plots, as the page and LaTeX show it.
struct GroupReport {
  std::string title;
  Verdict verdict{};
  std::vector<Section> sections{};
};

/// `group` is an element of `groups`.
GroupReport report_group(const Group& group, std::span<const Group> groups,
                         const ReportInput& input);

}  // namespace conebench::results
