#include "harness/supervisor.h"

#include <linux/close_range.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <ctime>
#include <fstream>

#include "harness/cgroup.h"
#include "harness/child_main.h"
#include "problems/error.h"

namespace conebench::harness {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kLongestWait_s = 3600.0;  // of one wait for a signal; then it is asked again
constexpr double kCpuTick_s = 0.1;         // the system's limit counts ticks, its usage nanoseconds

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double seconds(const timeval& t) {
  return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
}

// A journal's lock and other workers' pipes are not for this process to hold.
void close_all_but(std::array<int, 3> kept) {
  std::sort(kept.begin(), kept.end());
  int first = STDERR_FILENO + 1;
  for (const int fd : kept) {
    if (fd > first) ::close_range(static_cast<unsigned>(first), static_cast<unsigned>(fd - 1), 0);
    first = std::max(first, fd + 1);
  }
  ::close_range(static_cast<unsigned>(first), ~0U, 0);
}

// SIGCHLD, SIGTERM, or something else once the time is over.
int next_signal(double longest_s) {
  sigset_t awaited;
  sigemptyset(&awaited);
  sigaddset(&awaited, SIGCHLD);
  sigaddset(&awaited, SIGTERM);
  const double wait_s = std::clamp(longest_s, 0.0, kLongestWait_s);
  const auto whole_s = static_cast<time_t>(wait_s);
  const timespec wait{whole_s, static_cast<long>((wait_s - static_cast<double>(whole_s)) * 1e9)};
  return ::sigtimedwait(&awaited, nullptr, &wait);
}

// A worker and all that descends from it.
class Tree {
 public:
  Tree(pid_t worker, SupervisorReport& report) : worker_(worker), report_(report) {}

  // Collects whoever has ended. True once the worker is among them.
  bool reap() {
    while (reap_one(WNOHANG)) {
    }
    return worker_ended_;
  }

  void tell() const {
    if (::kill(-worker_, SIGTERM) != 0) ::kill(worker_, SIGTERM);  // it has left its group
  }

  void kill_worker() const { kill_with_group(worker_); }

  // Kills and collects, generation by generation, until no process is left.
  void clear() {
    while (has_children() && kill_children()) {
      reap_one(0);
      reap();
    }
  }

 private:
  // A group at once, so that it cannot outrun this by forking. The number of a child that has not
  // been reaped is nobody else's, nor is that of the group that it may have founded.
  static void kill_with_group(pid_t child) {
    ::kill(-child, SIGKILL);
    ::kill(child, SIGKILL);
  }

  static bool has_children() {
    siginfo_t ignored{};
    return ::waitid(P_ALL, 0, &ignored, WEXITED | WNOWAIT | WNOHANG) == 0;
  }

  // False if there is none (that has ended, with WNOHANG).
  bool reap_one(int options) {
    siginfo_t ended{};
    if (::waitid(P_ALL, 0, &ended, WEXITED | WNOWAIT | options) != 0 || ended.si_pid == 0) {
      return false;
    }
    const pid_t pid = ended.si_pid;
    if (pid == worker_) worker_ended_ = true;
    if (worker_ended_) kill_with_group(pid);
    int status = 0;
    rusage usage{};
    ::wait4(pid, &status, 0, &usage);
    report_.cpu_s += seconds(usage.ru_utime) + seconds(usage.ru_stime);
    report_.peak_memory_bytes =
        std::max(report_.peak_memory_bytes, static_cast<std::uint64_t>(usage.ru_maxrss) * 1024);
    if (pid == worker_) report_.status = status;
    return true;
  }

  // False, and an error in the report, where the system does not name them.
  bool kill_children() {
    const std::string own = std::to_string(::getpid());
    std::ifstream children("/proc/" + own + "/task/" + own + "/children");
    if (!children) report_.error = ENOSYS;
    for (pid_t child = 0; children >> child;) kill_with_group(child);
    return report_.error == 0;
  }

  pid_t worker_;
  SupervisorReport& report_;
  bool worker_ended_ = false;
};

// Until the worker has ended, or this process is told to stop.
void watch(Tree& tree, const ChildLimits& limits, Clock::time_point start,
           SupervisorReport& report) {
  double next_s = std::min(limits.soft_wall_s, limits.wall_s);
  while (!tree.reap()) {
    const double elapsed_s = seconds_since(start);
    if (elapsed_s >= limits.wall_s) {
      tree.kill_worker();
      next_s = ChildLimits::kNone;
    } else if (elapsed_s >= next_s) {
      tree.tell();
      next_s = limits.wall_s;
    }
    if (next_signal(next_s - elapsed_s) == SIGTERM) return;
  }
  report.wall_s = seconds_since(start);
  report.timed_out =
      report.wall_s >= std::min(limits.soft_wall_s, limits.wall_s) ||
      report.cpu_s >= std::ceil(std::min(limits.soft_cpu_s, limits.cpu_s)) - kCpuTick_s;
}

void oversee(const std::function<std::string()>& work, const ChildLimits& limits,
             const SupervisorFiles& files, Clock::time_point start, SupervisorReport& report) {
  std::optional<MemoryCgroup> group;
  if (limits.memory_bytes > 0 && memory_cgroups()) {
    group.emplace(*memory_cgroups(), limits.memory_bytes);
  }
  const pid_t supervisor = ::getpid();
  const pid_t worker = ::fork();
  if (worker == 0) run_child(work, limits, group, files, supervisor);
  if (worker < 0) {
    report.error = errno;
    return;
  }
  ::close(files.output);
  ::close(files.errors);
  Tree tree(worker, report);
  watch(tree, limits, start, report);
  tree.clear();
  report.out_of_memory = group && group->has_killed();
}

}  // namespace

[[noreturn]] void supervise(const std::function<std::string()>& work, const ChildLimits& limits,
                            const SupervisorFiles& files, pid_t parent, Clock::time_point start) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (::getppid() != parent) ::_exit(kUncaughtExit);
  ::prctl(PR_SET_CHILD_SUBREAPER, 1);
  ::signal(SIGCHLD, SIG_DFL);
  close_all_but({files.output, files.errors, files.report});
  SupervisorReport report;
  try {
    oversee(work, limits, files, start, report);
  } catch (const std::exception&) {
    report.error = EIO;  // the cgroup worked when it was found
  }
  const bool told = ::write(files.report, &report, sizeof report) == sizeof report;
  ::_exit(told ? 0 : kUncaughtExit);
}

}  // namespace conebench::harness
