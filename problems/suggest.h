#pragma once

#include <span>
#include <string>
#include <string_view>

namespace conebench::problems {

/// " (did you mean 'X'?)" for the known word nearest to `word` in edit distance, if near enough to
/// be a slip of the fingers (at most a third of its letters); else "".
std::string suggestion(std::string_view word, std::span<const std::string> known);

}  // namespace conebench::problems
