#include "harness/parameter_text.h"

#include <fmt/format.h>

#include <cmath>

namespace conebench::harness {

std::string type_text(const solvers::Parameter& parameter) {
  struct Name {
    std::string operator()(bool) const { return "boolean"; }
    std::string operator()(std::int64_t) const { return "whole number"; }
    std::string operator()(double) const { return "number"; }
    std::string operator()(const std::string&) const { return "text"; }
  };
  return std::visit(Name(), parameter.fallback);
}

std::string range_text(const solvers::Parameter& parameter) {
  if (!parameter.choices.empty()) return fmt::format("{}", fmt::join(parameter.choices, ", "));
  if (std::holds_alternative<bool>(parameter.fallback)) return "true, false";
  const bool low = std::isfinite(parameter.low), high = std::isfinite(parameter.high);
  if (low && high) return fmt::format("{} to {}", parameter.low, parameter.high);
  if (low) return fmt::format(">= {}", parameter.low);
  if (high) return fmt::format("<= {}", parameter.high);
  return "any";
}

std::string value_text(const solvers::Value& value) {
  return std::visit([](const auto& v) { return fmt::format("{}", v); }, value);
}

}  // namespace conebench::harness
