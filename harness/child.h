#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace conebench::harness {

/// What a child process may use. At a soft limit it is told, and may still save its work; at the
/// hard one it is killed with all that it has started.
struct ChildLimits {
  static constexpr double kNone = std::numeric_limits<double>::infinity();

  double wall_s = 60.0;            ///< hard; SIGKILL
  std::uint64_t memory_bytes = 0;  ///< address space of each process and, where harness/cgroup.h
                                   ///< finds a way, memory of all of them together; 0: no limit.
                                   ///< Address space is not limited under sanitizers
  std::optional<int> core{};       ///< run on this core only
  double soft_wall_s = kNone;      ///< SIGTERM to its process group
  double cpu_s = kNone;            ///< hard; of each process, all threads; up to a whole second
  double soft_cpu_s = kNone;       ///< SIGXCPU; likewise, and unseen unless a second below cpu_s
};

/// How a child process ended.
struct ChildOutcome {
  std::string output;  ///< what the work returned; empty when it did not get that far
  std::string errors;  ///< the tail of its stderr
  int exit_code = 0;
  int signal = 0;                       ///< that ended it, or 0
  bool timed_out = false;               ///< a limit on time was reached, soft or hard
  bool out_of_memory = false;           ///< the system killed one of its processes at memory_bytes
  double wall_s = 0.0;                  ///< from the fork to its end
  double cpu_s = 0.0;                   ///< of all processes that it has started
  std::uint64_t peak_memory_bytes = 0;  ///< resident, of the largest of them
};

/// One piece of work in a process of its own, forked from this one, so that whatever it does to
/// itself is only a ChildOutcome here. It gets its own process group, no stdin, stdout thrown away,
/// no core dumps, default signals. A supervisor (harness/supervisor.h) stands between the two: when
/// the work has ended, or this process has, no descendant of it is left, wherever it hid.
///
/// This is the fork server: the campaign's own process has loaded every library, has one thread and
/// keeps nothing of a task but its outcome, so that each child starts as a copy of the same clean
/// state. A server of its own would add a process and a protocol that carries closures, and save
/// no loading.
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

  /// Reads what has arrived; the outcome once the child has ended and all of its processes are
  /// gone. Throws problems::OutputError when it could not be started or cleared away.
  std::optional<ChildOutcome> poll();

  /// For poll(2): readable when there may be news. -1 once the child has closed it.
  int output_fd() const { return output_fd_; }
  int errors_fd() const { return errors_fd_; }
  /// The same, of its end; always open until poll() has returned the outcome.
  int report_fd() const { return report_fd_; }

 private:
  ChildOutcome finish();

  std::chrono::steady_clock::time_point start_;
  ChildOutcome outcome_;
  pid_t supervisor_ = -1;
  int output_fd_ = -1, errors_fd_ = -1, report_fd_ = -1;
};

/// "SIGSEGV (Segmentation fault)", "killed after 5.00 s", "exit code 70", with the tail of stderr.
std::string describe_end(const ChildOutcome& outcome);

/// The exit code of a child whose work threw.
inline constexpr int kUncaughtExit = 70;

/// Sleeps until one of the children has news, at most `longest_s`.
void wait_for_news(const std::vector<const Child*>& children, double longest_s);

/// True in builds where address space cannot be limited (AddressSanitizer maps terabytes).
bool memory_limits_are_off();

}  // namespace conebench::harness
