#include "harness/allocations.h"

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdlib>

#if defined(CONEBENCH_SANITIZED) || defined(__SANITIZE_ADDRESS__)
#define CONEBENCH_COUNTS_ALLOCATIONS 0
#else
#define CONEBENCH_COUNTS_ALLOCATIONS 1
#endif

namespace {

// Constant-initialised: malloc is called before any constructor.
constinit std::atomic<bool> counting{false};
constinit std::atomic<std::uint64_t> counted{0};

}  // namespace

#if CONEBENCH_COUNTS_ALLOCATIONS

// glibc's own allocator, under the names that it keeps for those who stand before it.
extern "C" {
void* __libc_malloc(std::size_t bytes) noexcept;
void* __libc_calloc(std::size_t count, std::size_t bytes) noexcept;
void* __libc_realloc(void* block, std::size_t bytes) noexcept;
void* __libc_memalign(std::size_t alignment, std::size_t bytes) noexcept;
}

namespace {

inline void note_call() {
  if (counting.load(std::memory_order_relaxed)) counted.fetch_add(1, std::memory_order_relaxed);
}

bool is_alignment(std::size_t alignment) {
  return alignment >= sizeof(void*) && (alignment & (alignment - 1)) == 0;
}

}  // namespace

extern "C" {

void* malloc(std::size_t bytes) noexcept {
  note_call();
  return __libc_malloc(bytes);
}

void* calloc(std::size_t count, std::size_t bytes) noexcept {
  note_call();
  return __libc_calloc(count, bytes);
}

void* realloc(void* block, std::size_t bytes) noexcept {
  note_call();
  return __libc_realloc(block, bytes);
}

void* memalign(std::size_t alignment, std::size_t bytes) noexcept {
  note_call();
  return __libc_memalign(alignment, bytes);
}

void* aligned_alloc(std::size_t alignment, std::size_t bytes) noexcept {
  note_call();
  return __libc_memalign(alignment, bytes);
}

int posix_memalign(void** block, std::size_t alignment, std::size_t bytes) noexcept {
  if (!is_alignment(alignment)) return EINVAL;
  note_call();
  void* const found = __libc_memalign(alignment, bytes);
  if (found == nullptr) return ENOMEM;
  *block = found;
  return 0;
}
}

#endif

namespace conebench::harness {

AllocationCount::AllocationCount() {
  counted.store(0, std::memory_order_relaxed);
  resume();
}

AllocationCount::~AllocationCount() { pause(); }

void AllocationCount::pause() { counting.store(false, std::memory_order_relaxed); }

void AllocationCount::resume() { counting.store(true, std::memory_order_relaxed); }

std::uint64_t AllocationCount::calls() const { return counted.load(std::memory_order_relaxed); }

bool allocations_are_counted() { return CONEBENCH_COUNTS_ALLOCATIONS != 0; }

}  // namespace conebench::harness
