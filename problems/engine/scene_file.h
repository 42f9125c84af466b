#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "problems/engine/step_solver.h"
#include "problems/engine/toml_reader.h"

namespace conebench::engine {

/// A scene file carried inside the program.
struct BuiltinScene {
  std::string_view name;  ///< the file's name without .toml
  std::string_view text;
};

/// The text of a scene, and what errors call it.
struct SceneText {
  std::string subject, text;
};

/// A built-in scene by its name, or a file by its path (anything with a '/' or ".toml", or that is
/// there). Throws InputError, with a suggestion where a name is close to a known one.
SceneText load_scene_text(const std::string& name_or_path, std::span<const BuiltinScene> builtin);

/// Parses TOML. Throws InputError naming the line.
toml::table parse_toml(const SceneText& scene);

/// The scene with other values, each "PATH=VALUE": a path is dotted, with places in arrays, such as
/// material.friction or blocks[0].high_m[1]; a value is TOML, or a bare word for a string. The last
/// key of a path may be new (the engine's parser judges it), what leads to it must be there.
/// Throws InputError.
SceneText with_overrides(const SceneText& scene, std::span<const std::string> overrides);

/// What a scene says before anything that its engine understands.
struct SceneHeader {
  std::string name;
  Eigen::Vector3d gravity_m_s2{0.0, 0.0, -9.81};
  double step_s = 0.0;  ///< the largest step
  double duration_s = 0.0;
  std::int64_t seed = 1;  ///< of the generators
  SolverChoice solver;

  /// The steps of step_s that fill duration_s.
  std::int64_t step_count() const;
};

/// The engine that a scene file names. Throws InputError unless schema and engine are known.
std::string read_engine(const SceneText& scene);

/// Reads the header's keys, [solver] included; `engine` must be what the file says.
SceneHeader read_header(TomlReader& in, std::string_view engine);

/// The header as TOML, [solver] included: write it after the engine's own plain keys, `extra`.
std::string print_header(const SceneHeader& header, std::string_view engine,
                         std::string_view extra);

/// Shortest digits that read back as the same double, of the first `count` entries; and a TOML
/// basic string.
std::string show(const Eigen::Vector3d& x, int count = 3);
std::string quote(std::string_view text);

}  // namespace conebench::engine
