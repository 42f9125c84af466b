#pragma once

#include <span>
#include <string>
#include <vector>

#include "results/problem_view.h"
#include "results/record.h"

namespace conebench::harness {

/// The hardest problems of a campaign in space, for the report's page.
struct ReportViews {
  std::vector<results::ProblemView> views;  ///< hardest first
  std::string note;                         ///< why there are none, or why so few; else empty
};

/// Looks at the files of the hardest problems, as long as they are at hand, unchanged and have a
/// geometry, and solves each anew with the two best solvers of the ranking that left an answer to
/// it: records keep no answers. Each solve is a worker process under the campaign's rules, with at
/// most 2 s of solver time.
///
/// At most 6 problems, 2 of a scene, of results::kMostConesShown cones each. A file that cannot be
/// used is passed over; the note counts those.
ReportViews make_views(std::span<const results::Record> records);

}  // namespace conebench::harness
