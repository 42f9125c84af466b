#include "results/rank_stability.h"

#include <algorithm>
#include <map>
#include <set>

#include "results/bootstrap.h"

namespace conebench::results {
namespace {

using Order = std::vector<std::string>;  // best first

Order order_of(const TimeTable& table) {
  Order order;
  for (const Rank& line : rank(table)) order.push_back(line.solver);
  return order;
}

TimeTable without_scene(const TimeTable& table, const std::string& scene) {
  TimeTable rest = table;
  std::erase_if(rest.rows, [&](const auto& row) { return scene_of(row.problem) == scene; });
  return rest;
}

void add_flips(std::vector<Flip>& flips, const std::string& left_out, const Order& full,
               const Order& rest) {
  const auto place_in_rest = [&](const std::string& solver) {
    return std::find(rest.begin(), rest.end(), solver);
  };
  for (auto a = full.begin(); a != full.end(); ++a) {
    for (auto b = std::next(a); b != full.end(); ++b) {
      if (*a == left_out || *b == left_out) continue;
      if (place_in_rest(*b) < place_in_rest(*a)) flips.push_back({left_out, *a, *b});
    }
  }
}

// The place of rest[i] if the solver that was left out had kept its own.
int place(const Order& full, const std::string& left_out, std::size_t i) {
  const auto own = std::find(full.begin(), full.end(), left_out);
  const auto above = static_cast<std::size_t>(own - full.begin());
  return static_cast<int>(own != full.end() && above <= i ? i + 2 : i + 1);
}

// Widens the ranges by the places that are taken without `left_out`.
class Ranges {
 public:
  explicit Ranges(const Order& full) : full_(full) {
    for (std::size_t i = 0; i < full.size(); ++i) {
      const int at = static_cast<int>(i + 1);
      ranges_[full[i]] = {full[i], at, at, at, at, at};
    }
  }

  void without_scene(const Order& rest) {
    for (std::size_t i = 0; i < rest.size(); ++i) {
      PlaceRange& range = ranges_[rest[i]];
      const int at = static_cast<int>(i + 1);
      range.best_by_scene = std::min(range.best_by_scene, at);
      range.worst_by_scene = std::max(range.worst_by_scene, at);
    }
  }

  void without_solver(const std::string& left_out, const Order& rest) {
    for (std::size_t i = 0; i < rest.size(); ++i) {
      PlaceRange& range = ranges_[rest[i]];
      const int at = place(full_, left_out, i);
      range.best_by_solver = std::min(range.best_by_solver, at);
      range.worst_by_solver = std::max(range.worst_by_solver, at);
    }
  }

  std::vector<PlaceRange> in_order() const {
    std::vector<PlaceRange> places;
    for (const std::string& solver : full_) places.push_back(ranges_.at(solver));
    return places;
  }

 private:
  const Order& full_;
  std::map<std::string, PlaceRange> ranges_;
};

}  // namespace

Stability rank_stability(const TimeTable& table) {
  const Order full = order_of(table);
  Ranges ranges(full);
  Stability result;
  std::set<std::string> scenes;
  for (const auto& row : table.rows) scenes.insert(scene_of(row.problem));
  for (const std::string& scene : scenes) {
    if (scenes.size() == 1) break;  // without it there is nothing to rank
    const Order rest = order_of(without_scene(table, scene));
    add_flips(result.scene_flips, scene, full, rest);
    ranges.without_scene(rest);
  }
  for (std::size_t s = 0; s < table.solvers.size(); ++s) {
    const Order rest = order_of(without_solver(table, s));
    add_flips(result.solver_flips, table.solvers[s], full, rest);
    ranges.without_solver(table.solvers[s], rest);
  }
  result.places = ranges.in_order();
  return result;
}

}  // namespace conebench::results
