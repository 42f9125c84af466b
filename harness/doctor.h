#pragma once

#include <string>
#include <vector>

namespace conebench::harness {

/// One thing that the doctor looked at.
struct Finding {
  std::string name;   ///< "compiler", "memory bandwidth", ...
  std::string value;  ///< with its unit
  bool good = true;   ///< false: timings or results would suffer; `value` says why
};

/// Looks at the build, the machine and the limits of this process. Takes about a second.
std::vector<Finding> examine();

}  // namespace conebench::harness
