#pragma once

#include <string>
#include <vector>

namespace conebench::results {

/// "740 us", "12.3 ms", "4.56 s": three digits and a unit; "-" when infinite or NaN.
std::string format_time(double time_s);

/// "3.1e-09"; "-" when infinite or NaN.
std::string format_eta(double eta);

/// "`gs`": a name as code.
std::string tick(const std::string& name);

/// A Markdown table whose columns are padded, so that it reads well in a terminal too.
class TextTable {
 public:
  /// The first column is aligned to the left, the others to the right.
  explicit TextTable(std::vector<std::string> header);
  void add(std::vector<std::string> row);  ///< as many cells as the header
  std::string text() const;

  /// The header first. In a cell, `x` is code and *x* is emphasised.
  const std::vector<std::vector<std::string>>& rows() const { return rows_; }

 private:
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace conebench::results
