#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace conebench::harness {

using Json = nlohmann::ordered_json;

/// Text columns to the left, all others to the right, as wide as they need to be.
void print_table(const std::vector<std::vector<std::string>>& rows, std::size_t text_columns);

/// What is no UTF-8 is replaced. `indent` as of Json::dump().
std::string dumped(const Json& json, int indent);
void print_json(const Json& json);

/// A string as it is, other values as JSON says them, with 6 digits.
std::string text_of(const Json& value);

}  // namespace conebench::harness
