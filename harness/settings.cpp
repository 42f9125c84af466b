#include "harness/settings.h"

#include "harness/units.h"
#include "problems/error.h"

namespace conebench::harness {

void SolveSettings::add_to(CLI::App& verb) {
  verb.add_option("--tol", tol, "Tolerance on eta, the relative residual [-]")
      ->capture_default_str();
  verb.add_option("--time-limit", time_limit, "Solver time for one task, e.g. 500ms, 60s, 2min")
      ->type_name("DURATION")
      ->capture_default_str();
  verb.add_option("--mem", memory_limit, "Memory of one task, e.g. 512MiB, 2G (default: no limit)")
      ->type_name("SIZE")
      ->capture_default_str();
  verb.add_option("--hard-limit", hard_limit,
                  "Wall time after which a worker is killed (default: 2 x time limit + 30s)")
      ->type_name("DURATION");
  verb.add_option("--stop", stop,
                  "Who decides that an answer is good: `common` (eta, outside the clock) or `own` "
                  "(the method's own test, inside the clock)")
      ->type_name("common|own")
      ->capture_default_str();
}

solvers::Stop SolveSettings::checked_stop() const {
  problems::require(stop == "common" || stop == "own", "--stop", "\"", stop,
                    "\"; known: common, own");
  solvers::Stop rule;
  rule.tol = tol;
  rule.time_limit_s = parse_duration_s(time_limit, "--time-limit");
  rule.test = stop == "own" ? solvers::StopTest::kOwn : solvers::StopTest::kCommon;
  rule.check();
  return rule;
}

std::uint64_t SolveSettings::memory_limit_bytes() const {
  return memory_limit.empty() ? 0 : parse_bytes(memory_limit, "--mem");
}

std::optional<double> SolveSettings::hard_limit_s() const {
  if (hard_limit.empty()) return std::nullopt;
  return parse_duration_s(hard_limit, "--hard-limit");
}

}  // namespace conebench::harness
