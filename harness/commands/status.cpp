#include <fmt/format.h>

#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "harness/campaign.h"
#include "harness/commands/commands.h"
#include "harness/study_options.h"
#include "results/text.h"

namespace conebench::harness {
namespace {

using results::Record;

struct Count {
  int tasks = 0, done = 0, unsolved = 0;
};

// Of a task on whatever host: the plan does not know where its shards will run.
std::string key_anywhere(Record record) {
  record.host = {};
  return results::sequence_key(record);
}

std::map<std::string, bool> done_and_solved(const std::vector<Record>& records) {
  std::map<std::string, bool> done;
  for (const Record& record : records) {
    const auto [it, is_new] = done.try_emplace(key_anywhere(record), true);
    it->second = it->second && record.solved();
  }
  return done;
}

int status(const std::filesystem::path& results_dir, bool as_json) {
  const TaskGroups all = groups_of(read_plan(results_dir));
  const results::JournalContent content = results::read_results(results_dir);
  const auto done = done_and_solved(content.records);
  std::map<std::string, Count> solvers;
  Count sum;
  for (const TaskGroup& group : all.groups) {
    for (const Task& task : group.tasks) {
      const auto found = done.find(key_anywhere(blank_records(task).front()));
      for (Count* count : {&solvers[task.solver->name], &sum}) {
        ++count->tasks;
        if (found == done.end()) continue;
        ++count->done;
        if (!found->second) ++count->unsolved;
      }
    }
  }
  if (as_json) {
    nlohmann::json list = nlohmann::json::object();
    for (const auto& [name, c] : solvers) {
      list[name] = {{"tasks", c.tasks}, {"done", c.done}, {"unsolved", c.unsolved}};
    }
    const nlohmann::json object = {{"tasks", sum.tasks},
                                   {"done", sum.done},
                                   {"unsolved", sum.unsolved},
                                   {"torn_lines", content.torn_lines},
                                   {"solvers", list}};
    fmt::print("{}\n", object.dump(1, ' ', false, nlohmann::json::error_handler_t::replace));
    return 0;
  }
  results::TextTable table({"solver", "tasks", "done", "of them unsolved"});
  const auto add = [&](const std::string& name, const Count& c) {
    table.add({name, fmt::format("{}", c.tasks), fmt::format("{}", c.done),
               fmt::format("{}", c.unsolved)});
  };
  for (const auto& [name, count] : solvers) add(name, count);
  add("all", sum);
  fmt::print("{}", table.text());
  if (content.torn_lines > 0) fmt::print("{} torn lines do not count\n", content.torn_lines);
  return 0;
}

}  // namespace

void add_status(CLI::App& app, int& exit_code) {
  struct Options {
    std::filesystem::path results_dir = "results";
    bool json = false;
  };
  auto options = std::make_shared<Options>();
  CLI::App* verb =
      app.add_subcommand("status", "How much of a campaign is done, by solver, over all shards");
  verb->add_option("RESULTS_DIR", options->results_dir, "The -o of `conebench run`")
      ->type_name("")
      ->required();
  verb->add_flag("--json", options->json, "Print one JSON object");
  verb->callback(
      [options, &exit_code] { exit_code = status(options->results_dir, options->json); });
}

}  // namespace conebench::harness
