#include "harness/doctor.h"

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "harness/commands/commands.h"

namespace conebench::harness {

void add_doctor(CLI::App& app, int&) {
  auto as_json = std::make_shared<bool>(false);
  CLI::App* verb =
      app.add_subcommand("doctor", "Say what this build and this machine are, and what would hurt");
  verb->add_flag("--json", *as_json, "Print one JSON object");
  verb->callback([as_json] {
    nlohmann::ordered_json object;
    for (const Finding& finding : examine()) {
      object[finding.name] = {{"value", finding.value}, {"good", finding.good}};
      if (*as_json) continue;
      fmt::print("{} {:<28} {}\n", finding.good ? "ok  " : "NOTE", finding.name, finding.value);
    }
    if (*as_json) fmt::print("{}\n", object.dump(2));
  });
}

}  // namespace conebench::harness
