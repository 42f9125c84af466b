#include "results/deadlines.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "results/profiles.h"
#include "results/tails.h"

namespace conebench::results {

double eta_at(const Record& record, double deadline_s) {
  const double returned = std::isnan(record.eta) ? Record::kUnknown : record.eta;
  if (record.curve.empty()) {
    return record.setup_s + record.solve_s <= deadline_s ? returned : Record::kUnknown;
  }
  double best = Record::kUnknown;
  for (const CurvePoint& point : record.curve) {
    if (point.time_s <= deadline_s) best = std::min(best, point.eta);
  }
  return std::max(best, returned);
}

std::vector<DeadlineRow> deadline_rows(std::span<const Record> records, double deadline_s) {
  const TimeTable table = comparable(make_time_table(records, 1.0));
  std::set<std::string> shown;
  for (const auto& row : table.rows) shown.insert(row.problem.content_sha256);

  std::map<std::string, DeadlineRow> rows;
  std::map<std::string, std::vector<double>> etas;
  for (const Record& record : records) {
    if (!shown.contains(record.problem.content_sha256)) continue;
    const std::string name = contender(record);
    const double eta = eta_at(record, deadline_s);
    DeadlineRow& row = rows[name];
    row.solver = name;
    ++row.tasks;
    if (!(eta <= record.settings.tol)) ++row.missed;
    etas[name].push_back(eta);
  }
  std::vector<DeadlineRow> result;
  for (auto& [name, row] : rows) {
    row.median_eta = order_statistic(etas[name], 0.5);
    row.p90_eta = order_statistic(etas[name], 0.9);
    result.push_back(row);
  }
  return result;
}

std::vector<double> usual_deadlines_s(double time_limit_s) {
  std::vector<double> deadlines_s;
  for (const double deadline_s : {1e-3, 1e-2, 1e-1, 1.0}) {
    if (deadline_s < time_limit_s) deadlines_s.push_back(deadline_s);
  }
  return deadlines_s;
}

}  // namespace conebench::results
