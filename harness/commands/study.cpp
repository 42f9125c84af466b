#include <fmt/format.h>

#include <memory>

#include "harness/command_line.h"
#include "harness/commands/commands.h"
#include "harness/commands/scene_run.h"
#include "harness/commands/text_output.h"
#include "harness/interrupt.h"
#include "harness/trajectory_report.h"
#include "harness/units.h"
#include "results/output.h"
#include "results/svg_plot.h"

namespace conebench::harness {
namespace {

struct StudyVerb {
  TrajectoryWish wish;
  std::string reference_time_limit = "10s";
  std::filesystem::path folder;
  bool json = false;
};

void write_report(const std::filesystem::path& folder, const Findings& findings) {
  for (const results::Plot& plot : trajectory_plots(findings)) {
    results::write_text_file(folder / (plot.id + ".svg"),
                             results::svg(plot, results::SvgUse::kFile));
  }
  results::write_text_file(folder / "study.csv", trajectory_csv(findings));
  results::write_text_file(folder / "study.md", trajectory_markdown(findings, command_line()));
}

void tell(const TrajectoryPlan& plan, const TrajectoryRows& runs, bool kept) {
  fmt::print(stderr, "{} runs: {} done now, {} kept from before\n", plan.tasks.size(),
             runs.rows.size() - runs.earlier, runs.earlier);
  for (const TrajectoryRow& row : runs.rows) {
    if (row.error.empty()) continue;
    fmt::print(stderr, "failed: {} to {:g}, seed {}: {}\n", row.solver, row.tol, row.seed,
               row.error);
  }
  if (!runs.interrupted) return;
  fmt::print(stderr, "interrupted; {}\n",
             kept ? "the same command goes on where this one stopped" : "nothing was kept: no -o");
}

int study(StudyVerb options) {
  options.wish.reference_time_limit_s =
      parse_duration_s(options.reference_time_limit, "--reference-time-limit");
  const TrajectoryPlan plan = plan_trajectories(options.wish);
  keep_freed_memory();
  catch_interrupts();
  const TrajectoryRows runs = run_trajectories(plan, options.folder);
  tell(plan, runs, !options.folder.empty());
  if (runs.interrupted) return kInterruptedExit;
  const Findings findings = find(plan, runs.rows);
  if (!options.folder.empty()) write_report(options.folder, findings);
  if (options.json) {
    print_json(to_json(findings));
  } else {
    fmt::print("{}", trajectory_text(findings));
  }
  return 0;
}

}  // namespace

void add_study(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<StudyVerb>();
  TrajectoryWish& wish = options->wish;
  wish.tolerances = {1e-1, 1e-2, 1e-3, 1e-4};
  CLI::App* verb = app.add_subcommand(
      "study", "Which tolerance is enough for a scene's physics: solver x tolerance x seed");
  verb->add_option("SCENE", wish.scene, "Built-in name or .toml file")->type_name("")->required();
  verb->add_option("-s,--solver", wish.solvers, "Variants (default: the scene's); lists make grids")
      ->type_name("SOLVER");
  verb->add_option("--tol", wish.tolerances, "Tolerances on eta, each looser than the reference's")
      ->delimiter(',')
      ->capture_default_str();
  verb->add_option("--seeds", wish.seeds,
                   "How many, from the scene's seed on; or a list such as 1,4,9")
      ->type_name("N|LIST")
      ->capture_default_str();
  verb->add_option("--reference", wish.reference, "Variant that deviations are from")
      ->type_name("SOLVER")
      ->capture_default_str();
  verb->add_option("--reference-tol", wish.reference_tol, "Its tolerance on eta")
      ->capture_default_str();
  verb->add_option("--reference-time-limit", options->reference_time_limit,
                   "Its time for one step, in place of the scene's limits")
      ->type_name("DURATION")
      ->capture_default_str();
  verb->add_option("--set", wish.overrides,
                   "Another value of the scene, such as material.friction=0.5")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  verb->add_option("--steps", wish.steps, "Steps to run (default: the scene's duration)")
      ->check(CLI::PositiveNumber);
  verb->add_option("-o,--output", options->folder,
                   "Folder for study.md, study.csv, figures and runs.jsonl, from which the same "
                   "command goes on")
      ->type_name("DIR");
  verb->add_flag("--json", options->json, "Print the findings as one JSON object");
  verb->footer(
      "Runs keep to the scene's limits on a step's iterations and time (--set "
      "solver.time_limit_s=1);"
      "\nsteps that these end before the tolerance are counted.");
  verb->callback([options, &exit_code] { exit_code = study(*options); });
}

}  // namespace conebench::harness
