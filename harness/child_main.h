#pragma once

#include "harness/child.h"

namespace conebench::harness {

/// The life of a Child after the fork: arranges process group, files, signals and limits, does the
/// work, writes what it returned to `output` and exits. `parent` is the process that forked.
[[noreturn]] void run_child(const std::function<std::string()>& work, const ChildLimits& limits,
                            int output, int errors, pid_t parent);

}  // namespace conebench::harness
