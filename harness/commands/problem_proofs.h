#pragma once

#include "harness/commands/text_output.h"

namespace conebench::harness {

/// `problem stats --certificate`: existence of a solution, rank and condition of W of each problem
/// (`entries`: its path and content_sha256), one JSON object each. Every finding has a process of
/// its own, since memory and time are only known afterwards; a proof has `time_limit_s`. Unless
/// `quiet`, prints a table of them as they come. Interrupted: those so far, and the exit code says
/// so.
Json prove_all(const std::vector<Json>& entries, double time_limit_s, bool quiet, int& exit_code);

}  // namespace conebench::harness
