#include "harness/child.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>

#include "harness/child_main.h"
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

double seconds(const timeval& t) {
  return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
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
    : start_(std::chrono::steady_clock::now()), limits_(limits) {
  Pipe output = make_pipe(), errors = make_pipe();
  const pid_t parent = ::getpid();
  pid_ = ::fork();
  if (pid_ == 0) run_child(work, limits, output.write, errors.write, parent);
  ::close(output.write);
  ::close(errors.write);
  output_fd_ = output.read;
  errors_fd_ = errors.read;
  if (pid_ < 0) {
    const std::string why = std::strerror(errno);
    close_if_open(output_fd_);
    close_if_open(errors_fd_);
    throw problems::OutputError("worker", "no new process: " + why);
  }
  ::setpgid(pid_, pid_);  // whoever comes first, parent or child
  ::fcntl(output_fd_, F_SETFL, O_NONBLOCK);
  ::fcntl(errors_fd_, F_SETFL, O_NONBLOCK);
}

Child::~Child() {
  if (pid_ > 0) {
    kill_group();
    ::waitpid(pid_, nullptr, 0);
  }
  close_if_open(output_fd_);
  close_if_open(errors_fd_);
}

double Child::elapsed_s() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void Child::kill_group() const {
  ::kill(-pid_, SIGKILL);
  ::kill(pid_, SIGKILL);
}

std::optional<ChildOutcome> Child::poll() {
  drain(output_fd_, outcome_.output);
  drain(errors_fd_, outcome_.errors);
  if (outcome_.errors.size() > 2 * kKeptErrors) {
    outcome_.errors.erase(0, outcome_.errors.size() - kKeptErrors);
  }
  if (!outcome_.timed_out && elapsed_s() >= limits_.wall_s) {
    outcome_.timed_out = true;
    kill_group();
  }

  int status = 0;
  rusage usage{};
  if (::wait4(pid_, &status, WNOHANG, &usage) != pid_) return std::nullopt;
  outcome_.wall_s = elapsed_s();
  ::kill(-pid_, SIGKILL);  // whatever it started and left behind
  pid_ = -1;
  std::size_t before = 0;
  do {
    before = outcome_.output.size() + outcome_.errors.size();
    drain(output_fd_, outcome_.output);
    drain(errors_fd_, outcome_.errors);
  } while (outcome_.output.size() + outcome_.errors.size() > before);
  if (outcome_.errors.size() > kKeptErrors) {
    outcome_.errors.erase(0, outcome_.errors.size() - kKeptErrors);
  }
  outcome_.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 0;
  outcome_.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  outcome_.cpu_s = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  outcome_.peak_memory_bytes = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
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
  bool closing = false;
  for (const Child* child : children) {
    if (child->output_fd() >= 0) files.push_back({child->output_fd(), POLLIN, 0});
    if (child->errors_fd() >= 0) files.push_back({child->errors_fd(), POLLIN, 0});
    if (child->output_fd() < 0) closing = true;
  }
  // A child that has closed its output is about to end, which no file tells.
  const double wait_s = closing ? 1e-3 : longest_s;
  ::poll(files.data(), files.size(), static_cast<int>(std::ceil(wait_s * 1e3)));
}

}  // namespace conebench::harness
