#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "harness/solver_build.h"
#include "harness/summary.h"
#include "harness/trajectories.h"
#include "problems/error.h"
#include "results/record.h"

namespace conebench::harness {
namespace {

using problems::require;

constexpr std::int64_t kMostSeeds = 1000;

std::int64_t read_integer(std::string_view text) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  require(error == std::errc{} && end == text.data() + text.size(), "--seeds", "found \"", text,
          "\", expected a number of seeds, or seeds such as 1,4,9");
  return value;
}

std::vector<std::int64_t> read_seeds(const std::string& text, std::int64_t first) {
  std::vector<std::int64_t> seeds;
  if (text.find(',') == std::string::npos) {
    const std::int64_t count = read_integer(text);
    require(count >= 1 && count <= kMostSeeds, "--seeds", "found ", count, ", expected from 1 to ",
            kMostSeeds);
    for (std::int64_t k = 0; k < count; ++k) seeds.push_back(first + k);
    return seeds;
  }
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    const std::int64_t seed = read_integer(std::string_view(text).substr(at, end - at));
    require(std::find(seeds.begin(), seeds.end(), seed) == seeds.end(), "--seeds", "found ", seed,
            " twice, expected each once");
    seeds.push_back(seed);
    at = end + 1;
  }
  return seeds;
}

std::vector<double> checked_tolerances(std::vector<double> tolerances, double reference_tol) {
  require(!tolerances.empty(), "--tol", "found none, expected some");
  require(reference_tol > 0.0, "--reference-tol", "found ", reference_tol, ", expected > 0");
  for (const double tol : tolerances) {
    require(tol > reference_tol, "--tol", "found ", tol,
            ", expected looser than the reference, which is solved to ", reference_tol);
  }
  std::sort(tolerances.begin(), tolerances.end(), std::greater<>());
  tolerances.erase(std::unique(tolerances.begin(), tolerances.end()), tolerances.end());
  return tolerances;
}

// One solver at one tolerance, for every seed.
struct Member {
  const solvers::Solver* solver = nullptr;
  double tol = 0.0;
  bool reference = false;
  std::vector<std::string> settings;  // that differ from the scene's
};

TrajectoryTask make_task(const engine::SceneText& scene, const Member& member, std::int64_t seed,
                         std::int64_t steps) {
  std::vector<std::string> settings = member.settings;
  settings.push_back(fmt::format("seed={}", seed));
  settings.push_back(fmt::format("solver.tol={}", member.tol));
  TrajectoryTask task{.scene = engine::with_overrides(scene, settings),
                      .solver = member.solver->name,
                      .tol = member.tol,
                      .seed = seed,
                      .reference = member.reference,
                      .steps = steps,
                      .key = {}};
  task.key =
      results::short_hash(fmt::format("{}\n{}\n{}\n{}", engine_of(task.scene).print(task.scene),
                                      task.solver, steps, build_of(*member.solver)));
  return task;
}

bool same_places(const engine::Heap& a, const engine::Heap& b) {
  const auto same = [](const engine::Grain& x, const engine::Grain& y) {
    return x.position == y.position && x.radius == y.radius;
  };
  return std::equal(a.grains.begin(), a.grains.end(), b.grains.begin(), b.grains.end(), same);
}

// Whether every seed begins elsewhere. Two that are alike would be one sample counted twice.
bool seeds_differ(const engine::SceneText& scene, const Member& member,
                  const std::vector<std::int64_t>& seeds) {
  std::vector<engine::Heap> heaps;
  for (const std::int64_t seed : seeds) {
    const TrajectoryTask task = make_task(scene, member, seed, 0);
    heaps.push_back(make_engine(task.scene, {.solver = task.solver})->snapshot().heap);
    for (std::size_t k = 0; k + 1 < heaps.size(); ++k) {
      if (same_places(heaps[k], heaps.back())) return false;
    }
  }
  return true;
}

}  // namespace

TrajectoryPlan plan_trajectories(const TrajectoryWish& wish) {
  const engine::SceneText scene = engine::with_overrides(find_scene(wish.scene), wish.overrides);
  const EngineKind& kind = engine_of(scene);
  const engine::SceneHeader header = kind.read(scene);
  const std::vector<solvers::Solver> solvers = make_all_solvers(
      wish.solvers.empty() ? std::vector<std::string>{header.solver.name} : wish.solvers);
  const std::vector<solvers::Solver> references = make_all_solvers({wish.reference});
  require(references.size() == 1, "--reference", wish.reference, " names ", references.size(),
          " solvers, expected one");

  TrajectoryPlan plan{.scene = header.name,
                      .engine = std::string(kind.name),
                      .solvers = {},
                      .tolerances = checked_tolerances(wish.tolerances, wish.reference_tol),
                      .seeds = read_seeds(wish.seeds, header.seed),
                      .reference = references.front().name,
                      .reference_tol = wish.reference_tol,
                      .tasks = {}};
  std::vector<Member> members = {
      {.solver = &references.front(),
       .tol = wish.reference_tol,
       .reference = true,
       .settings = {
           fmt::format("solver.time_limit_s={}", wish.reference_time_limit_s),
           fmt::format("solver.max_iterations={}", engine::SolverChoice{}.max_iterations)}}};
  for (const solvers::Solver& solver : solvers) {
    plan.solvers.push_back(solver.name);
    for (const double tol : plan.tolerances) {
      members.push_back({.solver = &solver, .tol = tol, .reference = false, .settings = {}});
    }
  }
  if (plan.seeds.size() > 1 && !seeds_differ(scene, members.front(), plan.seeds)) {
    plan.seed_matters = false;
    plan.seeds.resize(1);
  }
  for (const std::int64_t seed : plan.seeds) {
    for (const Member& member : members) {
      plan.tasks.push_back(make_task(scene, member, seed, wish.steps));
    }
  }
  return plan;
}

}  // namespace conebench::harness
