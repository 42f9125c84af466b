#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace conebench::engine {

/// What a file must be to be taken: the engine's format at its version, of the scene with this text
/// (as its engine prints it).
struct CheckpointKind {
  std::string_view format;
  int version = 1;
  std::string scene_text, scene_name;
};

/// Writes `state` (an object) as CBOR, atomically. Errors: OutputError.
void write_checkpoint(const std::filesystem::path& path, const CheckpointKind& kind,
                      nlohmann::json state);

/// Reads a file and hands it to `restore`. Errors: InputError naming the file where it is
/// unreadable, of another kind or scene, or where `restore` throws, which must then have changed
/// nothing.
void read_checkpoint(const std::filesystem::path& path, const CheckpointKind& kind,
                     const std::function<void(const nlohmann::json&)>& restore);

/// The bytes of an array, so that every bit comes back.
template <class T>
nlohmann::json bytes_of(const std::vector<T>& values) {
  const auto* first = reinterpret_cast<const std::uint8_t*>(values.data());
  return nlohmann::json::binary(
      std::vector<std::uint8_t>(first, first + values.size() * sizeof(T)));
}

/// Throws std::length_error unless there are `count` values.
template <class T>
void read_bytes(const nlohmann::json& from, std::size_t count, std::vector<T>& values) {
  const auto& bytes = from.get_binary();
  if (bytes.size() != count * sizeof(T)) throw std::length_error("an array of another length");
  values.resize(count);
  std::copy(bytes.begin(), bytes.end(), reinterpret_cast<std::uint8_t*>(values.data()));
}

}  // namespace conebench::engine
