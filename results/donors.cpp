#include "results/donors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "results/profiles.h"
#include "results/text.h"

namespace conebench::results {
namespace {

// Receivers and donors by name; own answers are donor "".
struct Pairs {
  std::set<std::string> receivers, donors;
  std::vector<Record> warm;  // records that started from an answer
};

Pairs pairs_of(const std::vector<Record>& records) {
  Pairs pairs;
  for (const Record& record : records) {
    if (record.sequence.id.empty() || record.sequence.index == 0) continue;
    pairs.receivers.insert(record.solver);
    pairs.donors.insert(record.donor);
    pairs.warm.push_back(record);
  }
  return pairs;
}

// The rows of the table that every pair solves.
std::vector<const TimeTable::Row*> solved_by_all(const TimeTable& table) {
  std::vector<const TimeTable::Row*> rows;
  for (const TimeTable::Row& row : table.rows) {
    const auto solved = [](double time_s) { return std::isfinite(time_s); };
    if (std::all_of(row.time_s.begin(), row.time_s.end(), solved)) rows.push_back(&row);
  }
  return rows;
}

std::string cell(const TimeTable& table, const std::vector<const TimeTable::Row*>& common,
                 const std::string& pair) {
  const auto found = std::find(table.solvers.begin(), table.solvers.end(), pair);
  if (found == table.solvers.end()) return "";
  const auto k = static_cast<std::size_t>(found - table.solvers.begin());
  std::vector<double> times;
  for (const TimeTable::Row* row : common) times.push_back(row->time_s[k]);
  const auto solved = std::count_if(table.rows.begin(), table.rows.end(),
                                    [&](const auto& row) { return std::isfinite(row.time_s[k]); });
  const auto mean = shifted_geometric_mean(times);
  return fmt::format("{} ({}/{})", mean ? format_time(*mean) : "-", solved, table.rows.size());
}

}  // namespace

Block donor_block(const Group& group) {
  const Pairs pairs = pairs_of(group.methods);
  if (pairs.donors.size() < 2) return {};
  const TimeTable table = comparable(make_time_table(pairs.warm, group.settings.tol));
  const auto common = solved_by_all(table);
  std::vector<std::string> header = {"receiver"};
  for (const std::string& donor : pairs.donors) header.push_back(donor.empty() ? "its own" : donor);
  TextTable of_pairs(header);
  for (const std::string& receiver : pairs.receivers) {
    std::vector<std::string> row = {tick(receiver)};
    for (const std::string& donor : pairs.donors) {
      row.push_back(cell(table, common, contender(receiver, donor)));
    }
    of_pairs.add(row);
  }
  return {fmt::format("Donors and receivers at eta <= {:.0e}", group.settings.tol),
          {std::move(of_pairs)},
          fmt::format("Time of the receiver from the donor's answer to the step before (geometric "
                      "mean, shifted by {}, over the {} steps that every pair solves), and steps "
                      "solved. The first step of a sequence, which starts from r = 0, is left out.",
                      format_time(kMeanShift_s), common.size())};
}

}  // namespace conebench::results
