#include "results/group.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "results/builds.h"
#include "results/one_host.h"
#include "results/text.h"

namespace conebench::results {

std::vector<double> Group::tolerances() const {
  if (settings.stop == "own") return {settings.tol};
  std::vector<double> tols;
  for (const double t : {1e-4, 1e-6}) {
    if (t > settings.tol) tols.push_back(t);
  }
  tols.push_back(settings.tol);
  return tols;
}

std::vector<Group> group_by_settings(std::span<const Record> records) {
  const OneHost hosts(records);
  const Builds builds(records, hosts);
  std::vector<Group> groups;
  for (const Record& record : records) {
    if (!hosts.counts(record)) continue;
    auto group = std::find_if(groups.begin(), groups.end(),
                              [&](const Group& g) { return g.settings == record.settings; });
    if (group == groups.end()) {
      groups.push_back({.settings = record.settings, .methods = {}, .models = {}});
      group = groups.end() - 1;
    }
    auto& members = record.kind == "model" ? group->models : group->methods;
    members.push_back(record);
    members.back().solver = builds.name(record);
  }
  return groups;
}

std::string describe(const Settings& settings) {
  std::string text = fmt::format("stop = {}, tol = {:.0e}", settings.stop, settings.tol);
  if (settings.mode != "cold") text += ", " + settings.mode;
  if (settings.timing != "once") text += ", medians of repeated solves";
  if (settings.threads != 1) text += fmt::format(", {} threads", settings.threads);
  if (std::isfinite(settings.time_limit_s)) {
    text += fmt::format(", time limit {}", format_time(settings.time_limit_s));
  }
  if (settings.memory_limit_bytes > 0) {
    text += fmt::format(", memory limit {} MiB", settings.memory_limit_bytes >> 20);
  }
  return text;
}

}  // namespace conebench::results
