#pragma once

#include <optional>
#include <string>
#include <vector>

namespace conebench::harness {

/// How fast this machine is just now, by a fixed piece of work: the same in every build of one
/// version, about 0.1 s. Run at the start and at the end of a shard.
struct Calibration {
  double arithmetic_s = 0.0;  ///< dense and sparse products within the cache; median of its repeats
  double memory_s = 0.0;  ///< a triad over arrays of 64 MB, larger than a core's share of a cache
  /// Of each its repeats' spread (MedianInterval::spread()) [-].
  double arithmetic_spread = 0.0, memory_spread = 0.0;
  double processor_s = 0.0;  ///< of all cores since the machine began, idle or not; 0: unknown
  double stolen_s = 0.0;     ///< thereof what a hypervisor gave to others while work was waiting
  std::optional<double> frequency_hz{};  ///< of this core, right after the work, where it is told
};

Calibration calibrate();

/// What tells that the machine was not the same between the two, a line each:
/// a part of the work that took longer or shorter by more than kLeastDrift and the two spreads of
/// its own repeats together; a core's frequency that differs by more than kLeastDrift; more than
/// kMostStolen of all processor time in between stolen.
std::vector<std::string> signs_of_drift(const Calibration& before, const Calibration& after);

/// True if there is any.
bool drifted(const Calibration& before, const Calibration& after);

inline constexpr double kLeastDrift = 0.05;  ///< below this no difference is called a drift [-]
inline constexpr double kMostStolen = 0.02;  ///< of the processor time of all cores [-]

}  // namespace conebench::harness
