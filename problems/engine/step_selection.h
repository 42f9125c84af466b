#pragma once

#include <cstdint>
#include <limits>
#include <string_view>

namespace conebench::engine {

/// How many of the steps in range are exported.
enum class Sampling {
  kNone,        ///< all of them
  kHardest,     ///< those that the step solver found hardest
  kReservoir,   ///< a uniform random choice
  kStratified,  ///< the same within every class of cones and iterations
};

/// Which steps are exported: first <= step <= last, every `stride`-th counted from `first`; of
/// these all, or a sample that is chosen after they are solved (problems/engine/step_sample.h).
struct StepSelection {
  std::int64_t first = 0;
  std::int64_t last = std::numeric_limits<std::int64_t>::max();
  std::int64_t stride = 1;  ///< >= 1
  Sampling sampling = Sampling::kNone;
  std::int64_t most = 0;  ///< size of the sample, >= 1 where there is one

  bool contains(std::int64_t step) const {
    return step >= first && step <= last && (step - first) % stride == 0;
  }
};

/// Reads "all", "every:N", "N..M", "hardest:K", "reservoir:K" or "stratified:K". Throws InputError,
/// with a suggestion where a word is close to one of these.
StepSelection parse_selection(std::string_view text);

}  // namespace conebench::engine
