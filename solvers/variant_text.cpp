#include "solvers/variant_text.h"

#include <fmt/format.h>

#include "problems/error.h"

namespace conebench::solvers {
namespace {

using problems::require;

std::string trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return std::string(text.substr(first, text.find_last_not_of(" \t") - first + 1));
}

}  // namespace

std::vector<std::map<std::string, std::string>> VariantText::combinations() const {
  std::vector<std::map<std::string, std::string>> grid{{}};
  for (const Item& item : items) {
    std::vector<std::map<std::string, std::string>> wider;
    for (const auto& values : grid) {
      for (const std::string& value : item.values) {
        wider.push_back(values);
        wider.back()[item.key] = value;
      }
    }
    grid = std::move(wider);
  }
  return grid;
}

VariantText parse_variant(std::string_view given) {
  const std::string text = trimmed(given);
  const auto open = text.rfind('[');
  VariantText parsed{trimmed(text.substr(0, open)), {}};
  if (open == std::string::npos) return parsed;
  require(text.back() == ']', text, "has '[' without a final ']', expected name[key=value,...]");
  std::string_view body = std::string_view(text).substr(open + 1, text.size() - open - 2);
  while (!trimmed(body).empty()) {
    const auto comma = body.find(',');
    const std::string_view item = body.substr(0, comma);
    const auto equals = item.find('=');
    if (equals != std::string_view::npos) {
      parsed.items.push_back({trimmed(item.substr(0, equals)), {trimmed(item.substr(equals + 1))}});
    } else {
      require(!parsed.items.empty(), text, "starts with '", trimmed(item),
              "', expected name[key=value,...]");
      parsed.items.back().values.push_back(trimmed(item));
    }
    body = comma == std::string_view::npos ? std::string_view{} : body.substr(comma + 1);
  }
  return parsed;
}

VariantText parse_file_variant(std::string_view given) {
  const std::string text = trimmed(given);
  return text.ends_with(']') ? parse_variant(text) : VariantText{text, {}};
}

std::string variant_text(const std::string& name,
                         const std::map<std::string, std::string>& values) {
  if (values.empty()) return name;
  std::vector<std::string> items;
  for (const auto& [key, value] : values) items.push_back(key + "=" + value);
  return fmt::format("{}[{}]", name, fmt::join(items, ","));
}

}  // namespace conebench::solvers
