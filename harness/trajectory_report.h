#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "harness/trajectory_findings.h"
#include "results/plot.h"

namespace conebench::harness {

/// The findings as one object; null where there is no number.
nlohmann::ordered_json to_json(const Findings& findings);

/// One row an observable, solver and tolerance, the reference's first, with a line of headers.
std::string trajectory_csv(const Findings& findings);

/// What tolerance is enough, what it costs, and every number: tables that read well as Markdown and
/// in a terminal.
std::string trajectory_text(const Findings& findings);

/// One plot an observable against the tolerance, of those that have a value: a curve a solver, with
/// its spread over seeds, on the reference's mean and spread as a band. `id` is the observable's
/// key.
std::vector<results::Plot> trajectory_plots(const Findings& findings);

/// The report: trajectory_text() with a figure (KEY.svg) a plot and how it was made.
std::string trajectory_markdown(const Findings& findings, const std::string& command);

}  // namespace conebench::harness
