#pragma once

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "problems/load.h"

namespace conebench::problems {

/// What an index says of one problem file.
struct CollectionEntry {
  std::string path;          ///< relative to the collection's folder, '/' between names
  std::uintmax_t bytes = 0;  ///< size of the file
  FileFormat format = FileFormat::kUnknown;
  std::string content_sha256;
  Metadata metadata;
  std::optional<double> solution_eta;  ///< of a stored solution
  Features features;
};

/// Reads one problem and describes it; `path` is made relative to `folder`. Costs the reading and
/// Problem::features(). Throws InputError.
CollectionEntry describe(const std::filesystem::path& file, const std::filesystem::path& folder);

/// One flat object: the members above beside the features (problems/features_json.h), always with
/// the same keys; solution_eta is null without a solution.
nlohmann::ordered_json to_json(const CollectionEntry& entry);

/// The file `collection.json` of a folder: a convenience that saves reading every problem. Nobody
/// needs it; it is the only file that is ever written into a folder of inputs.
class Collection {
 public:
  static constexpr const char* kFileName = "collection.json";

  /// Describes every problem under `folder`. Damaged files are left out and named in `rejected`.
  static Collection index(const std::filesystem::path& folder, std::vector<std::string>& rejected);

  /// The index in `folder`; nothing when there is none. Throws InputError when it is damaged.
  static std::optional<Collection> read(const std::filesystem::path& folder);

  /// Writes collection.json into the folder, atomically. Throws OutputError.
  void write() const;

  const std::vector<CollectionEntry>& entries() const { return entries_; }

  /// The entry of `file` when the index is still true of it: same size, not changed since.
  const CollectionEntry* find_current(const std::filesystem::path& file) const;

 private:
  std::filesystem::path folder_;
  std::filesystem::file_time_type written_{};
  std::vector<CollectionEntry> entries_;
};

}  // namespace conebench::problems
