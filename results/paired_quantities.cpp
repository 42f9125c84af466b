#include "results/paired_quantities.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include "results/profiles.h"
#include "results/tails.h"

namespace conebench::results {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// How often the scene of a pair was drawn is the pair's weight.
using Weights = std::span<const int>;
using Pairs = std::span<const RowPair>;

// A quantity of one side, from that side's number in every pair.
using Side = std::function<double(const RowPair&)>;

// exp(mean(log(value + shift))) - shift over the pairs that both solve; NaN if there are none.
double geometric_mean(Pairs pairs, const Side& side, double shift, Weights weights) {
  double sum = 0.0, count = 0.0;
  for (const RowPair& pair : pairs) {
    if (!pair.both_solved()) continue;
    sum += weights[pair.scene] * std::log(side(pair) + shift);
    count += weights[pair.scene];
  }
  return count > 0.0 ? std::exp(sum / count) - shift : kNaN;
}

// The p-th order statistic over the pairs in `order`, which is by rising value.
double weighted_order_statistic(Pairs pairs, const std::vector<std::size_t>& order,
                                const Side& side, double p, Weights weights) {
  double total = 0.0;
  for (const RowPair& pair : pairs) total += weights[pair.scene];
  double reached = 0.0;
  for (const std::size_t i : order) {
    reached += weights[pairs[i].scene];
    if (reached >= p * total - 1e-9 && reached > 0.0) return side(pairs[i]);
  }
  return kNaN;
}

std::vector<std::size_t> sorted_by(Pairs pairs, const Side& side) {
  std::vector<std::size_t> order(pairs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return side(pairs[a]) < side(pairs[b]); });
  return order;
}

double count_if(Pairs pairs, const std::function<bool(const RowPair&)>& holds, Weights weights) {
  double count = 0.0;
  for (const RowPair& pair : pairs) count += holds(pair) ? weights[pair.scene] : 0;
  return count;
}

std::optional<double> known(double value) {
  return std::isnan(value) ? std::nullopt : std::optional(value);
}

// 0 / 0 and inf / inf are NaN, inf over a number is inf: as floating point has it.
Quantity ratio(const std::string& name, std::size_t scenes,
               const std::function<double(Weights)>& of_base,
               const std::function<double(Weights)>& of_fresh) {
  const std::vector<int> once(scenes, 1);
  const double base = of_base(once), fresh = of_fresh(once);
  const auto statistic = [&](Weights weights) { return of_fresh(weights) / of_base(weights); };
  return {.name = name,
          .base = known(base),
          .fresh = known(fresh),
          .value = known(fresh / base),
          .interval = bootstrap(scenes, statistic)};
}

Quantity mean_ratio(const std::string& name, Pairs pairs, std::size_t scenes, const Side& base,
                    const Side& fresh, double shift) {
  return ratio(
      name, scenes, [&](Weights w) { return geometric_mean(pairs, base, shift, w); },
      [&](Weights w) { return geometric_mean(pairs, fresh, shift, w); });
}

Quantity order_ratio(const std::string& name, Pairs pairs, std::size_t scenes, double p) {
  const Side base = [](const RowPair& pair) { return pair.base_s; };
  const Side fresh = [](const RowPair& pair) { return pair.fresh_s; };
  const auto base_order = sorted_by(pairs, base), fresh_order = sorted_by(pairs, fresh);
  return ratio(
      name, scenes,
      [&](Weights w) { return weighted_order_statistic(pairs, base_order, base, p, w); },
      [&](Weights w) { return weighted_order_statistic(pairs, fresh_order, fresh, p, w); });
}

double iterations_of(const Record& record) {
  return static_cast<double>(std::max<std::int64_t>(record.iterations, 1));
}

// No interval: a maximum of what was not drawn is not known.
Quantity worst_iterations(Pairs pairs) {
  Quantity worst{.name = "worst(iterations)"};
  for (const RowPair& pair : pairs) {
    if (!pair.both_solved()) continue;
    const double of_pair = iterations_of(*pair.fresh) / iterations_of(*pair.base);
    if (worst.value && of_pair <= *worst.value) continue;
    worst.value = of_pair;
    worst.base = iterations_of(*pair.base);
    worst.fresh = iterations_of(*pair.fresh);
  }
  return worst;
}

}  // namespace

std::vector<Quantity> quantities_of(Pairs pairs, std::size_t scenes) {
  const auto eta = [](const Record& r) { return std::max(r.eta, kEtaFloor); };
  std::vector<Quantity> all = {
      mean_ratio(
          "sgm(time)", pairs, scenes, [](const RowPair& p) { return p.base_s; },
          [](const RowPair& p) { return p.fresh_s; }, kMeanShift_s),
      order_ratio("p50(time)", pairs, scenes, 0.5),
      order_ratio("p99(time)", pairs, scenes, 0.99),
      order_ratio("max(time)", pairs, scenes, 1.0),
      mean_ratio(
          "gm(eta)", pairs, scenes, [&](const RowPair& p) { return eta(*p.base); },
          [&](const RowPair& p) { return eta(*p.fresh); }, 0.0),
      mean_ratio(
          "iterations", pairs, scenes, [](const RowPair& p) { return iterations_of(*p.base); },
          [](const RowPair& p) { return iterations_of(*p.fresh); }, 0.0),
      worst_iterations(pairs),
      ratio(
          "solved", scenes,
          [&](Weights w) { return count_if(pairs, std::mem_fn(&RowPair::base_solved), w); },
          [&](Weights w) { return count_if(pairs, std::mem_fn(&RowPair::fresh_solved), w); })};
  const auto lost = [](const RowPair& p) { return p.base_solved() && !p.fresh_solved(); };
  const auto failures = [&](Weights w) { return count_if(pairs, lost, w); };
  all.push_back({.name = "failures",
                 .base = {},
                 .fresh = {},
                 .value = failures(std::vector<int>(scenes, 1)),
                 .interval = bootstrap(scenes, failures)});
  return all;
}

}  // namespace conebench::results
