// conebench problem list|show|verify|import|export|index|stats; shrink: problem_shrink.cpp

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <set>

#include "harness/commands/commands.h"
#include "harness/commands/problem_proofs.h"
#include "harness/commands/problem_shrink.h"
#include "harness/commands/text_output.h"
#include "harness/interrupt.h"
#include "harness/units.h"
#include "harness/where.h"
#include "problems/collection.h"
#include "problems/error.h"
#include "problems/fclib.h"
#include "problems/load.h"
#include "problems/residual.h"

namespace conebench::harness {
namespace {

namespace fs = std::filesystem;
using problems::Collection;
using problems::CollectionEntry;
using problems::InputError;

constexpr int kBadInput = 2;

struct Options {
  std::vector<std::string> paths;
  std::string where, output, format = "conebench", time_limit = "10s";
  bool json = false, standard = false, certificate = false;
};

std::string range_text(const Json& facts, const std::string& name) {
  const double low = facts.at(name + "_min").get<double>();
  const double high = facts.at(name + "_max").get<double>();
  return low == high ? fmt::format("{:.3g}", low) : fmt::format("{:.3g}..{:.3g}", low, high);
}

std::vector<fs::path> as_paths(const std::vector<std::string>& texts) {
  return {texts.begin(), texts.end()};
}

// The indexes of the folders that have one. They only save time, so a damaged one is passed over.
std::vector<Collection> read_indexes(const std::vector<fs::path>& paths) {
  std::vector<Collection> indexes;
  for (const fs::path& path : paths) {
    if (!fs::is_directory(path)) continue;
    try {
      if (auto index = Collection::read(path)) indexes.push_back(std::move(*index));
    } catch (const InputError& error) {
      fmt::print(stderr, "note: {} (passed over)\n", error.what());
    }
  }
  return indexes;
}

CollectionEntry describe_or_recall(const fs::path& file, const std::vector<Collection>& indexes) {
  for (const Collection& index : indexes) {
    if (const CollectionEntry* entry = index.find_current(file)) {
      CollectionEntry recalled = *entry;
      recalled.path = file.generic_string();
      return recalled;
    }
  }
  CollectionEntry entry = problems::describe(file, file.parent_path());
  entry.path = file.generic_string();
  return entry;
}

struct Facts {
  std::vector<Json> problems;  // one for each content, with the key `copies`
  int duplicates = 0;
};

// Describes the problems that `--where` lets through. A file that cannot be read is named on
// stderr and makes the exit code 2; the others are described all the same.
Facts gather(const Options& options, int& exit_code) {
  const std::vector<fs::path> paths = as_paths(options.paths);
  const Where where(options.where.empty() ? "true" : options.where);
  const problems::FoundProblems found = problems::find_problems(paths);
  const std::vector<Collection> indexes = read_indexes(paths);
  Facts facts;
  std::map<std::string, std::size_t> position;
  for (const fs::path& file : found.files) {
    try {
      Json json = problems::to_json(describe_or_recall(file, indexes));
      if (!where.matches(json)) continue;
      const auto [at, is_new] =
          position.try_emplace(json.at("content_sha256"), facts.problems.size());
      json["copies"] = 1;
      if (is_new) {
        facts.problems.push_back(std::move(json));
      } else {
        Json& copies = facts.problems[at->second]["copies"];
        copies = copies.get<int>() + 1;
        ++facts.duplicates;
      }
    } catch (const InputError& error) {
      if (error.subject() == "--where") throw;
      fmt::print(stderr, "conebench: {}\n", error.what());
      exit_code = kBadInput;
    }
  }
  if (found.skipped > 0) {
    fmt::print(stderr, "{} file(s) that are no problems were skipped\n", found.skipped);
  }
  return facts;
}

void list(const Options& options, int& exit_code) {
  const Facts facts = gather(options, exit_code);
  if (options.json) return print_json(Json(facts.problems));
  std::vector<std::vector<std::string>> rows{{"problem", "format", "engine", "cones", "dim", "dofs",
                                              "mu", "kappa", "islands", "copies", "sha256"}};
  for (const Json& p : facts.problems) {
    rows.push_back({text_of(p["path"]), text_of(p["format"]), text_of(p["engine"]),
                    text_of(p["cones"]), range_text(p, "dim"),
                    p["primal"].get<bool>() ? text_of(p["dofs"]) : "-", range_text(p, "mu"),
                    range_text(p, "kappa"), text_of(p["islands"]), text_of(p["copies"]),
                    p["content_sha256"].get<std::string>().substr(0, 8)});
  }
  print_table(rows, 3);
  fmt::print(stderr, "{} problem(s), {} duplicate(s)\n", facts.problems.size(), facts.duplicates);
}

void show(const Options& options, int& exit_code) {
  const Facts facts = gather(options, exit_code);
  if (options.json) {
    return print_json(facts.problems.size() == 1 ? facts.problems.front() : Json(facts.problems));
  }
  for (const Json& problem : facts.problems) {
    std::vector<std::vector<std::string>> rows;
    for (const auto& [key, value] : problem.items()) rows.push_back({key, text_of(value)});
    print_table(rows, 2);
    if (&problem != &facts.problems.back()) fmt::print("\n");
  }
}

// Reading checks everything, the hash included; what is left is the stored solution.
Json verify_file(const fs::path& file) {
  Json result{{"path", file.generic_string()}, {"ok", true}, {"eta", nullptr}, {"reason", ""}};
  try {
    const problems::ProblemFile loaded = problems::load_problem(file);
    result["content_sha256"] = problems::content_sha256(loaded.problem);
    if (!loaded.solution) return result;
    const problems::Residual found =
        problems::evaluate_residual(loaded.problem.shifted(), loaded.solution->r);
    const double claimed = loaded.solution->eta;
    result["eta"] = found.eta.max;
    // Another machine rounds differently: by a few ulps of what cancels in u.
    const double slack = 1e-6 * found.eta.max + 100.0 * found.attainable_eta;
    if (!(found.eta.max <= claimed + slack)) {
      result["ok"] = false;
      result["reason"] =
          fmt::format("/solution claims eta = {:.6g}, found {:.6g}", claimed, found.eta.max);
    }
  } catch (const InputError& error) {
    result["ok"] = false;
    result["reason"] = error.what();
  }
  return result;
}

void verify(const Options& options, int& exit_code) {
  Json results = Json::array();
  std::vector<std::vector<std::string>> rows{{"problem", "verdict", "eta"}};
  for (const fs::path& file : problems::find_problems(as_paths(options.paths)).files) {
    const Json result = verify_file(file);
    const bool ok = result["ok"].get<bool>();
    if (!ok) {
      exit_code = kBadInput;
      fmt::print(stderr, "conebench: {}\n", result["reason"].get<std::string>());
    }
    rows.push_back({text_of(result["path"]), ok ? "ok" : "bad",
                    result["eta"].is_null() ? "-" : text_of(result["eta"])});
    results.push_back(result);
  }
  if (options.json) return print_json(results);
  print_table(rows, 2);
}

void import(const Options& options) {
  const fs::path folder = options.output;
  fs::create_directories(folder);
  const problems::FoundProblems found = problems::find_problems(as_paths(options.paths));
  std::set<std::string> contents;
  std::set<fs::path> written;
  for (const fs::path& file : found.files) {
    const problems::ProblemFile loaded = problems::load_problem(file);
    const std::string hash = problems::content_sha256(loaded.problem);
    if (!contents.insert(hash).second) {
      fmt::print(stderr, "{}: the same problem as one before, not imported again\n", file.string());
      continue;
    }
    const std::string stem = file.stem().string();
    fs::path target = folder / (stem + ".h5");
    if (written.contains(target)) target = folder / (stem + "_" + hash.substr(0, 8) + ".h5");
    problems::require(!fs::exists(target) || !fs::equivalent(target, file), file.string(),
                      "would be overwritten by its own import, expected another folder");
    problems::write_problem_file(target, loaded);
    written.insert(target);
    fmt::print("{}\n", target.string());
  }
}

// The standard problem has the same reactions r', so guess and solution stay as they are.
void export_problem(const Options& options) {
  problems::ProblemFile file = problems::load_problem(options.paths.front());
  if (options.standard) file.problem = file.problem.shifted();
  const fs::path target = options.output;
  problems::require(!fs::exists(target) || !fs::equivalent(target, options.paths.front()),
                    options.output, "is the input itself, expected another file");
  if (options.format == "fclib") {
    problems::write_fclib_file(target, file);
  } else {
    problems::write_problem_file(target, file);
  }
}

void index(const Options& options, int& exit_code) {
  for (const std::string& path : options.paths) {
    std::vector<std::string> rejected;
    const Collection collection = Collection::index(path, rejected);
    collection.write();
    for (const std::string& reason : rejected) fmt::print(stderr, "conebench: {}\n", reason);
    if (!rejected.empty()) exit_code = kBadInput;
    fmt::print("{}: {} problem(s)\n", (fs::path(path) / Collection::kFileName).string(),
               collection.entries().size());
  }
}

Json spread(const std::vector<Json>& entries, const std::string& key) {
  std::vector<double> values;
  for (const Json& entry : entries) values.push_back(entry.at(key).get<double>());
  std::ranges::sort(values);
  const std::size_t middle = values.size() / 2;
  const double median =
      values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
  return {{"min", values.front()}, {"median", median}, {"max", values.back()}};
}

void stats(const Options& options, int& exit_code) {
  const double time_limit_s = parse_duration_s(options.time_limit, "--time-limit");
  const Facts facts = gather(options, exit_code);
  Json json{{"problems", facts.problems.size()}, {"duplicates", facts.duplicates}};
  json["of_engine"] = json["of_format"] = Json::object();
  for (const Json& entry : facts.problems) {
    for (const char* key : {"engine", "format"}) {
      Json& count = json[std::string("of_") + key][text_of(entry.at(key))];
      count = (count.is_null() ? 0 : count.get<int>()) + 1;
    }
  }
  std::vector<std::vector<std::string>> rows{{"feature", "min", "median", "max"}};
  static constexpr const char* kFeatures[] = {
      "cones",  "dim_min", "dim_max",        "dofs",           "rows_per_dof", "mu_min",
      "mu_max", "islands", "largest_island", "cohesive_share", "asymmetry",    "rate_scale"};
  for (const char* key : kFeatures) {
    if (facts.problems.empty()) break;
    const Json s = json["features"][key] = spread(facts.problems, key);
    rows.push_back({key, text_of(s["min"]), text_of(s["median"]), text_of(s["max"])});
  }
  if (!options.json) {
    fmt::print("{} problem(s), {} duplicate(s); engines {}; formats {}\n", facts.problems.size(),
               facts.duplicates, json["of_engine"].dump(), json["of_format"].dump());
    print_table(rows, 1);
  }
  if (options.certificate) {
    if (!options.json) fmt::print("\n");
    json["certificates"] = prove_all(facts.problems, time_limit_s, options.json, exit_code);
  }
  if (options.json && exit_code != kInterruptedExit) print_json(json);
}

using Action = void (*)(const Options&, int&);

CLI::App* add_verb(CLI::App& parent, const std::string& name, const std::string& help,
                   const std::shared_ptr<Options>& options, int& exit_code, Action action) {
  CLI::App* verb = parent.add_subcommand(name, help);
  verb->add_option("path", options->paths, "problem files, or folders of them")
      ->type_name("")
      ->required();
  verb->callback([options, &exit_code, action] { action(*options, exit_code); });
  return verb;
}

}  // namespace

void add_problem(CLI::App& app, int& exit_code) {
  CLI::App* problem = app.add_subcommand("problem", "list, check and convert problem files");
  problem->require_subcommand(1);
  const auto o = std::make_shared<Options>();
  const auto reads = [&](CLI::App* verb, bool filtered) {
    verb->add_flag("--json", o->json, "one JSON document instead of a table");
    if (!filtered) return;
    verb->add_option("--where", o->where, "e.g. 'cones > 1e3 && engine == \"mpm\"'")
        ->type_name("CONDITION");
  };
  reads(add_verb(*problem, "list", "one line for each problem", o, exit_code, list), true);
  reads(add_verb(*problem, "show", "all that is known of each problem", o, exit_code, show), true);
  CLI::App* stats_verb =
      add_verb(*problem, "stats", "summary of a collection", o, exit_code, stats);
  reads(stats_verb, true);
  CLI::Option* certificate = stats_verb->add_flag(
      "--certificate", o->certificate,
      "and of each problem: is there a solution (proved), rank and condition of W");
  stats_verb
      ->add_option("--time-limit", o->time_limit, "for the proof of each, e.g. 500ms, 60s, 2min")
      ->type_name("DURATION")
      ->needs(certificate)
      ->capture_default_str();
  reads(add_verb(*problem, "verify", "read, check and judge the stored solution (2 if bad)", o,
                 exit_code, verify),
        false);
  add_verb(*problem, "index", "rebuild DIR/collection.json", o, exit_code, index);
  CLI::App* import_verb =
      add_verb(*problem, "import", "convert any format that we read to ours", o, exit_code,
               [](const Options& options, int&) { import(options); });
  import_verb->add_option("-o,--output", o->output, "folder to write to")
      ->type_name("DIR")
      ->required();
  CLI::App* export_verb =
      add_verb(*problem, "export", "write one problem for other programs", o, exit_code,
               [](const Options& options, int&) { export_problem(options); });
  export_verb->get_option("path")->expected(1);
  export_verb->add_option("-o,--output", o->output, "file to write")->type_name("FILE")->required();
  export_verb->add_option("--format", o->format, "fclib or conebench")
      ->check(CLI::IsMember({"fclib", "conebench"}));
  export_verb->add_flag("--standard", o->standard,
                        "shift the cohesion away: kappa = 0, f', attribute rate_scale");
  add_problem_shrink(*problem, exit_code);
}

}  // namespace conebench::harness
