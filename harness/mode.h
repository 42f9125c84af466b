#pragma once

#include <string>
#include <string_view>

namespace conebench::harness {

/// What a solve starts from.
enum class Mode {
  kCold,      ///< r' = 0
  kWarm,      ///< the guess in the problem's file
  kSequence,  ///< consecutive steps in one task: r' = 0 at the first, then the answer to the step
              ///< before, carried over (problems/carry_over.h)
};

/// "cold", "warm", "sequence".
std::string_view to_string(Mode mode);

/// Throws problems::InputError naming `option`.
Mode mode_from(const std::string& name, std::string_view option);

}  // namespace conebench::harness
