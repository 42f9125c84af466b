#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "harness/campaign.h"
#include "results/record.h"

namespace conebench::harness {

/// The solvers of several variant texts, grids expanded, each once.
std::vector<solvers::Solver> make_all_solvers(const std::vector<std::string>& variants);

/// What was found, skipped and cannot be used, on stderr.
void tell(const FoundSources& found);

/// What a campaign did, on stderr. Returns the exit code: 0, 130 when interrupted, 3 when tasks
/// were lost.
int tell(const CampaignSummary& summary);

/// The rankings of every group of settings, loosest tolerance first, and what they show at the
/// group's own, on stdout.
void print_rankings(std::span<const results::Record> records);

/// A journal's records; tells of torn lines on stderr. InputError when there is no journal.
std::vector<results::Record> load_records(const std::filesystem::path& results_dir);

}  // namespace conebench::harness
