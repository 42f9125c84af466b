#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>

#include "solvers/solver.h"

namespace conebench::harness {

/// The options that every solving verb has: --tol, --time-limit, --mem, --hard-limit, --stop.
/// Texts as the user gave them; the functions check them and throw problems::InputError.
struct SolveSettings {
  double tol = 1e-8;
  std::string time_limit = "60s";
  std::string memory_limit;  ///< empty: none
  std::string hard_limit;    ///< empty: default_hard_limit_s()
  std::string stop = "common";

  void add_to(CLI::App& verb);

  solvers::Stop checked_stop() const;
  std::uint64_t memory_limit_bytes() const;
  std::optional<double> hard_limit_s() const;
};

}  // namespace conebench::harness
