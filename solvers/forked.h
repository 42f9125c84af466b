#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <type_traits>

namespace conebench::solvers {

/// Memory, all zeros, that this process and those forked from it see alike: what a child has
/// written is here even if it was killed the moment after.
class SharedMemory {
 public:
  explicit SharedMemory(std::size_t bytes);
  ~SharedMemory();
  SharedMemory(const SharedMemory&) = delete;
  SharedMemory& operator=(const SharedMemory&) = delete;

  void* get() const { return memory_; }

 private:
  std::size_t bytes_;
  void* memory_;
};

/// An array of numbers, or of plain structures of numbers, in SharedMemory.
template <class T>
class SharedArray {
 public:
  static_assert(std::is_trivially_copyable_v<T>);

  explicit SharedArray(std::size_t size) : memory_(size * sizeof(T)), size_(size) {}
  std::span<T> all() const { return {static_cast<T*>(memory_.get()), size_}; }
  T& operator[](std::size_t i) const { return all()[i]; }

 private:
  SharedMemory memory_;
  std::size_t size_;
};

/// How a child process ended.
struct ProcessEnd {
  bool timed_out = false;  ///< killed at the time limit, with whatever it had started
  int signal = 0;          ///< that ended it, or 0
  int exit_code = 0;
};

/// The exit code of a child whose work threw, or called exit() itself.
inline constexpr int kLeftEarly = 70;

/// Runs `work` in a forked child and waits for its end, at most `limit_s` [s]. What `work` returns
/// is the exit code; a crash, an abort, a call of exit() or a hang of foreign code ends only the
/// child. It has a process group of its own, no stdin, its stdout is thrown away, it leaves no core
/// dump and dies with its parent.
///
/// Cost  about a millisecond. Throws problems::OutputError when the system has no room.
ProcessEnd run_forked(const std::function<int()>& work, double limit_s);

/// "killed at the time limit", "SIGABRT (Aborted)" or "exit code 2".
std::string describe(const ProcessEnd& end);

}  // namespace conebench::solvers
