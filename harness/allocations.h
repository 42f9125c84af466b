#pragma once

#include <cstdint>

namespace conebench::harness {

/// Counts the calls for memory of this process, made by whatever library, for as long as it lives:
/// malloc, calloc, realloc, aligned_alloc, memalign, posix_memalign, and `new` through malloc. Not
/// those of processes that it starts. One at a time.
///
/// The program's own malloc and so on stand before glibc's and pass every call on; outside the life
/// of an AllocationCount that costs one relaxed load, inside it one atomic addition.
class AllocationCount {
 public:
  AllocationCount();
  ~AllocationCount();
  AllocationCount(const AllocationCount&) = delete;
  AllocationCount& operator=(const AllocationCount&) = delete;

  void pause();
  void resume();

  /// So far. Always 0 where allocations_are_counted() is false.
  std::uint64_t calls() const;
};

/// False under sanitizers, which have an allocator of their own.
bool allocations_are_counted();

}  // namespace conebench::harness
