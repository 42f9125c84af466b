#include "harness/child.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>

#include "harness/cgroup.h"
#include "harness/supervisor.h"
#include "problems/error.h"
#include "results/text.h"

namespace conebench::harness {
namespace {

constexpr std::size_t kKeptErrors = 4000;  // bytes of stderr

struct Pipe {
  int read = -1, write = -1;
};

Pipe make_pipe() {
  std::array<int, 2> fds{};
  if (::pipe2(fds.data(), O_CLOEXEC) != 0) {
    throw problems::OutputError("worker", std::string("no pipe: ") + std::strerror(errno));
  }
  return {fds[0], fds[1]};
}

void close_if_open(int& fd) {
  if (fd >= 0) ::close(fd);
  fd = -1;
}

// Reads what is there into `text`; closes the file at its end.
void drain(int& fd, std::string& text) {
  std::array<char, 65536> buffer{};
  while (fd >= 0) {
    const ssize_t n = ::read(fd, buffer.data(), buffer.size());
    if (n > 0) {
      text.append(buffer.data(), static_cast<std::size_t>(n));
      return;  // fair to the other children; poll(2) calls again
    }
    if (n < 0 && errno == EINTR) continue;
    if (n < 0 && errno == EAGAIN) return;
    close_if_open(fd);
  }
}

// Reads all that is there, as it is once no process is left to write more.
void drain_all(int& fd, std::string& text) {
  std::size_t before = 0;
  do {
    before = text.size();
    drain(fd, text);
  } while (text.size() > before);
}

void keep_tail(std::string& text, std::size_t length) {
  if (text.size() > length) text.erase(0, text.size() - length);
}

// A fork whose child starts with all signals blocked, so that it loses none.
pid_t fork_with_signals_blocked() {
  sigset_t all, before;
  sigfillset(&all);
  ::sigprocmask(SIG_SETMASK, &all, &before);
  const pid_t pid = ::fork();
  const int error = errno;
  if (pid != 0) ::sigprocmask(SIG_SETMASK, &before, nullptr);
  errno = error;
  return pid;
}

int wait_for_end(pid_t pid) {
  int status = 0;
  while (::waitpid(pid, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

[[noreturn]] void fail(const char* what, int error) {
  throw problems::OutputError("worker", fmt::format("{}: {}", what, std::strerror(error)));
}

}  // namespace

bool memory_limits_are_off() {
#if defined(CONEBENCH_SANITIZED) || defined(__SANITIZE_ADDRESS__)
  return true;
#else
  return false;
#endif
}

Child::Child(const std::function<std::string()>& work, const ChildLimits& limits)
    : start_(std::chrono::steady_clock::now()) {
  if (limits.memory_bytes > 0) memory_cgroups();  // looked for here, known to all children
  std::array<Pipe, 3> pipes{make_pipe(), make_pipe(), make_pipe()};
  const auto& [output, errors, report] = pipes;
  const pid_t parent = ::getpid();
  supervisor_ = fork_with_signals_blocked();
  if (supervisor_ == 0) {
    supervise(work, limits, {output.write, errors.write, report.write}, parent, start_);
  }
  const int error = errno;
  for (const Pipe& pipe : pipes) {
    ::close(pipe.write);
    ::fcntl(pipe.read, F_SETFL, O_NONBLOCK);
    if (supervisor_ < 0) ::close(pipe.read);
  }
  if (supervisor_ < 0) fail("no new process", error);
  output_fd_ = output.read;
  errors_fd_ = errors.read;
  report_fd_ = report.read;
}

Child::~Child() {
  if (supervisor_ > 0) {
    ::kill(supervisor_, SIGTERM);
    wait_for_end(supervisor_);
  }
  close_if_open(output_fd_);
  close_if_open(errors_fd_);
  close_if_open(report_fd_);
}

std::optional<ChildOutcome> Child::poll() {
  drain(output_fd_, outcome_.output);
  drain(errors_fd_, outcome_.errors);
  if (outcome_.errors.size() > 2 * kKeptErrors) keep_tail(outcome_.errors, kKeptErrors);
  pollfd report{report_fd_, POLLIN, 0};
  if (::poll(&report, 1, 0) != 1) return std::nullopt;
  return finish();
}

ChildOutcome Child::finish() {
  SupervisorReport report;
  const bool told = ::read(report_fd_, &report, sizeof report) == sizeof report;
  int status = wait_for_end(supervisor_);
  supervisor_ = -1;
  close_if_open(report_fd_);
  drain_all(output_fd_, outcome_.output);
  drain_all(errors_fd_, outcome_.errors);
  keep_tail(outcome_.errors, kKeptErrors);
  if (report.error == ENOSYS) fail("/proc/PID/task/PID/children cannot be read", report.error);
  if (report.error != 0) fail("could not be started", report.error);

  if (told) {
    status = report.status;
  } else {  // the supervisor was killed, and its worker with it
    report.wall_s =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  outcome_.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 0;
  outcome_.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  outcome_.timed_out = report.timed_out;
  outcome_.out_of_memory = report.out_of_memory;
  outcome_.wall_s = report.wall_s;
  outcome_.cpu_s = report.cpu_s;
  outcome_.peak_memory_bytes = report.peak_memory_bytes;
  return outcome_;
}

std::string describe_end(const ChildOutcome& outcome) {
  std::string text = fmt::format("exit code {}", outcome.exit_code);
  if (outcome.timed_out) {
    text = fmt::format("killed after {}", results::format_time(outcome.wall_s));
  } else if (outcome.signal != 0) {
    text = fmt::format("SIG{} ({})", ::sigabbrev_np(outcome.signal), ::strsignal(outcome.signal));
  }
  return outcome.errors.empty() ? text : text + "; stderr: " + outcome.errors;
}

void wait_for_news(const std::vector<const Child*>& children, double longest_s) {
  std::vector<pollfd> files;
  for (const Child* child : children) {
    // poll(2) passes over what is closed: -1.
    for (const int fd : {child->output_fd(), child->errors_fd(), child->report_fd()}) {
      files.push_back({fd, POLLIN, 0});
    }
  }
  ::poll(files.data(), files.size(), static_cast<int>(std::ceil(longest_s * 1e3)));
}

}  // namespace conebench::harness
