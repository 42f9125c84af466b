#include "harness/problem_id.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <variant>

#include "harness/error_text.h"
#include "harness/pool.h"
#include "harness/where.h"
#include "problems/collection.h"
#include "problems/load.h"

namespace conebench::harness {
namespace {

using nlohmann::json;
using results::ProblemId;

constexpr double kLoadLimit_s = 120.0;

std::string family_of(const problems::Metadata& metadata) {
  if (metadata.engine.empty() || metadata.scene.empty()) return metadata.engine + metadata.scene;
  return metadata.engine + "/" + metadata.scene;
}

bool wanted(const std::filesystem::path& path, const std::string& where) {
  if (where.empty()) return true;
  const problems::CollectionEntry entry = problems::describe(path, path.parent_path());
  return Where(where).matches(problems::to_json(entry));
}

std::string identify(const std::filesystem::path& path, const std::string& where) {
  try {
    if (!wanted(path, where)) return json({{"unwanted", true}}).dump();
    const problems::ProblemFile file = problems::load_problem(path);
    ProblemId id;
    complete(id, file.problem);
    return json({{"name", id.name},
                 {"sha", id.content_sha256},
                 {"family", id.family},
                 {"cones", id.cones},
                 {"step", file.problem.metadata().step},
                 {"has_guess", file.guess.size() > 0}})
        .dump(-1, ' ', false, json::error_handler_t::replace);
  } catch (const problems::InputError& error) {
    return json({{"error", error.what()}, {"subject", error.subject()}})
        .dump(-1, ' ', false, json::error_handler_t::replace);
  }
}

struct Unwanted {};
// The source, or why there is none.
using Finding = std::variant<ProblemSource, std::string, Unwanted>;

Finding source_of(const std::filesystem::path& path, const ChildOutcome& outcome) {
  const json message = json::parse(outcome.output, nullptr, false);
  if (message.is_discarded()) {
    return fmt::format("{}: the reader ended: {}", path.string(), describe_end(outcome));
  }
  if (message.contains("unwanted")) return Unwanted{};
  if (message.contains("error")) {
    if (message["subject"] == "--where") throw input_error(message["error"], message["subject"]);
    return std::string(message["error"]);
  }
  return source_from_file({.name = message["name"],
                           .content_sha256 = message["sha"],
                           .path = path.string(),
                           .family = message["family"],
                           .cones = message["cones"]},
                          message["step"], message["has_guess"]);
}

}  // namespace

void complete(ProblemId& id, const problems::Problem& problem) {
  if (id.name.empty()) id.name = problem.name();
  if (id.family.empty()) id.family = family_of(problem.metadata());
  if (id.content_sha256.empty()) id.content_sha256 = problems::content_sha256(problem);
  id.cones = problem.cone_count();
}

problems::ProblemFile only(problems::Problem problem) {
  return {.problem = std::move(problem), .geometry = {}, .guess = {}, .solution = {}};
}

ProblemSource source_from_file(const std::filesystem::path& path) {
  return source_from_file({.path = path.string()}, 0, false);
}

ProblemSource source_from_file(const ProblemId& id, std::int64_t step, bool has_guess) {
  return {.id = id,
          .load = [path = id.path] { return problems::load_problem(path); },
          .step = step,
          .has_guess = has_guess};
}

FoundSources find_sources(const std::vector<std::filesystem::path>& paths, int jobs,
                          const std::string& where) {
  if (!where.empty()) Where{where};
  const problems::FoundProblems files = problems::find_problems(paths);
  FoundSources found;
  found.skipped = files.skipped;
  std::vector<Finding> sources(files.files.size());
  const bool complete_run =
      run_pool(files.files.size(), jobs,
               {.make = [&](std::size_t i) -> Job {
                  return {.work = [path = files.files[i], where] { return identify(path, where); },
                          .limits = {.wall_s = kLoadLimit_s, .memory_bytes = 0}};
                },
                .done =
                    [&](std::size_t i, const ChildOutcome& outcome) {
                      sources[i] = source_of(files.files[i], outcome);
                    },
                .tick = {}});
  found.interrupted = !complete_run;
  if (found.interrupted) return found;

  std::set<std::string> seen;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    if (const auto* why = std::get_if<std::string>(&sources[i])) {
      const bool named = std::find(paths.begin(), paths.end(), files.files[i]) != paths.end();
      if (named) throw input_error(*why, files.files[i].string());
      found.unreadable.push_back(*why);
      continue;
    }
    if (std::holds_alternative<Unwanted>(sources[i])) {
      ++found.unwanted;
      continue;
    }
    const auto& source = std::get<ProblemSource>(sources[i]);
    if (!seen.insert(source.id.content_sha256).second) {
      ++found.twins;
      continue;
    }
    found.problems.push_back(source);
  }
  problems::require(!found.problems.empty(), "-p", "no problem file in the given paths",
                    found.unwanted > 0 ? " that the condition lets through" : "");
  return found;
}

}  // namespace conebench::harness
