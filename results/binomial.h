#pragma once

#include <cstdint>
#include <vector>

namespace conebench::results {

/// The largest p that `successes` of `trials` refute as too small: were the true probability below
/// it, so many successes would come with a probability of at most 1 - confidence. Trials are taken
/// as independent.
///
/// 0 where there was no success. Precondition: 0 <= successes <= trials, trials > 0,
/// 0 < confidence < 1.
/// Source  Clopper and Pearson, Biometrika 26 (1934) 404-413, one-sided (not checked).
double binomial_lower_bound(std::int64_t successes, std::int64_t trials, double confidence);

/// The same of steps of one run in their order, which hang together: as if there were as many fewer
/// of them as the shares of success of its windows (about the root of the number of steps) spread
/// more than those of independent trials would. Both numbers are rounded down. Runs may differ in
/// more than what one of them shows.
///
/// Precondition: `successes` is not empty, 0 < confidence < 1.
/// Source  batch means: Schmeiser, Oper. Res. 30 (1982) 556-568 (not checked).
double run_lower_bound(const std::vector<bool>& successes, double confidence);

}  // namespace conebench::results
