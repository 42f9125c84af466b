#pragma once

#include <filesystem>
#include <fstream>

#include "mpm/simulation.h"

namespace conebench::harness {

/// A CSV file with one line a step: what the heap is like after it, and what it cost.
class MpmHistory {
 public:
  /// Begins the file anew, after what the run has done so far. Throws OutputError, as add() does.
  MpmHistory(std::filesystem::path path, const mpm::Summary& so_far);

  /// After a step of size `h`. The line is in the file when it returns.
  void add(const mpm::Simulation& simulation, double h);

 private:
  void write(const std::string& line);

  std::filesystem::path path_;
  std::ofstream file_;
  std::int64_t solves_, iterations_;  // up to the step before
};

}  // namespace conebench::harness
