#include "harness/advise.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "harness/advice_samples.h"
#include "harness/commands/commands.h"
#include "harness/engine.h"
#include "harness/interrupt.h"
#include "harness/units.h"
#include "harness/variants.h"
#include "problems/engine/text_file.h"
#include "problems/error.h"
#include "results/text.h"

namespace conebench::harness {
namespace {

// What is raced unless the user says otherwise: methods that were the quickest somewhere.
const std::vector<std::string> kEntrants = {
    "auto",        "apgd",      "gs",  "gs[skip=10]", "gs[omega=1.3]",
    "prox-newton", "newton-ac", "ipm", "aclm",        "spg"};

struct AdviseOptions {
  std::vector<std::string> subject;
  std::vector<std::string> overrides, solvers;
  std::string budget, sample_time = "20s", policy_file;
  double tol = 1e-5, confidence = 0.95;
  std::int64_t samples = 40;
  bool json = false;
};

AdviceSamples take_samples(const AdviseOptions& options) {
  const std::string& first = options.subject.front();
  const bool is_scene =
      options.subject.size() == 1 && (first.ends_with(".toml") || !std::filesystem::exists(first));
  if (!is_scene) {
    problems::require(options.overrides.empty(), "--set",
                      "changes a scene, and problem files were given");
    return sample_problems({options.subject.begin(), options.subject.end()});
  }
  const engine::SceneText scene = engine::with_overrides(find_scene(first), options.overrides);
  return sample_scene(scene, options.samples,
                      parse_duration_s(options.sample_time, "--sample-time"));
}

std::vector<std::string> entrants(const AdviseOptions& options) {
  if (options.solvers.empty()) return kEntrants;
  std::vector<std::string> names;
  for (const std::string& text : options.solvers) {
    for (const solvers::Solver& solver : make_solvers(text)) {
      problems::require(solver.kind != solvers::Kind::kModel, "-s", solver.name,
                        " is a model, expected a solver of the problem as posed");
      names.push_back(solver.name);
    }
  }
  return names;
}

// Infinity is not a number of JSON.
nlohmann::json finite_or_null(double x) {
  return std::isfinite(x) ? nlohmann::json(x) : nlohmann::json();
}

nlohmann::json to_json(const Entrant& entrant, const Wish& wish) {
  nlohmann::json times = nlohmann::json::array();
  for (const double time : entrant.times_s) times.push_back(finite_or_null(time));
  return {{"solver", entrant.solver},
          {"steps", entrant.times_s.size()},
          {"within_budget", entrant.within(wish.budget_s)},
          {"solved", entrant.solved()},
          {"median_s", finite_or_null(entrant.quantile_s(0.5))},
          {"times_s", times},
          {"dropped", entrant.dropped}};
}

nlohmann::json to_json(const Advice& advice, const AdviceSamples& samples, const Wish& wish) {
  nlohmann::json object = {
      {"scene", samples.scene},
      {"source", samples.source},
      {"training_steps", samples.training.size()},
      {"validation_steps", samples.validation.size()},
      {"tol", wish.tol},
      {"budget_s", wish.budget_s * samples.solves_per_step},
      {"solves_per_step", samples.solves_per_step},
      {"solve_budget_s", wish.budget_s},
      {"confidence", wish.confidence},
      {"meets", advice.meets},
      {"probability", advice.policy.probability},
      {"single_best", advice.single_best},
      {"virtual_best", advice.virtual_best},
      {"best_pair", {{"solvers", advice.pair}, {"share", advice.best_pair}}},
      {"nearest",
       {{"solver", advice.nearest},
        {"budget_s", finite_or_null(advice.nearest_budget_s * samples.solves_per_step)}}},
      {"ladder", nlohmann::json::array()},
      {"race", nlohmann::json::array()},
      {"validation", nlohmann::json::array()}};
  for (const Policy::Rung& rung : advice.policy.ladder) {
    object["ladder"].push_back({{"solver", rung.solver}, {"time_limit_s", rung.time_limit_s}});
  }
  for (const Entrant& entrant : advice.chosen_among) {
    object["race"].push_back(to_json(entrant, wish));
  }
  for (const Entrant& entrant : advice.validation) {
    object["validation"].push_back(to_json(entrant, wish));
  }
  return object;
}

void print_entrants(const std::vector<Entrant>& entrants, const Wish& wish) {
  for (const Entrant& entrant : entrants) {
    fmt::print("  {:16} {:3} steps, {:3} within the budget, {:3} solved, median {}{}\n",
               entrant.solver, entrant.times_s.size(), entrant.within(wish.budget_s),
               entrant.solved(), results::format_time(entrant.quantile_s(0.5)),
               entrant.dropped ? "  (dropped)" : "");
  }
}

void print_text(const Advice& advice, const AdviceSamples& samples, const Wish& wish) {
  fmt::print("wish      eta <= {:g} within {} a step, confidence {:g}\n", wish.tol,
             results::format_time(wish.budget_s * samples.solves_per_step), wish.confidence);
  if (samples.solves_per_step > 1.0) {
    fmt::print("          {} a solve: a step takes {:.1f} of them\n",
               results::format_time(wish.budget_s), samples.solves_per_step);
  }
  fmt::print("samples   {}: {} steps, and {} unseen ones; {}\n", samples.scene,
             samples.training.size(), samples.validation.size(), samples.source);
  if (advice.policy.ladder.size() > 1) {
    fmt::print("advice    {}\n", advice.policy.ladder.front().solver);
    fmt::print("          P(time <= budget and eta <= tol) >= {:.3f}\n", advice.policy.probability);
  }
  if (!advice.meets) {
    const double nearest_s = advice.nearest_budget_s * samples.solves_per_step;
    fmt::print("          none meets this budget on {:.0f} % of the unseen steps; nearest: {}\n",
               100.0 * kEnough,
               std::isfinite(nearest_s)
                   ? fmt::format("{} with {}", advice.nearest, results::format_time(nearest_s))
                   : "none solves enough of them");
  }
  fmt::print(
      "compared  within the budget: single best {:.0f} %, best pair side by side {:.0f} %"
      "{}, virtual best {:.0f} %\n",
      100.0 * advice.single_best, 100.0 * advice.best_pair,
      advice.pair.empty() ? "" : " (" + advice.pair + ")", 100.0 * advice.virtual_best);
  fmt::print("race\n");
  print_entrants(advice.chosen_among, wish);
  fmt::print("unseen steps\n");
  print_entrants(advice.validation, wish);
}

int run_advise(const AdviseOptions& options) {
  Wish wish{.tol = options.tol,
            .budget_s = parse_duration_s(options.budget, "--budget"),
            .confidence = options.confidence};
  const std::vector<std::string> solvers = entrants(options);
  catch_interrupts();
  const AdviceSamples samples = take_samples(options);
  if (interrupted()) return kInterruptedExit;
  wish.budget_s /= samples.solves_per_step;
  Advice advice = advise(samples.training, samples.validation, solvers, wish, samples.by_islands,
                         samples.fallback_limit_s);
  advice.policy.scene = samples.scene;
  if (!options.policy_file.empty()) {
    engine::write_text_file(options.policy_file, to_toml(advice.policy));
  }
  if (options.json) {
    fmt::print("{}\n", to_json(advice, samples, wish).dump());
  } else {
    print_text(advice, samples, wish);
  }
  return advice.meets ? 0 : 1;
}

}  // namespace

void add_advise(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<AdviseOptions>();
  CLI::App* verb = app.add_subcommand("advise", "Which solver for this scene and this time");
  verb->add_option("SCENE|PATH", options->subject, "A scene, or problem files and folders")
      ->type_name("")
      ->required();
  verb->add_option("--budget", options->budget,
                   "Wall clock of one step, e.g. 4ms; a bare number is seconds")
      ->type_name("DURATION")
      ->required();
  verb->add_option("--tol", options->tol, "Tolerance on eta, the relative residual [-]")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  verb->add_option("--confidence", options->confidence,
                   "Of the lower bound that is printed as P(...) >= p")
      ->check(CLI::Range(0.5, 0.9999))
      ->capture_default_str();
  verb->add_option("-s,--solver", options->solvers,
                   "Solvers to race (default: ours, with some parameters)")
      ->type_name("SOLVER");
  verb->add_option("--samples", options->samples, "Steps drawn from each run of the scene")
      ->check(CLI::Range(2, 100000))
      ->capture_default_str();
  verb->add_option("--sample-time", options->sample_time, "Longest run of the scene")
      ->type_name("DURATION")
      ->capture_default_str();
  verb->add_option("--set", options->overrides,
                   "Another value of the scene, such as material.friction=0.5")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  verb->add_option("-o,--output", options->policy_file,
                   "Write the policy here; a scene takes it as solver.name = \"policy:FILE\"")
      ->type_name("FILE");
  verb->add_flag("--json", options->json, "Print one JSON object");
  verb->footer("Exit code: 0 if the advice meets the budget, 1 if none does, 2 bad input.");
  verb->callback([options, &exit_code] { exit_code = run_advise(*options); });
}

}  // namespace conebench::harness
