#pragma once

#include "results/block.h"
#include "results/group.h"
#include "results/plot.h"

namespace conebench::results {

/// What the models' answers are worth on the problem as posed. Empty without models.
Block model_block(const Group& group);

/// The distribution of a model's gap over its answers. The group must have models.
Plot model_plot(const Group& group);

}  // namespace conebench::results
