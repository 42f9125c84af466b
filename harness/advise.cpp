#include "harness/advise.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numeric>

#include "harness/step_solver.h"
#include "harness/variants.h"
#include "problems/engine/island_solver.h"
#include "problems/residual.h"
#include "results/binomial.h"

namespace conebench::harness {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kRaceConfidence = 0.95;
constexpr std::size_t kLeastRaced = 4;  // steps before anybody is dropped
constexpr std::size_t kMostFinalists = 4;

// A solver as an engine calls it, with all that a step waits for.
class Runner {
 public:
  Runner(const std::string& solver, const Wish& wish, bool by_islands)
      : solver_(make_solver(solver)),
        tol_(wish.tol),
        step_(make_step_solver(
            {.name = solver, .tol = wish.tol, .time_limit_s = kPatience * wish.budget_s})) {
    if (by_islands) step_ = engine::by_islands(std::move(step_));
  }

  bool takes(const Sample& sample) const { return solver_.supports(sample.standard); }

  double time_s(const Sample& sample) const {
    const auto start = std::chrono::steady_clock::now();
    const engine::StepAnswer answer = step_(sample.standard, sample.guess);
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
    return problems::evaluate_eta(sample.standard, answer.r) <= tol_ ? time.count() : kInfinity;
  }

 private:
  solvers::Solver solver_;
  double tol_;
  engine::StepSolver step_;
};

double share(std::int64_t part, std::size_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

// The sum, with every time at most what a solver may take.
double total_s(const Entrant& entrant, double most_s) {
  double sum = 0.0;
  for (const double time : entrant.times_s) sum += std::min(time, most_s);
  return sum;
}

// More steps within the budget first; of as many, the one that took less time.
bool better(const Entrant& a, const Entrant& b, const Wish& wish) {
  const std::int64_t in_a = a.within(wish.budget_s), in_b = b.within(wish.budget_s);
  if (in_a != in_b) return in_a > in_b;
  return total_s(a, kPatience * wish.budget_s) < total_s(b, kPatience * wish.budget_s);
}

void drop_losers(std::vector<Entrant>& entrants, const Wish& wish) {
  const Entrant* leader = nullptr;
  for (const Entrant& entrant : entrants) {
    if (!entrant.dropped && (leader == nullptr || better(entrant, *leader, wish))) {
      leader = &entrant;
    }
  }
  if (leader == nullptr || leader->times_s.size() < kLeastRaced) return;
  for (Entrant& entrant : entrants) {
    if (&entrant == leader || entrant.dropped) continue;
    entrant.dropped = out_of_the_race(entrant, *leader, wish);
  }
}

std::vector<std::size_t> in_order(std::size_t count) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  return order;
}

// All solvers on one step before the next; `after_step` may drop some.
std::vector<Entrant> run(const std::vector<Sample>& samples, const std::vector<std::size_t>& order,
                         const std::vector<std::string>& solvers, const Wish& wish, bool by_islands,
                         const std::function<void(std::vector<Entrant>&)>& after_step) {
  std::vector<Entrant> entrants;
  std::vector<Runner> runners;
  for (const std::string& solver : solvers) {
    entrants.push_back({.solver = solver});
    runners.emplace_back(solver, wish, by_islands);
  }
  for (const std::size_t step : order) {
    const Sample& sample = samples[step];
    for (std::size_t k = 0; k < entrants.size(); ++k) {
      Entrant& entrant = entrants[k];
      if (entrant.dropped) continue;
      entrant.times_s.push_back(runners[k].takes(sample) ? runners[k].time_s(sample) : kInfinity);
    }
    after_step(entrants);
  }
  return entrants;
}

// Of those that ran to the end, the best first.
std::vector<std::string> finalists(const std::vector<Entrant>& entrants, const Wish& wish) {
  std::vector<Entrant> left;
  for (const Entrant& entrant : entrants) {
    if (!entrant.dropped) left.push_back(entrant);
  }
  std::ranges::stable_sort(left,
                           [&](const Entrant& a, const Entrant& b) { return better(a, b, wish); });
  if (left.size() > kMostFinalists) left.resize(kMostFinalists);
  std::vector<std::string> names;
  for (const Entrant& entrant : left) names.push_back(entrant.solver);
  return names;
}

// Steps that one of two solves within the budget.
std::int64_t within_either(const Entrant& a, const Entrant& b, double budget_s) {
  std::int64_t count = 0;
  for (std::size_t k = 0; k < a.times_s.size(); ++k) {
    count += std::min(a.times_s[k], b.times_s[k]) <= budget_s;
  }
  return count;
}

void compare(const Wish& wish, std::size_t steps, Advice& advice) {
  std::vector<double> least(steps, kInfinity);
  for (const Entrant& entrant : advice.validation) {
    for (std::size_t k = 0; k < steps; ++k) least[k] = std::min(least[k], entrant.times_s[k]);
    advice.single_best = std::max(advice.single_best, share(entrant.within(wish.budget_s), steps));
    const double needed = entrant.quantile_s(kEnough);
    if (needed < advice.nearest_budget_s) {
      advice.nearest_budget_s = needed;
      advice.nearest = entrant.solver;
    }
  }
  advice.virtual_best =
      share(std::ranges::count_if(least, [&](double t) { return t <= wish.budget_s; }), steps);
  for (std::size_t i = 0; i < advice.validation.size(); ++i) {
    for (std::size_t j = i + 1; j < advice.validation.size(); ++j) {
      const Entrant &a = advice.validation[i], &b = advice.validation[j];
      const double both = share(within_either(a, b, wish.budget_s), steps);
      if (both <= advice.best_pair) continue;
      advice.best_pair = both;
      advice.pair = a.solver + " and " + b.solver;
    }
  }
}

}  // namespace

