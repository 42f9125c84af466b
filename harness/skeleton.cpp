#include "harness/skeleton.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "problems/error.h"
#include "problems/suggest.h"
#include "results/output.h"

namespace conebench::harness {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kExample = "my_solver";  // what the examples call themselves

void check_name(const std::string& name) {
  const auto allowed = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-'; };
  const bool starts_well = !name.empty() && std::isalpha(static_cast<unsigned char>(name[0])) != 0;
  problems::require(starts_well && std::all_of(name.begin(), name.end(), allowed), "NAME", "'",
                    name, "', expected letters, digits, '_' and '-', a letter first");
}

std::vector<SkeletonFile> files_of(const std::string& language) {
  std::vector<SkeletonFile> files;
  std::vector<std::string> known;
  for (const SkeletonFile& file : skeleton_files()) {
    if (file.language == language) files.push_back(file);
    if (known.empty() || known.back() != file.language) known.emplace_back(file.language);
  }
  if (!files.empty()) return files;
  throw problems::InputError(
      "--language", fmt::format("'{}'{}; known: {}", language,
                                problems::suggestion(language, known), fmt::join(known, ", ")));
}

std::string renamed(std::string_view given, const std::string& name) {
  std::string text(given);
  for (auto at = text.find(kExample); at != text.npos; at = text.find(kExample, at + name.size())) {
    text.replace(at, kExample.size(), name);
  }
  return text;
}

void make_executable(const fs::path& path) {
  std::error_code error;
  fs::permissions(path, fs::perms::owner_exec | fs::perms::group_exec | fs::perms::others_exec,
                  fs::perm_options::add, error);
  if (error) throw problems::OutputError(path.string(), error.message());
}

}  // namespace

std::vector<fs::path> write_skeleton(const std::string& name, const std::string& language,
                                     const fs::path& folder) {
  check_name(name);
  const std::vector<SkeletonFile> files = files_of(language);
  std::vector<fs::path> paths;
  for (const SkeletonFile& file : files) {
    paths.push_back(folder / renamed(file.name, name));
    problems::require(!fs::exists(paths.back()), paths.back().string(),
                      "is there already, expected a new place; -o names another");
  }
  for (std::size_t i = 0; i < files.size(); ++i) {
    results::write_text_file(paths[i], renamed(files[i].text, name));
    if (files[i].text.starts_with("#!")) make_executable(paths[i]);
  }
  return paths;
}

}  // namespace conebench::harness
