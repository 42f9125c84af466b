#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace conebench::harness {

/// What a child process may use.
struct ChildLimits {
  double wall_s = 60.0;            ///< then it is killed, with all of its process group
  std::uint64_t memory_bytes = 0;  ///< address space; 0: no limit. Not enforced under sanitizers
  std::optional<int> core{};       ///< run on this core only
};

/// How a child process ended.
struct ChildOutcome {
  std::string output;  ///< what the work returned; empty when it did not get that far
  std::string errors;  ///< the tail of its stderr
  int exit_code = 0;
  int signal = 0;  ///< that ended it, or 0
  bool timed_out = false;
  double wall_s = 0.0, cpu_s = 0.0;
  std::uint64_t peak_memory_bytes = 0;
};

/// One piece of work in a process of its own, forked from this one, so that whatever it does to
/// itself is only a ChildOutcome here. It gets its own process group, no stdin, stdout thrown away,
/// no core dumps, default signals, and dies with its parent.
///
/// Precondition: this process has one thread.
class Child {
 public:
  /// Forks. `work` runs in the child and what it returns is sent back; an exception that leaves it
  /// ends the child with kUncaughtExit. Throws problems::OutputError when the system has no room.
  Child(const std::function<std::string()>& work, const ChildLimits& limits);
  ~Child();  ///< kills it if it still runs
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Reads what has arrived, enforces the wall limit; the outcome once the child has ended.
  std::optional<ChildOutcome> poll();

  /// For poll(2): readable when there may be news. -1 once the child has closed it.
  int output_fd() const { return output_fd_; }
  int errors_fd() const { return errors_fd_; }

 private:
  double elapsed_s() const;
  void kill_group() const;

  std::chrono::steady_clock::time_point start_;
  ChildLimits limits_;
  ChildOutcome outcome_;
  pid_t pid_ = -1;
  int output_fd_ = -1, errors_fd_ = -1;
};

/// "SIGSEGV (Segmentation fault)", "killed after 5.00 s", "exit code 70", with the tail of stderr.
std::string describe_end(const ChildOutcome& outcome);

/// The exit code of a child whose work threw.
inline constexpr int kUncaughtExit = 70;

/// Sleeps until one of the children may have news, at most `longest_s`.
void wait_for_news(const std::vector<const Child*>& children, double longest_s);

/// True in builds where address space cannot be limited (AddressSanitizer maps terabytes).
bool memory_limits_are_off();

}  // namespace conebench::harness
