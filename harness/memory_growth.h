#pragma once

#include <cstdint>

namespace conebench::harness {

/// How far this process's resident memory rises above what it was when this object was made.
///
/// Sets the kernel's peak (VmHWM of proc(5)) back to what is resident now, through
/// /proc/self/clear_refs; where that is not allowed, only what rises above the earlier peak is
/// seen.
class MemoryGrowth {
 public:
  MemoryGrowth();

  /// Of the peak so far, to about the memory of one page per processor and counter.
  std::uint64_t bytes() const;

  /// Peak of the process since it began: what the kernel reports of it at its end forgets the time
  /// before this object was made.
  std::uint64_t process_peak_bytes() const;

 private:
  std::uint64_t earlier_peak_;
  std::uint64_t floor_;
};

}  // namespace conebench::harness
