#pragma once

#include <vector>

#include "results/group_numbers.h"
#include "results/plot.h"

namespace conebench::results {

/// Performance profile of a table at its tolerance; solvers in the order and style of the ranking.
Plot profile_plot(const TimeTable& table, std::span<const Rank> ranking);

/// One profile for each of the group's tolerances, tightest first.
std::vector<Plot> profile_plots(const GroupNumbers& numbers);

/// Share of problems solved against the tolerance, within the time limit.
Plot tolerance_plot(const GroupNumbers& numbers);

/// Share of problems solved within a time, and within a time per cone (one id, two choices).
std::vector<Plot> time_plots(const GroupNumbers& numbers);

/// Share of problems that miss a deadline, failures included, on two logarithmic axes.
Plot missed_plot(const GroupNumbers& numbers);

/// Share of the problems that a solver solved and its interval, one row a solver.
Plot solved_plot(const GroupNumbers& numbers);

}  // namespace conebench::results
