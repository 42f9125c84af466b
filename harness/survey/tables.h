#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "harness/survey/attempt.h"

namespace conebench::harness {

/// A Markdown table; rows and columns in the order of their first mention.
class Table {
 public:
  explicit Table(std::string corner) : corner_(std::move(corner)) {}

  std::string& at(const std::string& row, const std::string& column);
  void print() const;

 private:
  std::string corner_;
  std::vector<std::string> rows_, columns_;
  std::map<std::pair<std::string, std::string>, std::string> cells_;
};

/// Shares of solved problems, one row a solver, and how the rest ended.
class Shares {
 public:
  /// `worst_at_tip`: the largest eta is that of a cone with r' = u = 0 in the known solution.
  void add(const solvers::Solver& solver, const std::string& column, const Attempt& tried,
           bool worst_at_tip);
  void print(bool with_rest);

 private:
  struct Share {
    int solved = 0, tried = 0;
  };
  struct Rest {
    std::map<std::string, int> endings;
    int worst_at_tip = 0;
    double worst = 0.0;
  };

  Table table_{"method"};
  std::map<std::pair<std::string, std::string>, Share> shares_;
  std::map<std::string, Rest> rest_;
};

/// Of a cell: eta, after the status if that is not `converged`; empty for a refusal.
std::string short_answer(const Attempt& tried);

}  // namespace conebench::harness
