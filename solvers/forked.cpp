#include "solvers/forked.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>

#include "problems/error.h"

namespace conebench::solvers {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kLongestWait_s = 3600.0;  // of one poll; then it is asked again

[[noreturn]] void fail(const char* what) {
  throw problems::OutputError("child process", fmt::format("{}: {}", what, std::strerror(errno)));
}

void point_at_null(int fd, int flags) {
  const int null = ::open("/dev/null", flags);
  ::dup2(null, fd);
  ::close(null);
}

[[noreturn]] void run_child(const std::function<int()>& work, pid_t parent) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(kLeftEarly);
  for (const int signal : {SIGINT, SIGTERM, SIGPIPE, SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL}) {
    ::signal(signal, SIG_DFL);
  }
  const rlimit none{};
  ::setrlimit(RLIMIT_CORE, &none);
  point_at_null(STDIN_FILENO, O_RDONLY);
  point_at_null(STDOUT_FILENO, O_WRONLY);
  // Registered last, run first: what the parent has registered is not for this copy to do.
  std::atexit([] { ::_exit(kLeftEarly); });
  int code = kLeftEarly;
  try {
    code = work();
  } catch (...) {
    // The exit code says it.
  }
  ::_exit(code);
}

// False when the time was over first.
bool wait_for_end(int pidfd, double limit_s) {
  const auto start = Clock::now();
  while (true) {
    const double left_s = limit_s - std::chrono::duration<double>(Clock::now() - start).count();
    if (left_s <= 0.0) return false;
    const double wait_s = std::min(left_s, kLongestWait_s);
    const auto whole_s = static_cast<time_t>(wait_s);
    const timespec wait{whole_s, static_cast<long>((wait_s - static_cast<double>(whole_s)) * 1e9)};
    pollfd file{pidfd, POLLIN, 0};
    if (::ppoll(&file, 1, &wait, nullptr) > 0) return true;
  }
}

}  // namespace

SharedMemory::SharedMemory(std::size_t bytes) : bytes_(std::max<std::size_t>(bytes, 1)) {
  memory_ = ::mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory_ == MAP_FAILED) fail("no shared memory");
}

SharedMemory::~SharedMemory() { ::munmap(memory_, bytes_); }

ProcessEnd run_forked(const std::function<int()>& work, double limit_s) {
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child == 0) run_child(work, parent);
  if (child < 0) fail("no new process");
  ::setpgid(child, child);  // whoever comes first, parent or child

  ProcessEnd end;
  const int pidfd = static_cast<int>(::syscall(SYS_pidfd_open, child, 0));
  end.timed_out = pidfd < 0 || !wait_for_end(pidfd, limit_s);
  if (pidfd >= 0) ::close(pidfd);
  ::kill(-child, SIGKILL);  // itself, or what it has left behind
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (pidfd < 0) fail("cannot watch a process");
  if (WIFSIGNALED(status) && !end.timed_out) end.signal = WTERMSIG(status);
  if (WIFEXITED(status)) end.exit_code = WEXITSTATUS(status);
  return end;
}

std::string describe(const ProcessEnd& end) {
  if (end.timed_out) return "killed at the time limit";
  if (end.signal == 0) return fmt::format("exit code {}", end.exit_code);
  return fmt::format("SIG{} ({})", ::sigabbrev_np(end.signal), ::strsignal(end.signal));
}

}  // namespace conebench::solvers
