#include "harness/plan_file.h"

#include <fstream>
#include <nlohmann/json.hpp>

#include "problems/error.h"
#include "results/output.h"

namespace conebench::harness {
namespace {

using nlohmann::json;

constexpr int kVersion = 1;

json to_json(const Study& study) {
  return {{"problems", study.problems},
          {"where", study.where},
          {"solvers", study.solvers},
          {"tol", study.tolerances},
          {"mode", study.modes},
          {"donors", study.donors},
          {"threads", study.threads},
          {"time_limit", study.time_limit},
          {"hard_limit", study.hard_limit},
          {"memory", study.memory},
          {"stop", study.stop},
          {"repetitions", study.repetitions},
          {"seed", study.seed}};
}

Study study_from(const json& j) {
  return {.problems = j.at("problems"),
          .where = j.at("where"),
          .solvers = j.at("solvers"),
          .tolerances = j.at("tol"),
          .modes = j.at("mode"),
          .donors = j.at("donors"),
          .threads = j.at("threads"),
          .time_limit = j.at("time_limit"),
          .hard_limit = j.at("hard_limit"),
          .memory = j.at("memory"),
          .stop = j.at("stop"),
          .repetitions = j.at("repetitions"),
          .seed = j.at("seed")};
}

json to_json(const ProblemSource& source) {
  return {{"name", source.id.name},
          {"content_sha256", source.id.content_sha256},
          {"path", std::filesystem::absolute(source.id.path).string()},
          {"family", source.id.family},
          {"cones", source.id.cones},
          {"step", source.step},
          {"has_guess", source.has_guess}};
}

ProblemSource source_from(const json& j) {
  return source_from_file({.name = j.at("name"),
                           .content_sha256 = j.at("content_sha256"),
                           .path = j.at("path"),
                           .family = j.at("family"),
                           .cones = j.at("cones")},
                          j.at("step"), j.at("has_guess"));
}

}  // namespace

std::filesystem::path plan_path(const std::filesystem::path& results_dir) {
  return results_dir / "plan.json";
}

void write_plan(const std::filesystem::path& results_dir, const PlanFile& plan) {
  json problems = json::array();
  for (const ProblemSource& source : plan.problems) problems.push_back(to_json(source));
  const json file = {{"format", "conebench-plan"},
                     {"format_version", kVersion},
                     {"study", to_json(plan.study)},
                     {"problems", problems}};
  results::write_text_file(plan_path(results_dir),
                           file.dump(1, ' ', false, json::error_handler_t::replace) + "\n");
}

PlanFile read_plan(const std::filesystem::path& results_dir) {
  const std::string path = plan_path(results_dir).string();
  problems::require(std::filesystem::exists(path), path,
                    "does not exist; make it with `conebench plan`, or give -p or -c");
  std::ifstream file(path);
  const json j = json::parse(file, nullptr, false);
  problems::require(j.is_object() && j.value("format", "") == "conebench-plan", path,
                    "is no plan of conebench");
  problems::require(j.value("format_version", 0) == kVersion, path, "has format_version ",
                    j.value("format_version", 0), ", expected ", kVersion);
  PlanFile plan;
  try {
    plan.study = study_from(j.at("study"));
    for (const json& source : j.at("problems")) plan.problems.push_back(source_from(source));
  } catch (const json::exception& error) {
    throw problems::InputError(path, error.what());
  }
  return plan;
}

}  // namespace conebench::harness
