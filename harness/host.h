#pragma once

#include <string>

#include "results/record.h"

namespace conebench::harness {

/// This machine and this build.
results::Host current_host();

/// Now, or some seconds ago: UTC, ISO 8601, "2024-05-01T12:00:00Z".
std::string utc_now(double seconds_ago = 0.0);

/// "0.1.0".
std::string version();

}  // namespace conebench::harness
