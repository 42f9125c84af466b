#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace conebench::solvers {

/// A solver's text form in its parts: "gs[omega=0.8,1.0]" is "gs" and omega in {"0.8", "1.0"}.
struct VariantText {
  struct Item {
    std::string key;
    std::vector<std::string> values;  ///< one or more
  };
  std::string name;
  std::vector<Item> items;  ///< in the order given

  /// One value for each key, in every combination; one empty map without items. Of a key that is
  /// given twice, the later counts.
  std::vector<std::map<std::string, std::string>> combinations() const;
};

/// Takes name[key=value,...] apart; inside [] an item without `=` continues the previous list.
/// Throws problems::InputError when it is not of that form.
VariantText parse_variant(std::string_view text);

/// The same where the name is a file, in which '[' is a letter like others: what does not end with
/// ']' is all name.
VariantText parse_file_variant(std::string_view text);

/// name[key=value,...], or the name alone.
std::string variant_text(const std::string& name, const std::map<std::string, std::string>& values);

}  // namespace conebench::solvers
