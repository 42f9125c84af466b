#include "dem/generators/crowd.h"

#include "problems/error.h"

namespace conebench::dem {

void check_crowd(double bodies, std::string_view key, const Nursery& nursery) {
  problems::require(bodies <= kLargestCrowd, nursery.subject(), key, ": asks for ", bodies,
                    " bodies, expected at most ", kLargestCrowd);
}

}  // namespace conebench::dem
