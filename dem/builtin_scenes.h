#pragma once

#include <span>
#include <string_view>

namespace conebench::dem {

/// A scene file of dem/scenes, carried inside the program.
struct BuiltinScene {
  std::string_view name;  ///< the file's name without .toml
  std::string_view text;
};

/// In alphabetical order. Defined in a source that embed_scenes.cmake writes.
std::span<const BuiltinScene> builtin_scenes();

}  // namespace conebench::dem
