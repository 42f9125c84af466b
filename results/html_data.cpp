#include "results/html_data.h"

#include <fmt/format.h>
#include <openssl/evp.h>
#include <zlib.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>

#include "problems/error.h"
#include "results/anytime.h"
#include "results/hardness.h"
#include "results/svg_plot.h"

namespace conebench::results {
namespace {

using nlohmann::json;

constexpr double kCurveGain = 2.0;  // a curve shows each halving of eta

json rounded(double value) {
  if (!std::isfinite(value)) return nullptr;
  return std::strtod(fmt::format("{:.2e}", value).c_str(), nullptr);
}

// Four digits more than the others, so that neighbouring contacts stay apart.
json place(double value) { return std::strtod(fmt::format("{:.6g}", value).c_str(), nullptr); }

const char* name(Quantity quantity) {
  switch (quantity) {
    case Quantity::kShare:
      return "share";
    case Quantity::kTime:
      return "time";
    case Quantity::kRatio:
      return "ratio";
    case Quantity::kEta:
      return "eta";
    case Quantity::kCount:
      return "count";
    case Quantity::kName:
      return "name";
  }
  return "";
}

const char* name(Mark mark) {
  switch (mark) {
    case Mark::kSteps:
      return "steps";
    case Mark::kLines:
      return "lines";
    case Mark::kDots:
      return "dots";
  }
  return "";
}

json axis(const Axis& a) {
  const char* scale = a.scale == Scale::kLinear ? "linear"
                      : a.scale == Scale::kLog2 ? "log2"
                                                : "log10";
  json marks = json::array();
  for (const Tick& tick : ticks(a)) marks.push_back({tick.value, tick.label});
  return {{"label", a.label}, {"quantity", name(a.quantity)}, {"scale", scale}, {"low", a.low},
          {"high", a.high},   {"falling", a.falling},         {"ticks", marks}};
}

// null: not solved, false: not run.
json times_json(const std::vector<std::optional<double>>& times_s) {
  json times = json::array();
  for (const auto& time_s : times_s) {
    if (!time_s) {
      times.push_back(false);
    } else if (!std::isfinite(*time_s)) {
      times.push_back(nullptr);
    } else {
      times.push_back(std::strtod(fmt::format("{:.5g}", *time_s).c_str(), nullptr));
    }
  }
  return times;
}

json series_json(const Series& s, std::size_t colours, std::size_t dash) {
  json x = json::array(), y = json::array(), low = json::array(), high = json::array();
  bool intervals = false;
  for (const PlotPoint& p : s.points) {
    x.push_back(std::strtod(fmt::format("{:.5g}", p.x).c_str(), nullptr));
    y.push_back(std::strtod(fmt::format("{:.4g}", p.y).c_str(), nullptr));
    low.push_back(p.x_interval ? rounded(p.x_interval->low) : json());
    high.push_back(p.x_interval ? rounded(p.x_interval->high) : json());
    intervals = intervals || p.x_interval.has_value();
  }
  json series = {{"name", s.name}, {"note", s.note}, {"colour", s.style % colours},
                 {"dash", dash},   {"x", x},         {"y", y}};
  if (intervals) series.update({{"low", low}, {"high", high}});
  if (!s.times_s.empty()) series["times"] = times_json(s.times_s);
  return series;
}

// Of each problem and contender the record of the last repetition.
using LastRecords = std::map<std::pair<std::string, std::string>, const Record*>;

LastRecords last_records(std::span<const Record> records) {
  LastRecords last;
  for (const Record& record : records) {
    const Record*& kept = last[{record.problem.content_sha256, contender(record)}];
    if (!kept || record.repetition >= kept->repetition) kept = &record;
  }
  return last;
}

json curves_json(const TimeTable& table, const LastRecords& last) {
  json curves = json::object();
  std::size_t left = kMostCurvePoints;
  for (const std::size_t row : hardest_first(table)) {
    json of_row = json::array();
    std::size_t points = 0;
    for (std::size_t s = 0; s < table.solvers.size(); ++s) {
      const auto found = last.find({table.rows[row].problem.content_sha256, table.solvers[s]});
      if (found == last.end()) continue;
      json times = json::array(), etas = json::array();
      for (const CurvePoint& p : best_so_far(*found->second, kCurveGain)) {
        times.push_back(rounded(p.time_s));
        etas.push_back(rounded(p.eta));
      }
      points += times.size();
      if (!times.empty()) of_row.push_back({s, times, etas});
    }
    if (points > left) break;
    left -= points;
    if (!of_row.empty()) curves[fmt::format("{}", row)] = std::move(of_row);
  }
  return curves;
}

std::size_t number_of(std::vector<std::string>& names, const std::string& wanted) {
  for (std::size_t i = names.size(); i-- > 0;) {
    if (names[i] == wanted) return i;
  }
  names.push_back(wanted);
  return names.size() - 1;
}

json places(const problems::Geometry::Table& table) {
  json values = json::array();
  for (const double value : table.reshaped<Eigen::RowMajor>()) values.push_back(place(value));
  return values;
}

json rounded(const Eigen::VectorXd& values) {
  json list = json::array();
  for (const double value : values) list.push_back(rounded(value));
  return list;
}

json answer_json(const AnswerView& a) {
  json state = json::array();
  for (const ContactState s : a.state) state.push_back(static_cast<int>(s));
  return {{"solver", a.solver},
          {"eta", rounded(a.eta)},
          {"force", rounded(a.force)},
          {"normal_force", rounded(a.normal_force)},
          {"eta_of_cone", rounded(a.eta_of_cone)},
          {"penetration", rounded(a.penetration)},
          {"cone_violation", rounded(a.cone_violation)},
          {"work", rounded(a.work)},
          {"misalignment", rounded(a.misalignment)},
          {"state", state}};
}

}  // namespace

json to_json(std::span<const Plot* const> variants) {
  const Plot& first = *variants.front();
  json all = json::array();
  for (const Plot* plot : variants) {
    json series = json::array();
    for (const Series& s : plot->series) {
      series.push_back(series_json(s, kSvgColours, dash_of(s.style)));
    }
    all.push_back(
        {{"choice", plot->choice},
         {"title",
          plot->choice.empty() ? plot->title : fmt::format("{}, {}", plot->title, plot->choice)},
         {"x", axis(plot->x)},
         {"y", axis(plot->y)},
         {"series", std::move(series)}});
  }
  return {{"id", first.id}, {"mark", name(first.mark)}, {"variants", std::move(all)}};
}

json problems_json(const TimeTable& table, std::span<const Record> records) {
  const LastRecords last = last_records(records);
  const json lists(table.solvers.size(), json::array());
  json names = json::array(), family = json::array(), cones = json::array();
  json time_s = lists, status = lists, eta = lists, iterations = lists;
  std::vector<std::string> families;
  for (const auto& row : table.rows) {
    names.push_back(row.problem.name);
    family.push_back(number_of(families, row.problem.family));
    cones.push_back(row.problem.cones);
    for (std::size_t s = 0; s < table.solvers.size(); ++s) {
      const auto found = last.find({row.problem.content_sha256, table.solvers[s]});
      const Record* record = found == last.end() ? nullptr : found->second;
      time_s[s].push_back(rounded(row.time_s[s]));
      status[s].push_back(row.status[s] ? json(static_cast<int>(*row.status[s])) : json());
      eta[s].push_back(record ? rounded(record->eta) : json());
      iterations[s].push_back(record ? json(record->iterations) : json());
    }
  }
  json statuses = json::array();
  for (const Status s : all_statuses()) statuses.push_back(to_string(s));
  return {{"tol", table.tol},
          {"solvers", table.solvers},
          {"statuses", statuses},
          {"families", families},
          {"name", names},
          {"family", family},
          {"cones", cones},
          {"time_s", time_s},
          {"status", status},
          {"eta", eta},
          {"iterations", iterations},
          {"curves", curves_json(table, last)}};
}

json to_json(const ProblemView& view) {
  const problems::Geometry& g = view.geometry;
  json answers = json::array(), cohesive = json::array();
  for (const AnswerView& answer : view.answers) answers.push_back(answer_json(answer));
  for (const bool c : view.cohesive) cohesive.push_back(c ? 1 : 0);
  json pairs = json::array();
  for (const int body : g.bodies_of_cone.reshaped<Eigen::RowMajor>()) pairs.push_back(body);
  return {{"name", view.name},
          {"family", view.family},
          {"force_unit", view.force_unit},
          {"rate_unit", view.rate_unit},
          {"points", places(g.points)},
          {"frames", places(g.frames.leftCols(std::min<Eigen::Index>(3, g.frames.cols())))},
          {"bodies_of_cone", pairs},
          {"body_positions", places(g.body_positions)},
          {"body_radii", rounded(g.body_radii)},
          {"volume_fraction", rounded(g.volume_fraction)},
          {"cohesive", cohesive},
          {"answers", answers},
          {"rate_difference", rounded(view.rate_difference)},
          {"force_difference", rounded(view.force_difference)}};
}

std::string packed(const std::string& text) {
  uLongf size = ::compressBound(static_cast<uLong>(text.size()));
  std::vector<Bytef> bytes(size);
  const int code = ::compress2(bytes.data(), &size, reinterpret_cast<const Bytef*>(text.data()),
                               static_cast<uLong>(text.size()), Z_BEST_COMPRESSION);
  if (code != Z_OK) throw problems::OutputError("the page's data", "zlib could not pack them");
  std::vector<unsigned char> letters(4 * ((size + 2) / 3) + 1);
  const int length = ::EVP_EncodeBlock(letters.data(), bytes.data(), static_cast<int>(size));
  return {letters.begin(), letters.begin() + length};
}

}  // namespace conebench::results
