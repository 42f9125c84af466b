#include "problems/engine/checkpoint.h"

#include <fstream>
#include <iterator>
#include <span>

#include "problems/atomic_file.h"
#include "problems/error.h"

namespace conebench::engine {
namespace {

using nlohmann::json;

std::vector<std::uint8_t> read_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  problems::require(file && !std::filesystem::is_directory(path), path.string(),
                    "cannot be read, expected a checkpoint");
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

void write_checkpoint(const std::filesystem::path& path, const CheckpointKind& kind, json state) {
  state["format"] = kind.format;
  state["version"] = kind.version;
  state["scene"] = kind.scene_text;
  const std::vector<std::uint8_t> bytes = json::to_cbor(state);
  problems::write_file_atomically(path, std::as_bytes(std::span(bytes)));
}

void read_checkpoint(const std::filesystem::path& path, const CheckpointKind& kind,
                     const std::function<void(const json&)>& restore) {
  const std::vector<std::uint8_t> bytes = read_file(path);
  try {
    const json in = json::from_cbor(bytes);
    problems::require(in.at("format") == kind.format && in.at("version") == kind.version,
                      path.string(), "not a checkpoint of this version, expected ", kind.format,
                      " ", kind.version);
    problems::require(in.at("scene") == kind.scene_text, path.string(),
                      "is of another scene, or of other settings, than ", kind.scene_name);
    restore(in);
  } catch (const problems::InputError&) {
    throw;
  } catch (const std::exception& error) {
    throw problems::InputError(path.string(),
                               std::string("not a whole checkpoint: ") + error.what());
  }
}

}  // namespace conebench::engine
