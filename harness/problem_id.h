#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "problems/problem_file.h"
#include "results/record.h"

namespace conebench::harness {

/// Fills in what is still empty: name, hash, family, number of cones.
void complete(results::ProblemId& id, const problems::Problem& problem);

/// A problem of a campaign: what it is, and how a worker gets it.
struct ProblemSource {
  results::ProblemId id;
  std::function<problems::ProblemFile()> load;
  std::int64_t step = 0;   ///< of its scene
  bool has_guess = false;  ///< in its file
};

/// A file's content that is a problem alone.
problems::ProblemFile only(problems::Problem problem);

/// The problem in a file, read again by every worker. With an id: what is known of it already.
ProblemSource source_from_file(const std::filesystem::path& path);
ProblemSource source_from_file(const results::ProblemId& id, std::int64_t step, bool has_guess);

/// What the files and folders hold, equal content once. Every file is read in a process of its own.
struct FoundSources {
  std::vector<ProblemSource> problems;
  int skipped = 0;                      ///< files in folders that are no problem file
  int twins = 0;                        ///< files whose content came before under another path
  int unwanted = 0;                     ///< problems that the condition leaves out
  std::vector<std::string> unreadable;  ///< one line for each problem file that cannot be used
  bool interrupted = false;
};

/// `where`: a condition on their facts (harness/where.h); empty: all. Throws InputError when there
/// is nothing to solve, or when a *named* file cannot be used.
FoundSources find_sources(const std::vector<std::filesystem::path>& paths, int jobs,
                          const std::string& where = "");

}  // namespace conebench::harness
