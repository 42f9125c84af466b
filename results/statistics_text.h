#pragma once

#include "results/block.h"
#include "results/group_numbers.h"

namespace conebench::results {

/// How far the numbers of a group can be trusted, in tables and words.
Block tails_block(const GroupNumbers& numbers);
Block apart_block(const GroupNumbers& numbers);   ///< empty with one solver
Block shares_block(const GroupNumbers& numbers);  ///< solved against tolerance
Block time_block(const GroupNumbers& numbers);    ///< solved within a time
Block deadline_block(const GroupNumbers& numbers);
Block stability_block(const GroupNumbers& numbers);  ///< empty with one solver

}  // namespace conebench::results
