#include "results/block.h"

namespace conebench::results {

std::string markdown(const Block& block, int level) {
  if (block.empty()) return {};
  std::string text = std::string(static_cast<std::size_t>(level), '#') + " " + block.title + "\n\n";
  for (const TextTable& table : block.tables) text += table.text() + "\n";
  return block.text.empty() ? text : text + block.text + "\n\n";
}

}  // namespace conebench::results
