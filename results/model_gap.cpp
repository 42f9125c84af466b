#include "results/model_gap.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "results/tails.h"

namespace conebench::results {
namespace {

// Of each model, sorted: eta in its own problem; and in the problem as posed, which is its gap only
// where it is not known to have failed at its own.
struct Etas {
  std::vector<double> gap, own;
};

std::map<std::string, Etas> etas_of(const Group& group) {
  std::map<std::string, Etas> etas;
  for (const Record& r : group.models) {
    Etas& of_model = etas[contender(r)];
    of_model.own.push_back(r.model_eta);
    const bool failed = std::isfinite(r.model_eta) && r.model_eta > r.settings.tol;
    if (failed || r.status == Status::kUnsupported) continue;
    of_model.gap.push_back(std::max(r.eta, kEtaFloor));
  }
  for (auto& [model, values] : etas) {
    std::sort(values.gap.begin(), values.gap.end());
    std::sort(values.own.begin(), values.own.end());
  }
  return etas;
}

double median(const std::vector<double>& values) {
  return values.empty() ? Record::kUnknown : order_statistic(values, 0.5);
}

std::ptrdiff_t within(const std::vector<double>& sorted, double tol) {
  return std::upper_bound(sorted.begin(), sorted.end(), tol) - sorted.begin();
}

}  // namespace

Block model_block(const Group& group) {
  if (group.models.empty()) return {};
  const double tol = group.settings.tol;
  TextTable table({"model", "tasks", "its own problem solved", "own eta, median", "eta <= tol",
                   "median gap", "largest gap"});
  for (const auto& [model, etas] : etas_of(group)) {
    table.add({tick(model), fmt::format("{}", etas.own.size()),
               fmt::format("{}", within(etas.own, tol)), format_eta(median(etas.own)),
               fmt::format("{}", within(etas.gap, tol)), format_eta(median(etas.gap)),
               format_eta(etas.gap.empty() ? Record::kUnknown : etas.gap.back())});
  }
  return {"Models",
          {std::move(table)},
          "These solve an approximation of the problem, and are judged twice: *own eta* in the "
          "approximation (a dash: not known), and their *gap*, eta in the problem as posed of "
          "the answers that solve the approximation. The gap is the model's, not a solver's "
          "failure, so they stay out of the profiles."};
}

Plot model_plot(const Group& group) {
  const auto etas = etas_of(group);
  std::vector<double> all;
  for (const auto& [model, values] : etas) {
    all.insert(all.end(), values.gap.begin(), values.gap.end());
  }
  Plot plot{.id = "models",
            .title = "Gap of the models",
            .reading =
                "The share of a model's answers whose eta, on the problem as posed, is at "
                "most this. A model that ends below 100 % left some without an answer.",
            .mark = Mark::kSteps,
            .x = log_axis("eta of the model's answer [-]", Quantity::kEta, all),
            .y = {.label = "answers [% of all]", .quantity = Quantity::kShare}};
  for (const auto& [model, values] : etas) {
    plot.series.push_back(
        {.name = model,
         .style = plot.series.size(),
         .points = points_of(cumulative_shares(values.gap, values.own.size()), plot.x, plot.y)});
  }
  return plot;
}

}  // namespace conebench::results
