#pragma once

#include <filesystem>
#include <fstream>

#include "dem/simulation.h"

namespace conebench::harness {

/// A CSV file with one line a step: contacts, energies, and the wall clock time of its parts.
class DemHistory {
 public:
  /// Begins the file anew, after what the run has done so far. Throws OutputError, as add() does.
  DemHistory(std::filesystem::path path, const dem::Summary& so_far);

  /// After a step. The line is in the file when it returns.
  void add(const dem::Simulation& simulation);

 private:
  void write(const std::string& line);

  std::filesystem::path path_;
  std::ofstream file_;
  dem::Summary before_;  // up to the step before
};

}  // namespace conebench::harness
