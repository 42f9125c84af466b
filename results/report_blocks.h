#pragma once

#include <span>
#include <string>
#include <vector>

#include "results/block.h"
#include "results/group_numbers.h"
#include "results/report.h"

namespace conebench::results {

/// "82 problems, 11 solvers, 902 tasks, ...": what the whole report is about.
std::string summary_text(std::span<const Record> records);

/// One block a tolerance of the group, loosest first.
std::vector<Block> ranking_blocks(const Group& group);

/// How a ranking is made.
std::string ranking_note();

/// How many tasks of each solver ended how, models included.
Block status_block(const Group& group);

/// Machines, dates, command, and what speaks against the times.
Block environment_block(const ReportInput& input);

/// What no report of this program can say.
Block limits_block();

}  // namespace conebench::results
