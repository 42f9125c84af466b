#pragma once

#include <string>

#include "solvers/solver.h"

namespace conebench::harness {

/// A parameter's schema in words: "number", ">= 1", "0.5".
std::string type_text(const solvers::Parameter& parameter);
std::string range_text(const solvers::Parameter& parameter);
std::string value_text(const solvers::Value& value);

}  // namespace conebench::harness
