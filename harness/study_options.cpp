#include "harness/study_options.h"

#include <fmt/format.h>

#include "harness/summary.h"
#include "harness/tasks.h"
#include "problems/error.h"

namespace conebench::harness {

void StudyOptions::add_to(CLI::App& verb) {
  verb_ = &verb;
  Study& s = given_;
  verb.add_option("-c,--study", file_, "Study file (TOML); options replace what it says")
      ->type_name("FILE");
  verb.add_option("-p,--problems", s.problems, "Problem files or folders")->type_name("PATH");
  verb.add_option("-s,--solver", s.solvers,
                  "Solvers with their parameters (conebench solver list); several values try all: "
                  "gs[omega=0.8,1]")
      ->type_name("SOLVER");
  verb.add_option("--where", s.where, "Of the problems those with, e.g. 'cones > 1e3'")
      ->type_name("CONDITION");
  verb.add_option("--tol", s.tolerances, "Tolerances on eta, the relative residual [-]")
      ->delimiter(',')
      ->capture_default_str();
  verb.add_option("--mode", s.modes,
                  "What a solve starts from: cold (r = 0), warm (the file's guess), sequence "
                  "(consecutive steps, each from the answer to the one before)")
      ->type_name("cold|warm|sequence")
      ->delimiter(',')
      ->capture_default_str();
  verb.add_option("--donor", s.donors,
                  "Mode sequence: whose answers are the guesses, `own` or variants")
      ->type_name("own|SOLVER")
      ->capture_default_str();
  verb.add_option("--threads", s.threads, "Of the libraries that solvers call")
      ->delimiter(',')
      ->capture_default_str();
  verb.add_option("--time-limit", s.time_limit, "Solver time for one problem, e.g. 500ms, 60s")
      ->type_name("DURATION")
      ->capture_default_str();
  verb.add_option("--mem", s.memory, "Memory of one task, e.g. 512MiB, 2G; empty: no limit")
      ->type_name("SIZE")
      ->capture_default_str();
  verb.add_option("--hard-limit", s.hard_limit,
                  "Wall time of one problem after which a worker is killed (default: 2 x time "
                  "limit + 30s)")
      ->type_name("DURATION");
  verb.add_option("--stop", s.stop,
                  "Who decides that an answer is good: `common` (eta, outside the clock) or `own` "
                  "(the method's own test, inside the clock)")
      ->type_name("common|own")
      ->capture_default_str();
  verb.add_option("--reps", s.repetitions,
                  "Times that each task is run, each in a process of its own; `auto`: many solves "
                  "in one, until the median is known to 2 %")
      ->type_name("N|auto")
      ->capture_default_str();
  verb.add_option("--seed", s.seed, "Of the random order of the tasks")->capture_default_str();
}

bool StudyOptions::given() const { return !file_.empty() || !given_.problems.empty(); }

Study StudyOptions::study() const {
  if (file_.empty()) return given_;
  Study study = read_study(file_);
  const auto take = [&](const char* option, auto Study::*member) {
    if (verb_->count(option) > 0) study.*member = given_.*member;
  };
  take("--problems", &Study::problems);
  take("--solver", &Study::solvers);
  take("--where", &Study::where);
  take("--tol", &Study::tolerances);
  take("--mode", &Study::modes);
  take("--donor", &Study::donors);
  take("--threads", &Study::threads);
  take("--time-limit", &Study::time_limit);
  take("--mem", &Study::memory);
  take("--hard-limit", &Study::hard_limit);
  take("--stop", &Study::stop);
  take("--reps", &Study::repetitions);
  take("--seed", &Study::seed);
  return study;
}

std::optional<PlanFile> find_plan(const StudyOptions& options,
                                  const std::filesystem::path& results_dir, int jobs) {
  if (!options.given()) return read_plan(results_dir);
  PlanFile plan{.study = options.study(), .problems = {}};
  check(plan.study);
  const FoundSources found = find_sources({plan.study.problems.begin(), plan.study.problems.end()},
                                          jobs, plan.study.where);
  if (found.interrupted) return std::nullopt;
  tell(found);
  plan.problems = found.problems;
  write_plan(results_dir, plan);
  return plan;
}

TaskGroups groups_of(const PlanFile& plan) {
  TaskGroups all = make_task_groups(check(plan.study), plan.problems);
  if (all.without_guess > 0) {
    fmt::print(stderr, "mode warm leaves out {} problems without a guess\n", all.without_guess);
  }
  if (all.without_sequence > 0) {
    fmt::print(stderr, "mode sequence leaves out {} problems that no other step follows\n",
               all.without_sequence);
  }
  problems::require(!all.groups.empty(), "--mode", "leaves nothing to run");
  return all;
}

}  // namespace conebench::harness
