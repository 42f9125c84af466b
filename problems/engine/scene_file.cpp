#include "problems/engine/scene_file.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "problems/error.h"
#include "problems/suggest.h"

namespace conebench::engine {
namespace {

using problems::InputError;

constexpr std::int64_t kSchema = 1;
constexpr std::array<std::string_view, 2> kEngines = {"dem", "mpm"};

std::string read_file(const std::string& path) {
  std::ifstream file(path);
  problems::require(file && !std::filesystem::is_directory(path), path,
                    "cannot be read, expected a scene file");
  return {std::istreambuf_iterator<char>(file), {}};
}

SolverChoice read_solver(TomlReader in) {
  SolverChoice choice;
  choice.name = in.text("name", choice.name);
  choice.tol = in.number("tol", Range::kPositive, choice.tol);
  choice.time_limit_s = in.number("time_limit_s", Range::kPositive, choice.time_limit_s);
  choice.max_iterations = in.integer("max_iterations", 1, choice.max_iterations);
  in.finish();
  return choice;
}

std::string read_schema_and_engine(TomlReader& in) {
  if (const auto schema = in.integer("schema", 1); schema != kSchema) {
    in.fail("schema", fmt::format("found {}, expected {}", schema, kSchema));
  }
  std::string engine = in.text("engine");
  if (std::find(kEngines.begin(), kEngines.end(), engine) == kEngines.end()) {
    in.fail("engine", fmt::format("found \"{}\", expected \"dem\" or \"mpm\"", engine));
  }
  return engine;
}

}  // namespace

SceneText load_scene_text(const std::string& name_or_path, std::span<const BuiltinScene> builtin) {
  std::vector<std::string> names;
  for (const BuiltinScene& scene : builtin) {
    if (scene.name == name_or_path) return {name_or_path, std::string(scene.text)};
    names.emplace_back(scene.name);
  }
  const bool is_path = name_or_path.find('/') != std::string::npos ||
                       name_or_path.ends_with(".toml") || std::filesystem::exists(name_or_path);
  if (is_path) return {name_or_path, read_file(name_or_path)};
  throw InputError(name_or_path,
                   fmt::format("no such scene{}; known: {}",
                               problems::suggestion(name_or_path, names), fmt::join(names, ", ")));
}

toml::table parse_toml(const SceneText& scene) {
  try {
    return toml::parse(scene.text, scene.subject);
  } catch (const toml::parse_error& error) {
    throw InputError(scene.subject, fmt::format("line {}: not TOML: {}", error.source().begin.line,
                                                error.description()));
  }
}

std::int64_t SceneHeader::step_count() const {
  // A duration of 0.3 s holds 300 steps of 1e-3 s, not 301, whatever 0.3 / 1e-3 rounds to.
  return static_cast<std::int64_t>(std::ceil(duration_s / step_s * (1.0 - 1e-12)));
}

std::string read_engine(const SceneText& scene) {
  const toml::table table = parse_toml(scene);
  TomlReader in(table, "", scene.subject);
  return read_schema_and_engine(in);
}

SceneHeader read_header(TomlReader& in, std::string_view engine) {
  if (const auto found = read_schema_and_engine(in); found != engine) {
    in.fail("engine", fmt::format("found \"{}\", expected \"{}\"", found, engine));
  }
  SceneHeader header;
  header.name = in.text("name");
  if (header.name.empty() || header.name.find('/') != std::string::npos) {
    in.fail("name", fmt::format("found \"{}\", expected a name without '/'", header.name));
  }
  header.gravity_m_s2 = in.vector("gravity_m_s2", header.gravity_m_s2);
  header.step_s = in.number("step_s", Range::kPositive);
  header.duration_s = in.number("duration_s", Range::kPositive);
  header.seed = in.integer("seed", 0, header.seed);
  if (auto solver = in.table("solver")) header.solver = read_solver(std::move(*solver));
  return header;
}

std::string print_header(const SceneHeader& header, std::string_view engine,
                         std::string_view extra) {
  return fmt::format(
      "schema = {}\nengine = \"{}\"\nname = {}\ngravity_m_s2 = {}\nstep_s = {}\nduration_s = {}\n"
      "seed = {}\n{}\n[solver]\nname = {}\ntol = {}\ntime_limit_s = {}\nmax_iterations = {}\n",
      kSchema, engine, quote(header.name), show(header.gravity_m_s2), header.step_s,
      header.duration_s, header.seed, extra, quote(header.solver.name), header.solver.tol,
      header.solver.time_limit_s, header.solver.max_iterations);
}

std::string show(const Eigen::Vector3d& x, int count) {
  return fmt::format("[{}]", fmt::join(x.data(), x.data() + count, ", "));
}

std::string quote(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    const auto code = static_cast<unsigned char>(c);
    out += code < 0x20 ? fmt::format("\\u{:04x}", code) : std::string(1, c);
  }
  return out + '"';
}

}  // namespace conebench::engine
