#pragma once

#include <string>
#include <string_view>

#include "results/block.h"

namespace conebench::results {

/// The words of a Block as HTML: `x`, *x*, **x**, paragraphs and lists; everything else is escaped.
std::string html_inline(std::string_view text);
std::string html_paragraphs(std::string_view text);

/// A table that scrolls sideways by itself; numbers are aligned to the right.
std::string html_table(const TextTable& table);

/// "<h3>title</h3>", tables, text; folded into a <details> whose summary is the title. Empty for an
/// empty block.
std::string html_block(const Block& block);
std::string html_folded(const Block& block);

}  // namespace conebench::results
