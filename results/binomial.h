#pragma once

#include <cstdint>

namespace conebench::results {

/// The largest p that `successes` of `trials` refute as too small: were the true probability below
/// it, so many successes would come with a probability of at most 1 - confidence. Trials are taken
/// as independent.
///
/// 0 where there was no success. Precondition: 0 <= successes <= trials, trials > 0,
/// 0 < confidence < 1.
/// Source  Clopper and Pearson, Biometrika 26 (1934) 404-413, one-sided (not checked).
double binomial_lower_bound(std::int64_t successes, std::int64_t trials, double confidence);

}  // namespace conebench::results