std::int64_t Entrant::solved() const {
  return std::ranges::count_if(times_s, [](double t) { return std::isfinite(t); });
}

std::int64_t Entrant::within(double budget_s) const {
  return std::ranges::count_if(times_s, [&](double t) { return t <= budget_s; });
}

double Entrant::quantile_s(double share) const {
  if (times_s.empty()) return kInfinity;
  std::vector<double> sorted = times_s;
  std::ranges::sort(sorted);
  const double rank = std::ceil(share * static_cast<double>(sorted.size()));
  return sorted[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
}

std::vector<std::size_t> spread_order(std::size_t count) {
  constexpr double kGolden = 0.6180339887498949;
  std::vector<std::size_t> order = in_order(count);
  const auto place = [](std::size_t k) {
    const double turns = kGolden * static_cast<double>(k);
    return turns - std::floor(turns);
  };
  std::ranges::stable_sort(order, {}, place);
  return order;
}

bool out_of_the_race(const Entrant& entrant, const Entrant& leader, const Wish& wish) {
  const auto trials = static_cast<std::int64_t>(entrant.times_s.size());
  const std::int64_t mine = entrant.within(wish.budget_s), best = leader.within(wish.budget_s);
  // Misses are successes of the complement: an upper bound of p from a lower one of 1 - p.
  const double most = 1.0 - results::binomial_lower_bound(trials - mine, trials, kRaceConfidence);
  if (most < results::binomial_lower_bound(best, trials, kRaceConfidence)) return true;
  return mine <= best && entrant.quantile_s(0.5) > kFarBehind * leader.quantile_s(0.5);
}

std::vector<Entrant> race(const std::vector<Sample>& samples,
                          const std::vector<std::string>& solvers, const Wish& wish,
                          bool by_islands) {
  return run(samples, spread_order(samples.size()), solvers, wish, by_islands,
             [&](std::vector<Entrant>& entrants) { drop_losers(entrants, wish); });
}

Advice advise(const std::vector<Sample>& training, const std::vector<Sample>& validation,
              const std::vector<std::string>& solvers, const Wish& wish, bool by_islands,
              double fallback_limit_s) {
  Advice advice;
  advice.chosen_among = race(training, solvers, wish, by_islands);
  const std::vector<std::string> names = finalists(advice.chosen_among, wish);
  advice.validation = run(validation, in_order(validation.size()), names, wish, by_islands,
                          [](std::vector<Entrant>&) {});
  advice.nearest_budget_s = kInfinity;
  compare(wish, validation.size(), advice);

  advice.policy.tol = wish.tol;
  advice.policy.budget_s = wish.budget_s;
  advice.policy.confidence = wish.confidence;
  if (advice.validation.empty()) return advice;
  const Entrant& chosen = advice.validation.front();
  const std::int64_t within = chosen.within(wish.budget_s);
  advice.meets = share(within, validation.size()) >= kEnough;
  std::vector<bool> successes;
  for (const double time_s : chosen.times_s) successes.push_back(time_s <= wish.budget_s);
  advice.policy.probability = results::run_lower_bound(successes, wish.confidence);
  // What follows the first has missed the budget anyway: the tolerance is still wanted.
  for (std::size_t k = 0; k < std::min<std::size_t>(2, names.size()); ++k) {
    advice.policy.ladder.push_back({names[k], k == 0 ? wish.budget_s : kPatience * wish.budget_s});
  }
  advice.policy.ladder.push_back({"auto", fallback_limit_s});
  return advice;
}

}  // namespace conebench::harness
