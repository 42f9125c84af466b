#include "problems/engine/step_sample.h"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <tuple>
#include <utility>

namespace conebench::engine {
namespace {

using Verdict = StepSample::Verdict;

void sort_by_step(std::vector<SampledStep>& steps) {
  std::ranges::sort(steps, {}, &SampledStep::step);
}

struct Harder {
  bool operator()(const StepFacts& a, const StepFacts& b) const { return rank(a) < rank(b); }

 private:
  static std::tuple<bool, std::int64_t, std::int64_t, std::int64_t> rank(const StepFacts& facts) {
    return {facts.converged, -facts.iterations, -facts.cones, facts.step};
  }
};

class Hardest : public StepSample {
 public:
  explicit Hardest(std::int64_t most) : most_(most) {}

  Verdict offer(const StepFacts& facts) override {
    kept_.insert(facts);
    if (std::ssize(kept_) <= most_) return {.keep = true};
    const auto easiest = std::prev(kept_.end());
    const std::int64_t dropped = easiest->step;
    kept_.erase(easiest);
    if (dropped == facts.step) return {};
    return {.keep = true, .instead_of = dropped};
  }

  std::vector<SampledStep> steps() const override {
    std::vector<SampledStep> steps;
    for (const StepFacts& facts : kept_) steps.push_back({facts.step, 1.0});
    sort_by_step(steps);
    return steps;
  }

 private:
  std::int64_t most_;
  std::set<StepFacts, Harder> kept_;
};

// Whole numbers that are alike with every standard library.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}

  // 0 <= x < count, all alike.
  std::size_t below(std::size_t count) {
    constexpr std::uint64_t kLargest = std::numeric_limits<std::uint64_t>::max();
    const std::uint64_t excess = (kLargest % count + 1) % count;  // 2^64 mod count
    std::uint64_t x = engine_();
    while (x > kLargest - excess) x = engine_();
    return static_cast<std::size_t>(x % count);
  }

 private:
  std::mt19937_64 engine_;
};

// Place of a stratum: powers of two of cones and of iterations.
using Cell = std::pair<int, int>;

int power_of_two(std::int64_t count) {
  return static_cast<int>(std::bit_width(static_cast<std::uint64_t>(count)));
}

Cell cell_of(const StepFacts& facts) {
  return {power_of_two(facts.cones), power_of_two(facts.iterations)};
}

Cell one_cell(const StepFacts&) { return {0, 0}; }

// A reservoir is one with a single stratum.
class Stratified : public StepSample {
 public:
  Stratified(std::int64_t most, std::uint64_t seed, Cell (*cell)(const StepFacts&))
      : most_(static_cast<std::size_t>(most)), cell_(cell), dice_(seed) {}

  Verdict offer(const StepFacts& facts) override {
    Stratum& own = stratum_at(cell_(facts));
    ++own.offered;
    if (kept_ < most_) {
      own.kept.push_back(facts.step);
      ++kept_;
      return {.keep = true};
    }
    // The largest stratum gives up a place where that makes the two more even. The sample of `own`
    // stays uniform: it has lost no step yet, since strata that have are at most one below the
    // largest, which does not grow any more.
    Stratum& largest = largest_stratum();
    if (own.kept.size() + 1 < largest.kept.size()) {
      own.kept.push_back(facts.step);
      return {.keep = true, .instead_of = take_any(largest)};
    }
    const std::size_t place = dice_.below(own.offered);
    if (place >= own.kept.size()) return {};
    return {.keep = true, .instead_of = std::exchange(own.kept[place], facts.step)};
  }

  std::vector<SampledStep> steps() const override {
    std::vector<SampledStep> steps;
    for (const auto& [cell, stratum] : strata_) {
      const double weight =
          static_cast<double>(stratum.offered) / static_cast<double>(stratum.kept.size());
      for (const std::int64_t step : stratum.kept) steps.push_back({step, weight});
    }
    sort_by_step(steps);
    return steps;
  }

 private:
  // kept is a uniform choice of those offered; never empty once a step was offered.
  struct Stratum {
    std::size_t offered = 0;
    std::vector<std::int64_t> kept;
  };

  Stratum& stratum_at(const Cell& cell) {
    if (strata_.size() < most_ || strata_.contains(cell)) return strata_[cell];
    const auto distance = [&cell](const auto& entry) {
      return std::abs(entry.first.first - cell.first) + std::abs(entry.first.second - cell.second);
    };
    return std::ranges::min_element(strata_, {}, distance)->second;
  }

  Stratum& largest_stratum() {
    const auto size = [](const auto& entry) { return entry.second.kept.size(); };
    return std::ranges::max_element(strata_, {}, size)->second;
  }

  std::int64_t take_any(Stratum& stratum) {
    std::swap(stratum.kept[dice_.below(stratum.kept.size())], stratum.kept.back());
    const std::int64_t step = stratum.kept.back();
    stratum.kept.pop_back();
    return step;
  }

  std::size_t most_, kept_ = 0;
  Cell (*cell_)(const StepFacts&);
  Dice dice_;
  std::map<Cell, Stratum> strata_;
};

}  // namespace

std::unique_ptr<StepSample> make_sample(const StepSelection& selection, std::uint64_t seed) {
  switch (selection.sampling) {
    case Sampling::kNone:
      return nullptr;
    case Sampling::kHardest:
      return std::make_unique<Hardest>(selection.most);
    case Sampling::kReservoir:
      return std::make_unique<Stratified>(selection.most, seed, one_cell);
    case Sampling::kStratified:
      return std::make_unique<Stratified>(selection.most, seed, cell_of);
  }
  return nullptr;
}

}  // namespace conebench::engine
