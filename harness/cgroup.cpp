#include "harness/cgroup.h"

#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string>

#include "problems/error.h"

namespace conebench::harness {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kTrialBytes = std::uint64_t{1} << 30;

void write(const fs::path& file, const std::string& text) {
  std::ofstream out(file);
  out << text << std::flush;
  if (!out) throw problems::OutputError(file.string(), "cannot write \"" + text + "\"");
}

// True if `name` is a word of the file's first line.
bool lists(const fs::path& file, const std::string& name) {
  std::ifstream in(file);
  for (std::string word; in >> word;) {
    if (word == name) return true;
  }
  return false;
}

// A process that enters a trial group says more than permissions do.
bool serves(const fs::path& folder) {
  if (!lists(folder / "cgroup.subtree_control", "memory")) return false;
  try {
    const MemoryCgroup trial(folder, kTrialBytes);
    const pid_t child = ::fork();
    if (child == 0) {
      try {
        trial.enter();
      } catch (const problems::OutputError&) {
        ::_exit(1);
      }
      ::_exit(0);
    }
    int status = 1;
    while (child > 0 && ::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return status == 0;
  } catch (const problems::OutputError&) {
    return false;
  }
}

// Where control groups of version 2 are mounted; empty if nowhere.
fs::path mount_point() {
  std::ifstream mounts("/proc/self/mounts");
  for (std::string device, point, type, rest; mounts >> device >> point >> type;) {
    if (type == "cgroup2") return point;
    std::getline(mounts, rest);
  }
  return {};
}

// This process's group below the mount point, from the line "0::/user.slice/...".
std::string own_group() {
  std::ifstream groups("/proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    if (line.starts_with("0::/")) return line.substr(4);
  }
  return {};
}

}  // namespace

const std::optional<fs::path>& memory_cgroups() {
  static const std::optional<fs::path> found = [] {
    const fs::path top = mount_point();
    return top.empty() ? std::nullopt : find_memory_cgroups(top / own_group(), top);
  }();
  return found;
}

std::optional<fs::path> find_memory_cgroups(const fs::path& folder, const fs::path& top) {
  const fs::path own = (folder / "").lexically_normal().parent_path();
  if (serves(own)) return own;
  const bool is_top = own == (top / "").lexically_normal().parent_path();
  if (!is_top && serves(own.parent_path())) return own.parent_path();
  return std::nullopt;
}

MemoryCgroup::MemoryCgroup(const fs::path& parent, std::uint64_t bytes)
    : path_(parent / ("conebench-" + std::to_string(::getpid()))) {
  if (::mkdir(path_.c_str(), 0755) != 0 && errno != EEXIST) {
    throw problems::OutputError(path_.string(), std::strerror(errno));
  }
  write(path_ / "memory.max", std::to_string(bytes));
  write(path_ / "memory.oom.group", "1");
  if (fs::exists(path_ / "memory.swap.max")) write(path_ / "memory.swap.max", "0");
}

MemoryCgroup::~MemoryCgroup() { ::rmdir(path_.c_str()); }

void MemoryCgroup::enter() const { write(path_ / "cgroup.procs", "0"); }

bool MemoryCgroup::has_killed() const {
  std::ifstream events(path_ / "memory.events");
  std::string name;
  for (std::uint64_t count = 0; events >> name >> count;) {
    if (name == "oom_kill") return count > 0;
  }
  return false;
}

}  // namespace conebench::harness
