#include "harness/problem_id.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <variant>

#include "harness/error_text.h"
#include "harness/pool.h"
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

std::string identify(const std::filesystem::path& path) {
  try {
    ProblemId id;
    complete(id, problems::load_problem(path).problem);
    return json({{"name", id.name},
                 {"sha", id.content_sha256},
                 {"family", id.family},
                 {"cones", id.cones}})
        .dump(-1, ' ', false, json::error_handler_t::replace);
  } catch (const problems::InputError& error) {
    return json({{"error", error.what()}}).dump(-1, ' ', false, json::error_handler_t::replace);
  }
}

// The identity, or why there is none.
std::variant<ProblemId, std::string> identity_of(const std::filesystem::path& path,
                                                 const ChildOutcome& outcome) {
  const json message = json::parse(outcome.output, nullptr, false);
  if (message.is_discarded()) {
    return fmt::format("{}: the reader ended: {}", path.string(), describe_end(outcome));
  }
  if (message.contains("error")) return std::string(message["error"]);
  return ProblemId{.name = message["name"],
                   .content_sha256 = message["sha"],
                   .path = path.string(),
                   .family = message["family"],
                   .cones = message["cones"]};
}

}  // namespace

void complete(ProblemId& id, const problems::Problem& problem) {
  if (id.name.empty()) id.name = problem.name();
  if (id.family.empty()) id.family = family_of(problem.metadata());
  if (id.content_sha256.empty()) id.content_sha256 = problems::content_sha256(problem);
  id.cones = problem.cone_count();
}

ProblemSource source_from_file(const std::filesystem::path& path) {
  ProblemSource source;
  source.id.path = path.string();
  source.load = [path] { return problems::load_problem(path).problem; };
  return source;
}

FoundSources find_sources(const std::vector<std::filesystem::path>& paths, int jobs) {
  const problems::FoundProblems files = problems::find_problems(paths);
  FoundSources found;
  found.skipped = files.skipped;
  std::vector<std::variant<ProblemId, std::string>> identities(files.files.size());
  const bool complete_run =
      run_pool(files.files.size(), jobs,
               {.make = [&](std::size_t i) -> Job {
                  return {.work = [path = files.files[i]] { return identify(path); },
                          .limits = {.wall_s = kLoadLimit_s, .memory_bytes = 0}};
                },
                .done =
                    [&](std::size_t i, const ChildOutcome& outcome) {
                      identities[i] = identity_of(files.files[i], outcome);
                    },
                .tick = {}});
  found.interrupted = !complete_run;
  if (found.interrupted) return found;

  std::set<std::string> seen;
  for (std::size_t i = 0; i < identities.size(); ++i) {
    if (const auto* why = std::get_if<std::string>(&identities[i])) {
      const bool named = std::find(paths.begin(), paths.end(), files.files[i]) != paths.end();
      if (named) throw input_error(*why, files.files[i].string());
      found.unreadable.push_back(*why);
      continue;
    }
    const auto& id = std::get<ProblemId>(identities[i]);
    if (!seen.insert(id.content_sha256).second) {
      ++found.twins;
      continue;
    }
    found.problems.push_back(source_from_file(files.files[i]));
    found.problems.back().id = id;
  }
  problems::require(!found.problems.empty(), "-p", "no problem file in the given paths");
  return found;
}

}  // namespace conebench::harness
