#include "harness/manual.h"

#include <fmt/format.h>

#include <memory>

#include "harness/commands/commands.h"
#include "harness/completion.h"
#include "harness/engine.h"
#include "problems/engine/text_file.h"
#include "solvers/registry.h"

namespace conebench::harness {
namespace {

CompletionNames known_names() {
  CompletionNames names;
  for (const solvers::Method& method : solvers::all_methods()) names.solvers.push_back(method.name);
  for (const EngineKind& kind : all_engines()) {
    for (const auto& scene : kind.builtin) names.scenes.emplace_back(scene.name);
  }
  return names;
}

void put(const std::string& text, const std::filesystem::path& file) {
  if (file.empty()) {
    fmt::print("{}", text);
  } else {
    engine::write_text_file(file, text);
  }
}

// A verb that prints what `make` makes of the whole program.
void add_printer(CLI::App& app, const std::string& name, const std::string& help,
                 std::string (*make)(const CLI::App&)) {
  auto file = std::make_shared<std::filesystem::path>();
  CLI::App* verb = app.add_subcommand(name, help);
  verb->add_option("-o,--output", *file, "Write it to this file instead")->type_name("FILE");
  verb->callback([&app, file, make] { put(make(app), *file); });
}

}  // namespace

void add_manual(CLI::App& app, int&) {
  add_printer(app, "manual", "Print the manual: conebench manual | man -l -", man_page);
}

void add_completion(CLI::App& app, int&) {
  add_printer(app, "completion", "Print completion for bash: source <(conebench completion)",
              [](const CLI::App& program) { return bash_completion(program, known_names()); });
}

}  // namespace conebench::harness
