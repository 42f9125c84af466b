#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "results/problem_view.h"
#include "results/profiles.h"
#include "results/report_sections.h"

namespace conebench::results {

/// What the page's script reads. Numbers have three digits, an infinite one is null.

/// {id, title, reading, mark, variants: [{choice, x, y, series}]}, from plots of one id.
nlohmann::json to_json(std::span<const Plot* const> variants);

/// One row a problem, in columns: {solvers, statuses, families, name, family, cones, and one list a
/// solver in time_s, status, eta, iterations; curves: {row: [[solver, [time_s], [eta]], ...]}}.
/// Curves are those of the hardest problems, as many as kMostCurvePoints allows.
nlohmann::json problems_json(const TimeTable& table, std::span<const Record> records);

inline constexpr std::size_t kMostCurvePoints = 60'000;

nlohmann::json to_json(const ProblemView& view);

/// zlib, then base64: what the page unpacks with DecompressionStream("deflate").
std::string packed(const std::string& text);

}  // namespace conebench::results
