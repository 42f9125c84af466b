#pragma once

#include <optional>

#include "harness/cgroup.h"
#include "harness/child.h"
#include "harness/supervisor.h"

namespace conebench::harness {

/// The life of a worker after its supervisor's fork: enters its control group, arranges process
/// group, files, signals and limits, does the work, writes what it returned to its output and
/// exits.
[[noreturn]] void run_child(const std::function<std::string()>& work, const ChildLimits& limits,
                            const std::optional<MemoryCgroup>& group, const SupervisorFiles& files,
                            pid_t supervisor);

}  // namespace conebench::harness
