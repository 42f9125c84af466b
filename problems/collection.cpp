#include "problems/collection.h"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "problems/atomic_file.h"
#include "problems/error.h"
#include "problems/features_json.h"

namespace conebench::problems {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kFormat = "conebench-collection";
constexpr int kVersion = 1;

FileFormat format_named(const std::string& name, const std::string& subject) {
  for (const FileFormat format :
       {FileFormat::kConebench, FileFormat::kFclib, FileFormat::kSiconosDat}) {
    if (name == to_string(format)) return format;
  }
  throw InputError(subject, "names the unknown format '" + name + "'");
}

std::string relative_path(const fs::path& file, const fs::path& folder) {
  const fs::path relative =
      fs::weakly_canonical(file).lexically_relative(fs::weakly_canonical(folder));
  return relative.empty() ? file.generic_string() : relative.generic_string();
}

Metadata metadata_from(const Json& json) {
  Metadata metadata;
  json.at("name").get_to(metadata.name);
  json.at("engine").get_to(metadata.engine);
  json.at("scene").get_to(metadata.scene);
  json.at("step").get_to(metadata.step);
  json.at("step_size_s").get_to(metadata.step_size_s);
  json.at("force_unit").get_to(metadata.force_unit);
  json.at("rate_unit").get_to(metadata.rate_unit);
  json.at("origin").get_to(metadata.origin);
  json.at("sampling_weight").get_to(metadata.sampling_weight);
  return metadata;
}

CollectionEntry entry_from(const Json& json, const std::string& subject) {
  CollectionEntry entry;
  json.at("path").get_to(entry.path);
  json.at("bytes").get_to(entry.bytes);
  entry.format = format_named(json.at("format").get<std::string>(), subject);
  json.at("content_sha256").get_to(entry.content_sha256);
  entry.metadata = metadata_from(json);
  const Json& eta = json.at("solution_eta");
  if (!eta.is_null()) entry.solution_eta = eta.get<double>();
  entry.features = features_from_json(json);
  return entry;
}

}  // namespace

CollectionEntry describe(const fs::path& file, const fs::path& folder) {
  const ProblemFile loaded = load_problem(file);
  CollectionEntry entry;
  entry.path = relative_path(file, folder);
  entry.bytes = fs::file_size(file);
  entry.format = file_format(file);
  entry.content_sha256 = content_sha256(loaded.problem);
  entry.metadata = loaded.problem.metadata();
  if (loaded.solution) entry.solution_eta = loaded.solution->eta;
  entry.features = loaded.problem.features();
  return entry;
}

Json to_json(const CollectionEntry& entry) {
  Json json;
  json["path"] = entry.path;
  json["bytes"] = entry.bytes;
  json["format"] = to_string(entry.format);
  json["content_sha256"] = entry.content_sha256;
  json["name"] = entry.metadata.name;
  json["engine"] = entry.metadata.engine;
  json["scene"] = entry.metadata.scene;
  json["step"] = entry.metadata.step;
  json["step_size_s"] = entry.metadata.step_size_s;
  json["force_unit"] = entry.metadata.force_unit;
  json["rate_unit"] = entry.metadata.rate_unit;
  json["origin"] = entry.metadata.origin;
  json["sampling_weight"] = entry.metadata.sampling_weight;
  json["solution_eta"] = entry.solution_eta ? Json(*entry.solution_eta) : Json();
  json.update(features_to_json(entry.features));
  return json;
}

Collection Collection::index(const fs::path& folder, std::vector<std::string>& rejected) {
  require(fs::is_directory(folder), folder.string(), "is no folder");
  Collection collection;
  collection.folder_ = folder;
  for (const fs::path& file : find_problems({folder}).files) {
    try {
      collection.entries_.push_back(describe(file, folder));
    } catch (const InputError& error) {
      rejected.emplace_back(error.what());
    }
  }
  return collection;
}

std::optional<Collection> Collection::read(const fs::path& folder) {
  const fs::path path = folder / kFileName;
  std::ifstream in(path, std::ios::binary);
  if (!in) return {};
  const std::string subject = path.string();
  Collection collection;
  collection.folder_ = folder;
  collection.written_ = fs::last_write_time(path);
  try {
    const Json json = Json::parse(in);
    require(json.at("format") == kFormat && json.at("format_version") == kVersion, subject,
            "is of another format or version, expected ", kFormat, " ", kVersion);
    for (const Json& entry : json.at("problems")) {
      collection.entries_.push_back(entry_from(entry, subject));
    }
  } catch (const Json::exception& error) {
    throw InputError(subject, error.what());
  }
  return collection;
}

void Collection::write() const {
  Json json;
  json["format"] = kFormat;
  json["format_version"] = kVersion;
  json["problems"] = Json::array();
  for (const CollectionEntry& entry : entries_) json["problems"].push_back(to_json(entry));
  const std::string text = json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
  write_file_atomically(folder_ / kFileName, std::as_bytes(std::span(text)));
}

const CollectionEntry* Collection::find_current(const fs::path& file) const {
  const std::string path = relative_path(file, folder_);
  const auto found = std::ranges::find(entries_, path, &CollectionEntry::path);
  if (found == entries_.end()) return nullptr;
  const bool current = fs::file_size(file) == found->bytes && fs::last_write_time(file) <= written_;
  return current ? &*found : nullptr;
}

}  // namespace conebench::problems
