#include "harness/failure.h"

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "harness/condition.h"
#include "problems/error.h"
#include "problems/suggest.h"
#include "results/text.h"

namespace conebench::harness {
namespace {

using problems::require;
using results::Record;
using results::Status;

bool is_one_word(const std::string& text) {
  return text.find_first_not_of("abcdefghijklmnopqrstuvwxyz_") == std::string::npos;
}

Status status_named(const std::string& text) {
  const auto status = results::status_from(text);
  std::vector<std::string> known;
  for (const Status s : results::all_statuses()) known.emplace_back(results::to_string(s));
  require(status.has_value(), "--failing", "\"", text, "\" is no status",
          problems::suggestion(text, known), "; known: ", fmt::format("{}", fmt::join(known, ", ")),
          "; or a condition such as 'eta > 1e-3'");
  return *status;
}

nlohmann::ordered_json facts_of(const Record& record) {
  return {{"status", results::to_string(record.status)},
          {"claimed", record.claimed},
          {"solved", record.solved()},
          {"eta", record.eta},
          {"iterations", record.iterations},
          {"time", record.setup_s + record.solve_s}};
}

}  // namespace

Failure::Failure(const std::string& text, const Record& run) {
  if (is_one_word(text)) {
    require(!text.empty() || !run.solved(), run.solver, "solves ", run.problem.name, " (",
            describe_run(run), "), expected a problem on which it fails");
    const Status status = text.empty() ? run.status : status_named(text);
    text_ = results::to_string(status);
    matches_ = [status](const Record& r) { return r.status == status && !r.solved(); };
  } else {
    const auto condition = std::make_shared<const Condition>(
        text, Condition::Terms{.option = "--failing", .noun = "fact of a run"});
    text_ = text;
    matches_ = [condition](const Record& r) { return condition->matches(facts_of(r)); };
  }
  require(matches_(run), run.solver, "on ", run.problem.name, " ends as ", describe_run(run),
          ", expected: ", text_);
}

std::string describe_run(const Record& record) {
  std::string text =
      fmt::format("{}, eta {}", results::to_string(record.status), results::format_eta(record.eta));
  if (!record.error.empty()) text += ", " + record.error.substr(0, record.error.find('\n'));
  return text;
}

}  // namespace conebench::harness
