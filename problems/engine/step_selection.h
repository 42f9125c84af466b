#pragma once

#include <cstdint>
#include <limits>
#include <string_view>

namespace conebench::engine {

/// Which steps are exported: first <= step <= last, every `stride`-th counted from `first`.
struct StepSelection {
  std::int64_t first = 0;
  std::int64_t last = std::numeric_limits<std::int64_t>::max();
  std::int64_t stride = 1;  ///< >= 1; becomes the problem's sampling_weight

  bool contains(std::int64_t step) const {
    return step >= first && step <= last && (step - first) % stride == 0;
  }
};

/// Reads "all", "every:N" or "N..M". Throws InputError.
StepSelection parse_selection(std::string_view text);

}  // namespace conebench::engine
