#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "harness/commands/commands.h"
#include "harness/interrupt.h"
#include "harness/problem_id.h"
#include "harness/settings.h"
#include "harness/variants.h"
#include "harness/worker.h"
#include "problems/error.h"
#include "results/text.h"

namespace conebench::harness {
namespace {

struct SolveOptions {
  std::string file, solver = "auto", solution_file;
  SolveSettings settings;
  bool json = false, curve = false, strict = false;
};

void print_record(const results::Record& r) {
  fmt::print("problem         {} ({} cones)\n", r.problem.name, r.problem.cones);
  fmt::print("solver          {}\n", r.solver);
  fmt::print("status          {}\n", results::to_string(r.status));
  fmt::print("eta             {}   (verified; tolerance {:.1e}; a residual, not an error bound)\n",
             results::format_eta(r.eta), r.settings.tol);
  if (r.kind == "model") {
    fmt::print("model_eta       {}   (in the model's own problem; eta is the model's gap)\n",
               results::format_eta(r.model_eta));
  }
  fmt::print("fclib_residual  {}\n", results::format_eta(r.fclib_residual));
  fmt::print("iterations      {}\n", r.iterations);
  fmt::print("time            {} set-up, {} iterations\n", results::format_time(r.setup_s),
             results::format_time(r.solve_s));
  for (const std::string& note : r.notes) fmt::print("note            {}\n", note);
  if (!r.error.empty()) fmt::print("error           {}\n", r.error);
}

int exit_code_of(const results::Record& record, bool strict) {
  if (strict && record.status == results::Status::kRefuted) return 4;
  return record.solved() ? 0 : 1;
}

int solve(const SolveOptions& options) {
  problems::require(std::filesystem::exists(options.file), options.file, "no such file");
  problems::require(std::filesystem::is_regular_file(options.file), options.file,
                    "is no file, expected one problem (`run -p` takes folders)");
  Task task{.problems = {source_from_file(options.file)},
            .solver = make_solver(options.solver),
            .stop = options.settings.checked_stop(),
            .memory_limit_bytes = options.settings.memory_limit_bytes(),
            .hard_limit_s = options.settings.hard_limit_s()};
  if (!options.solution_file.empty()) task.solution_file = options.solution_file;
  const auto record = run_task(task);
  if (!record) return kInterruptedExit;
  if (options.json) {
    const auto replace = nlohmann::json::error_handler_t::replace;
    nlohmann::json object = to_json(*record);
    if (!options.curve) object.erase("curve");
    fmt::print("{}\n", object.dump(-1, ' ', false, replace));
  } else {
    print_record(*record);
  }
  return exit_code_of(*record, options.strict);
}

}  // namespace

void add_solve(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<SolveOptions>();
  CLI::App* verb = app.add_subcommand("solve", "Solve one problem with one solver and verify it");
  verb->add_option("FILE", options->file, "Problem in any format that we can import")
      ->type_name("")
      ->required();
  verb->add_option("-s,--solver", options->solver, "Variant, e.g. gs[local=exact,omega=1.0]")
      ->type_name("SOLVER")
      ->capture_default_str();
  options->settings.add_to(*verb);
  verb->add_option("-o,--output", options->solution_file, "Write r, u, v to this HDF5 file")
      ->type_name("FILE");
  verb->add_flag("--json", options->json, "Print one JSON object");
  verb->add_flag("--curve", options->curve, "With --json: (time, iteration, eta) of every look");
  verb->add_flag("--strict", options->strict, "Exit 4 when a claim of success is refuted");
  verb->footer("Exit code: 0 if the verified eta meets the tolerance, 1 if not, 2 bad input.");
  verb->callback([options, &exit_code] { exit_code = solve(*options); });
}

}  // namespace conebench::harness
