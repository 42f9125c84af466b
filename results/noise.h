#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "results/record.h"

namespace conebench::results {

/// The times [s] of the repetitions of each task: by solver (contender()) and problem content.
/// Failures and late answers are left out.
using RepeatedTimes = std::map<std::pair<std::string, std::string>, std::vector<double>>;
RepeatedTimes repeated_times(std::span<const Record> records, double tol);

/// A/A: the repetitions of each task are split in two halves at random, as if two identical solvers
/// had run them, and the ratio of the geometric means of their median times is taken. Returns the
/// factor f >= 1 for which 95 % of such ratios lie in [1/f, f]: inside it a difference between two
/// solvers is noise. The halves hold half the repetitions, so f is rather too large. It knows the
/// noise within a run, not a drift between two runs on different days.
/// Nothing unless a task has two finite times or more.
std::optional<double> noise_floor(std::span<const std::vector<double>> times_s,
                                  std::uint64_t seed = 1);

}  // namespace conebench::results
