#include "harness/solver_build.h"

#include <elf.h>
#include <fmt/format.h>
#include <link.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <span>
#include <sstream>

#include "problems/error.h"
#include "results/record.h"

namespace conebench::harness {
namespace {

namespace fs = std::filesystem;

// Notes are a header, a name and a content, the last two padded to four bytes.
std::size_t padded(std::size_t bytes) { return (bytes + 3) / 4 * 4; }

std::string build_id_in(std::span<const unsigned char> notes) {
  for (std::size_t at = 0; at + sizeof(ElfW(Nhdr)) <= notes.size();) {
    ElfW(Nhdr) header;
    std::memcpy(&header, &notes[at], sizeof header);
    const std::size_t name = at + sizeof header, content = name + padded(header.n_namesz);
    if (header.n_type == NT_GNU_BUILD_ID && std::memcmp(&notes[name], "GNU", 4) == 0) {
      return fmt::format("{:02x}", fmt::join(notes.subspan(content, header.n_descsz), ""));
    }
    at = content + padded(header.n_descsz);
  }
  return {};
}

// Called for the program first; looks no further.
int find_build_id(dl_phdr_info* info, std::size_t, void* found) {
  for (const ElfW(Phdr) & part : std::span(info->dlpi_phdr, info->dlpi_phnum)) {
    if (part.p_type != PT_NOTE) continue;
    const auto* start = reinterpret_cast<const unsigned char*>(info->dlpi_addr + part.p_vaddr);
    auto& id = *static_cast<std::string*>(found);
    if (id.empty()) id = build_id_in({start, part.p_memsz});
  }
  return 1;
}

std::string own_build_id() {
  std::string id;
  ::dl_iterate_phdr(find_build_id, &id);
  problems::require(!id.empty(), "this program", "has no build-id, expected one: -Wl,--build-id");
  return id;
}

std::string hash_of_file(const fs::path& path) {
  std::stringstream content;
  content << std::ifstream(path, std::ios::binary).rdbuf();
  problems::require(!content.str().empty(), path.string(), "cannot be read, or is empty");
  return results::short_hash(content.str());
}

struct HashedFile {
  std::uintmax_t size = 0;
  fs::file_time_type time;
  std::string hash;
};

std::string cached_hash_of_file(const fs::path& path) {
  static std::map<fs::path, HashedFile> known;
  std::error_code size_error, time_error;
  const std::uintmax_t size = fs::file_size(path, size_error);
  const fs::file_time_type time = fs::last_write_time(path, time_error);
  problems::require(!size_error && !time_error, path.string(), "is no file any more");
  HashedFile& entry = known[path];
  if (entry.hash.empty() || entry.size != size || entry.time != time) {
    entry = {size, time, hash_of_file(path)};
  }
  return entry.hash;
}

}  // namespace

std::string build_of(const solvers::Solver& solver) {
  if (!solver.program.empty()) return cached_hash_of_file(solver.program);
  static const std::string own = own_build_id();
  return own;
}

}  // namespace conebench::harness
