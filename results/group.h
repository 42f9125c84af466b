#pragma once

#include <span>
#include <string>
#include <vector>

#include "results/record.h"

namespace conebench::results {

/// Records of one kind of comparison: the same settings, methods and models apart.
struct Group {
  Settings settings;
  std::vector<Record> methods;  ///< and peers: they solve the problem as posed
  std::vector<Record> models;   ///< they solve an approximation of it

  /// 1e-4, 1e-6 and the run's own tolerance, those that the run could have met; loosest first. With
  /// stop = own only the run's own: a solver that aims at 1e-8 does not say when it passed 1e-4.
  std::vector<double> tolerances() const;
};

/// In order of first appearance, of the records that OneHost counts. Solvers bear their
/// Builds::name().
std::vector<Group> group_by_settings(std::span<const Record> records);

/// "stop = common, tol = 1e-08, time limit 500 ms".
std::string describe(const Settings& settings);

}  // namespace conebench::results
