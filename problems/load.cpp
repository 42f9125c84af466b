#include "problems/load.h"

#include <algorithm>
#include <fstream>
#include <functional>
#include <set>

#include "problems/error.h"
#include "problems/fclib.h"
#include "problems/hdf5_file.h"
#include "problems/siconos_dat.h"

namespace conebench::problems {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kHdf5Signature = "\x89HDF\r\n\x1a\n";
constexpr std::streamsize kBytesLookedAt = 256;
constexpr const char* kIndexName = "collection.json";

std::string first_bytes(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::string bytes(static_cast<std::size_t>(kBytesLookedAt), '\0');
  in.read(bytes.data(), kBytesLookedAt);
  bytes.resize(static_cast<std::size_t>(in.gcount()));
  return bytes;
}

FileFormat format_of_hdf5(const fs::path& path) {
  const hdf5::Reader reader(path);
  if (reader.has("/problem")) return FileFormat::kConebench;
  if (reader.has("/fclib_local") || reader.has("/fclib_global")) return FileFormat::kFclib;
  return FileFormat::kUnknown;
}

// A damaged HDF5 file is listed, so that whoever loads it reports it; anything else that is no
// problem file is not.
bool belongs_in_list(const fs::path& path) {
  try {
    return file_format(path) != FileFormat::kUnknown;
  } catch (const InputError&) {
    return true;
  }
}

void add_folder(const fs::path& folder, FoundProblems& found) {
  std::vector<fs::path> files;
  for (auto it =
           fs::recursive_directory_iterator(folder, fs::directory_options::skip_permission_denied);
       it != fs::recursive_directory_iterator(); ++it) {
    const bool hidden = it->path().filename().string().starts_with('.');
    if (hidden && it->is_directory()) it.disable_recursion_pending();
    const bool index = it->path().filename() == kIndexName;
    if (!hidden && !index && it->is_regular_file()) files.push_back(it->path());
  }
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files) {
    if (belongs_in_list(file)) {
      found.files.push_back(file);
    } else {
      ++found.skipped;
    }
  }
}

}  // namespace

std::string_view to_string(FileFormat format) {
  switch (format) {
    case FileFormat::kConebench:
      return "conebench";
    case FileFormat::kFclib:
      return "fclib";
    case FileFormat::kSiconosDat:
      return "siconos-dat";
    case FileFormat::kUnknown:
      return "unknown";
  }
  return "unknown";
}

FileFormat file_format(const fs::path& path) {
  const std::string bytes = first_bytes(path);
  if (bytes.starts_with(kHdf5Signature)) return format_of_hdf5(path);
  return looks_like_siconos_dat(bytes) ? FileFormat::kSiconosDat : FileFormat::kUnknown;
}

ProblemFile load_problem(const fs::path& path) {
  require(fs::exists(path), path.string(), "no such file");
  require(fs::is_regular_file(path), path.string(), "is no file, expected a problem file");
  switch (file_format(path)) {
    case FileFormat::kConebench:
      return read_problem_file(path);
    case FileFormat::kFclib:
      return read_fclib(path);
    case FileFormat::kSiconosDat:
      return read_siconos_dat(path);
    case FileFormat::kUnknown:
      break;
  }
  throw InputError(path.string(),
                   "is no problem file, expected HDF5 with /problem, /fclib_local or "
                   "/fclib_global, or Siconos' .dat text");
}

FoundProblems find_problems(const std::vector<fs::path>& paths) {
  FoundProblems found;
  for (const fs::path& path : paths) {
    require(fs::exists(path), path.string(), "no such file or folder");
    if (fs::is_directory(path)) {
      add_folder(path, found);
    } else {
      require(belongs_in_list(path), path.string(),
              "is neither HDF5 nor Siconos' .dat text, expected a problem file");
      found.files.push_back(path);
    }
  }
  std::set<fs::path> seen;
  std::erase_if(found.files, [&](const fs::path& file) {
    return !seen.insert(fs::weakly_canonical(file)).second;
  });
  return found;
}

}  // namespace conebench::problems
