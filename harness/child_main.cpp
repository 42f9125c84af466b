#include "harness/child_main.h"

#include <fcntl.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <exception>

namespace conebench::harness {
namespace {

// Whole seconds, as the system counts processor time.
rlim_t whole_seconds(double limit_s) {
  return std::isfinite(limit_s) ? static_cast<rlim_t>(std::ceil(limit_s)) : RLIM_INFINITY;
}

void limit_resource(__rlimit_resource resource, rlim_t soft, rlim_t hard = RLIM_INFINITY) {
  rlimit limit{};
  if (::getrlimit(resource, &limit) != 0) return;
  limit.rlim_max = std::min(hard, limit.rlim_max);
  limit.rlim_cur = std::min(soft, limit.rlim_max);
  ::setrlimit(resource, &limit);
}

void apply(const ChildLimits& limits) {
  limit_resource(RLIMIT_CORE, 0);
  limit_resource(RLIMIT_CPU, whole_seconds(limits.soft_cpu_s), whole_seconds(limits.cpu_s));
  if (limits.memory_bytes > 0 && !memory_limits_are_off()) {
    limit_resource(RLIMIT_AS, limits.memory_bytes);
  }
  if (limits.core) {
    cpu_set_t set;
    CPU_ZERO(&set);
    CPU_SET(static_cast<std::size_t>(*limits.core), &set);
    ::sched_setaffinity(0, sizeof set, &set);
  }
}

// Standard streams as described in the header; every other file of the parent is closed.
int arrange_files(int output, int errors) {
  const int null = ::open("/dev/null", O_RDWR);
  const int kept = ::fcntl(output, F_DUPFD, 10);
  ::dup2(null, STDIN_FILENO);
  ::dup2(null, STDOUT_FILENO);
  ::dup2(errors, STDERR_FILENO);
  ::dup3(kept, 3, O_CLOEXEC);
  ::close_range(4, ~0U, 0);
  return 3;
}

bool write_all(int fd, const std::string& text) {
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t n = ::write(fd, text.data() + done, text.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return false;
    done += static_cast<std::size_t>(n);
  }
  return true;
}

// The handlers of the parent (a flag that nobody reads here) and of a sanitizer or test framework.
void reset_signals() {
  for (const int signal :
       {SIGINT, SIGTERM, SIGPIPE, SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGXCPU}) {
    ::signal(signal, SIG_DFL);
  }
  sigset_t none;
  sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
}

}  // namespace

[[noreturn]] void run_child(const std::function<std::string()>& work, const ChildLimits& limits,
                            const std::optional<MemoryCgroup>& group, const SupervisorFiles& files,
                            pid_t supervisor) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != supervisor) ::_exit(kUncaughtExit);
  reset_signals();
  const int result = arrange_files(files.output, files.errors);
  int code = kUncaughtExit;
  try {
    if (group) group->enter();
    apply(limits);
    code = write_all(result, work()) ? 0 : kUncaughtExit;
  } catch (const std::exception& error) {
    const std::string text = std::string("uncaught: ") + error.what() + "\n";
    write_all(STDERR_FILENO, text);
  } catch (...) {
    write_all(STDERR_FILENO, "uncaught: not a std::exception\n");
  }
  // No destructors: the parent's objects are only copies here.
  ::_exit(code);
}

}  // namespace conebench::harness
