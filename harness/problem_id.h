#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "problems/problem.h"
#include "results/record.h"

namespace conebench::harness {

/// Fills in what is still empty: name, hash, family, number of cones.
void complete(results::ProblemId& id, const problems::Problem& problem);

/// A problem of a campaign: what it is, and how a worker gets it.
struct ProblemSource {
  results::ProblemId id;
  std::function<problems::Problem()> load;
};

/// The problem in a file, read again by every worker.
ProblemSource source_from_file(const std::filesystem::path& path);

/// What the files and folders hold, equal content once. Every file is read in a process of its own.
struct FoundSources {
  std::vector<ProblemSource> problems;
  int skipped = 0;                      ///< files in folders that are no problem file
  int twins = 0;                        ///< files whose content came before under another path
  std::vector<std::string> unreadable;  ///< one line for each problem file that cannot be used
  bool interrupted = false;
};

/// Throws InputError when there is nothing to solve, or when a *named* file cannot be used.
FoundSources find_sources(const std::vector<std::filesystem::path>& paths, int jobs);

}  // namespace conebench::harness
