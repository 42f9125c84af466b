#pragma once

#include "results/block.h"
#include "results/group.h"

namespace conebench::results {

/// What warm starts are worth and who gives them: a table of receivers (rows) and
/// donors (columns) at the group's tolerance. Steps that started from an answer only, so without
/// the first one of each sequence. Empty unless some receiver had two donors.
Block donor_block(const Group& group);

}  // namespace conebench::results
