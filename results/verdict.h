#pragma once

#include <string>
#include <vector>

#include "results/group_numbers.h"

namespace conebench::results {

/// The answer, in words that claim no more than the numbers. Texts as in Block.
struct Verdict {
  std::string sentence;             ///< the answer, for someone who reads nothing else
  std::vector<std::string> facts;   ///< what else the numbers say, a sentence each
  std::vector<std::string> limits;  ///< what they do not say
};

/// The best solver is named alone only if it is shown to be better than every other
/// (GroupNumbers::not_beaten_by_best()).
Verdict verdict(const GroupNumbers& numbers);

}  // namespace conebench::results
