#pragma once

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "harness/child.h"

namespace conebench::harness {

// A run that takes this much longer than its limit has not kept it.
constexpr double kLate_s = 2.0;

inline ChildOutcome run(const std::function<std::string()>& work, const ChildLimits& limits = {}) {
  Child child(work, limits);
  while (true) {
    if (const auto outcome = child.poll()) return *outcome;
    wait_for_news({&child}, 60.0);
  }
}

// 'R', 'S', 'Z', ... of /proc/PID/stat; 'X' if there is no such process.
inline char state_of(pid_t pid) {
  std::ifstream stat("/proc/" + std::to_string(pid) + "/stat");
  std::string number, name, state;
  return stat >> number >> name >> state ? state[0] : 'X';
}

// A file into which the processes of a test write their numbers, each on a line.
class Roll {
 public:
  Roll() : path_(testing::TempDir() + "conebench-roll-" + std::to_string(::getpid())) {
    std::filesystem::remove(path_);
  }
  ~Roll() { std::filesystem::remove(path_); }

  void sign() const {
    const std::string line = std::to_string(::getpid()) + "\n";
    const int fd = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
    if (::write(fd, line.data(), line.size()) < 0) ::_exit(1);
    ::close(fd);
  }

  std::vector<pid_t> pids() const {
    std::ifstream file(path_);
    return {std::istream_iterator<pid_t>(file), std::istream_iterator<pid_t>()};
  }

  void wait_for(std::size_t count) const {
    while (pids().size() < count) ::usleep(1000);
  }

  void expect_all_gone(std::size_t count) const {
    EXPECT_EQ(pids().size(), count);
    for (const pid_t pid : pids()) EXPECT_EQ(state_of(pid), 'X') << pid;
  }

 private:
  std::string path_;
};

[[noreturn]] inline void linger() {
  for (;;) ::pause();
}

[[noreturn]] inline void spin() {
  for (;;) static_cast<void>(::getppid());
}

inline void ignore(int signal) { std::signal(signal, SIG_IGN); }
}  // namespace conebench::harness
