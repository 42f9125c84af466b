#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace conebench::harness {

/// The folder of the control groups (version 2, memory controller) below which this process may
/// make groups of its own: its own group, or the one above. Nothing where there is none; then only
/// address space is limited. Looked for once, by making a group and entering it.
const std::optional<std::filesystem::path>& memory_cgroups();

/// The first of `folder` and the one above it, no higher than `top`, that serves.
std::optional<std::filesystem::path> find_memory_cgroups(const std::filesystem::path& folder,
                                                         const std::filesystem::path& top);

/// A control group for one worker, whose processes may use `bytes` of memory together, without
/// swap; beyond, the system kills all of them. Gone with this object, once they are.
class MemoryCgroup {
 public:
  /// Throws problems::OutputError when the system does not let it.
  MemoryCgroup(const std::filesystem::path& parent, std::uint64_t bytes);
  ~MemoryCgroup();
  MemoryCgroup(const MemoryCgroup&) = delete;
  MemoryCgroup& operator=(const MemoryCgroup&) = delete;

  /// Moves the calling process into it. Throws problems::OutputError.
  void enter() const;

  /// True once the limit has cost a process its life.
  bool has_killed() const;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace conebench::harness
