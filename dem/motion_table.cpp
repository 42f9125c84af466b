#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <numbers>

#include "dem/motion.h"
#include "problems/error.h"

namespace conebench::dem {
namespace {

using problems::InputError;

constexpr std::array<std::string_view, 7> kColumns = {"t_s",    "x_m",    "y_m",   "z_m",
                                                      "rx_rad", "ry_rad", "rz_rad"};
constexpr std::size_t kWithoutTurns = 4;
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields;
  for (std::size_t comma = 0; comma != std::string_view::npos;) {
    comma = line.find(',');
    fields.push_back(trimmed(line.substr(0, comma)));
    line.remove_prefix(std::min(line.size(), comma) + (comma < line.size()));
  }
  return fields;
}

// A line of a table as numbers, in the order of kColumns; what is not in the file is 0.
using Line = std::array<double, kColumns.size()>;

Eigen::Vector3d turn_of(const Line& line) { return {line[4], line[5], line[6]}; }

class TableReader {
 public:
  TableReader(const std::filesystem::path& file, std::string_view subject)
      : subject_(subject), file_(file.string()), in_(file, std::ios::binary) {
    require_here(in_.is_open(), "cannot be opened for reading");
  }

  /// The lines after the one with the names.
  std::vector<Line> lines() {
    read_names();
    std::vector<Line> lines;
    while (next_line()) {
      lines.push_back(numbers());
      if (lines.size() > 1) check_step(lines[lines.size() - 2], lines.back());
    }
    require_here(!in_.bad(), "cannot be read");
    require_here(lines.size() >= 2, "has ", lines.size(), " lines of numbers, expected at least 2");
    return lines;
  }

 private:
  // Throws with subject and file, and with the line once there is one.
  template <class... Parts>
  void require_here(bool ok, const Parts&... detail) const {
    if (ok) return;
    const std::string line = line_ == 0 || !in_ ? "" : "line " + std::to_string(line_) + ": ";
    problems::require(false, subject_, file_, ": ", line, detail...);
  }

  // Goes to the next line that is not blank.
  bool next_line() {
    while (std::getline(in_, text_)) {
      ++line_;
      if (!trimmed(text_).empty()) return true;
    }
    return false;
  }

  void read_names() {
    const bool found = next_line();
    require_here(!in_.bad(), "cannot be read");
    require_here(found, "is empty, expected a first line with the names of the columns");
    std::string_view names = text_;
    if (line_ == 1 && names.starts_with(kByteOrderMark)) names.remove_prefix(kByteOrderMark.size());
    const auto fields = fields_of(names);
    count_ = fields.size();
    const bool known = (count_ == kWithoutTurns || count_ == kColumns.size()) &&
                       std::equal(fields.begin(), fields.end(), kColumns.begin());
    require_here(known, "found the columns '", trimmed(names),
                 "', expected t_s,x_m,y_m,z_m or t_s,x_m,y_m,z_m,rx_rad,ry_rad,rz_rad");
  }

  Line numbers() const {
    const auto fields = fields_of(text_);
    require_here(fields.size() == count_, "found ", fields.size(), " columns, expected ", count_);
    Line line{};
    for (std::size_t k = 0; k < count_; ++k) line[k] = number(fields[k], kColumns[k]);
    return line;
  }

  double number(std::string_view text, std::string_view column) const {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole = error == std::errc() && end == text.data() + text.size();
    require_here(whole && std::isfinite(value), "column ", column, ": found '", text,
                 "', expected a finite number");
    return value;
  }

  void check_step(const Line& last, const Line& line) const {
    require_here(line[0] > last[0], "column t_s: found ", line[0], " after ", last[0],
                 ", expected increasing times");
    const double turn = (turn_of(line) - turn_of(last)).norm();
    require_here(turn < std::numbers::pi, "columns rx_rad to rz_rad: a change of ", turn,
                 " rad from the line before, expected less than pi (give more lines, and do not "
                 "wrap the angles)");
  }

  std::string subject_, file_;
  std::ifstream in_;
  std::string text_;
  int line_ = 0;
  std::size_t count_ = 0;
};

Eigen::Quaterniond rotation(const Eigen::Vector3d& turn) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(turn.norm(), turn.stableNormalized()));
}

}  // namespace

Table read_table(const std::filesystem::path& file, const Eigen::Vector3d& point_m,
                 std::string_view subject) {
  Table table{.file = file, .point_m = point_m, .t_s = {}, .poses = {}};
  for (const Line& line : TableReader(file, subject).lines()) {
    table.t_s.push_back(line[0]);
    table.poses.push_back({{line[1], line[2], line[3]}, rotation(turn_of(line))});
  }
  return table;
}

}  // namespace conebench::dem
