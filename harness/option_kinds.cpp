#include "harness/option_kinds.h"

#include <algorithm>
#include <cctype>
#include <sstream>

namespace conebench::harness {
namespace {

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

std::string upper(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::toupper(c); });
  return text;
}

void add_alternative(const std::string& text, ValueKind& kind) {
  if (text == "SOLVER") {
    kind.solver = true;
  } else if (text == "SCENE") {
    kind.scene = true;
  } else if (text == "FILE" || text == "PATH") {
    kind.file = true;
  } else if (text == "DIR" || text.ends_with("_DIR")) {
    kind.folder = true;
  } else {
    const auto capital =
        std::ranges::find_if(text, [](unsigned char c) { return std::isupper(c) != 0; });
    if (capital != text.begin()) kind.words.emplace_back(text.begin(), capital);
  }
}

}  // namespace

std::vector<const CLI::App*> verbs_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

std::vector<const CLI::Option*> options_of(const CLI::App& app) {
  return app.get_options([](const CLI::Option* option) { return !option->get_group().empty(); });
}

std::vector<std::string> spellings(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

ValueKind value_kind(const CLI::Option& option) {
  ValueKind kind;
  kind.many = option.get_items_expected_max() > 1;
  const std::string type = option.get_type_name();
  const auto open = type.find('{'), close = type.rfind('}');
  if (open != type.npos && close != type.npos) {
    kind.words = split(type.substr(open + 1, close - open - 1), ',');
    return kind;
  }
  const bool named = option.get_positional() && (type.empty() || type == "TEXT");
  for (const std::string& part : split(named ? upper(option.get_name(true, false)) : type, '|')) {
    add_alternative(part, kind);
  }
  return kind;
}

bool takes_value(const CLI::Option& option) { return option.get_items_expected_max() > 0; }

}  // namespace conebench::harness
