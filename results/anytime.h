#pragma once

#include <vector>

#include "results/group_numbers.h"
#include "results/plot.h"

namespace conebench::results {

/// Convergence of a whole campaign: the eta that an engine would hold if it stopped the solver at a
/// time (eta_at() in deadlines.h), of the median problem and of the worst of nine problems in ten
/// (one id, two choices), over the problems that all were run on. Until a solver's first look, and
/// where it left nothing, that is the eta of the starting point.
/// Cost: one pass over all curves.
std::vector<Plot> anytime_plots(const GroupNumbers& numbers);

/// The eta held at each of the rising times; see anytime_plots().
std::vector<double> eta_held(const Record& record, std::span<const double> times_s);

/// The convergence curve of one record as an engine sees it: the best eta so far, at the looks that
/// lowered it by a factor of `least_gain` or more, and at the last one.
std::vector<CurvePoint> best_so_far(const Record& record, double least_gain);

}  // namespace conebench::results
