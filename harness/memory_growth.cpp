#include "harness/memory_growth.h"

#include <algorithm>
#include <fstream>
#include <string>

namespace conebench::harness {
namespace {

// VmHWM; 0 where /proc does not say.
std::uint64_t resident_peak_bytes() {
  std::ifstream status("/proc/self/status");
  std::string name;
  while (status >> name) {
    std::uint64_t kibibytes = 0;
    if (name == "VmHWM:" && status >> kibibytes) return kibibytes * 1024;
  }
  return 0;
}

void reset_resident_peak() {
  constexpr char kResetPeak = '5';  // proc(5), /proc/PID/clear_refs
  std::ofstream("/proc/self/clear_refs") << kResetPeak << std::flush;
}

}  // namespace

MemoryGrowth::MemoryGrowth() : earlier_peak_(resident_peak_bytes()) {
  reset_resident_peak();
  floor_ = resident_peak_bytes();
}

std::uint64_t MemoryGrowth::bytes() const {
  const std::uint64_t peak = resident_peak_bytes();
  return peak > floor_ ? peak - floor_ : 0;
}

std::uint64_t MemoryGrowth::process_peak_bytes() const {
  return std::max(earlier_peak_, resident_peak_bytes());
}

}  // namespace conebench::harness
