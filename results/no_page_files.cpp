#include "results/page_files.h"

namespace conebench::results {

std::optional<PageFiles> page_files() { return std::nullopt; }

}  // namespace conebench::results
