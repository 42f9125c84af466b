#include "harness/survey/tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "harness/survey/survey.h"

namespace conebench::harness {
namespace {

void mention(std::vector<std::string>& names, const std::string& name) {
  if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
}

}  // namespace

std::string& Table::at(const std::string& row, const std::string& column) {
  mention(rows_, row);
  mention(columns_, column);
  return cells_[{row, column}];
}

void Table::print() const {
  fmt::print("\n| {} |", corner_);
  for (const std::string& column : columns_) fmt::print(" {} |", column);
  fmt::print("\n|---|");
  for (std::size_t k = 0; k < columns_.size(); ++k) fmt::print("---|");
  for (const std::string& row : rows_) {
    fmt::print("\n| {} |", row);
    for (const std::string& column : columns_) {
      const auto cell = cells_.find({row, column});
      fmt::print(" {} |", cell == cells_.end() ? "" : cell->second);
    }
  }
  fmt::print("\n");
  std::fflush(stdout);
}

void Shares::add(const solvers::Solver& solver, const std::string& column, const Attempt& tried,
                 bool worst_at_tip) {
  if (tried.end == Attempt::End::kRefused) return;
  Share& share = shares_[{solver.name, column}];
  ++share.tried;
  table_.at(solver.name, column);
  if (tried.solved(kSurveyTol)) {
    ++share.solved;
    return;
  }
  Rest& rest = rest_[solver.name];
  ++rest.endings[ending(tried)];
  if (worst_at_tip) ++rest.worst_at_tip;
  rest.worst = std::max(rest.worst, tried.eta);
}

void Shares::print(bool with_rest) {
  for (const auto& [key, share] : shares_) {
    table_.at(key.first, key.second) = fmt::format("{}/{}", share.solved, share.tried);
  }
  if (with_rest) {
    for (const auto& [solver, rest] : rest_) {
      std::string& cell = table_.at(solver, "the others");
      for (const auto& [end, count] : rest.endings) cell += fmt::format("{} {}, ", count, end);
      cell += fmt::format("eta up to {:.1e}", rest.worst);
      if (rest.worst_at_tip > 0) cell += fmt::format("; {} worst at a tip", rest.worst_at_tip);
    }
  }
  table_.print();
}

std::string short_answer(const Attempt& tried) {
  if (tried.end == Attempt::End::kRefused) return "";
  if (tried.end != Attempt::End::kReturned) return ending(tried);
  const bool converged = tried.status == solvers::Status::kConverged;
  return fmt::format("{}{:.0e}", converged ? "" : ending(tried) + ", ", tried.eta);
}

}  // namespace conebench::harness
