#pragma once

#include <string>
#include <vector>

#include "results/text.h"

namespace conebench::results {

/// A part of a report in words and tables, the same in Markdown, in the page and in LaTeX.
struct Block {
  std::string title{};
  std::vector<TextTable> tables{};
  /// After the tables. Paragraphs, apart by an empty line, or list items ("- ...", a line each); in
  /// them `x` is code, *x* and **x** are emphasised.
  std::string text{};

  bool empty() const { return tables.empty() && text.empty(); }
};

/// "### title", tables, text; empty for an empty block.
std::string markdown(const Block& block, int level);

}  // namespace conebench::results
