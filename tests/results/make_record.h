#pragma once

#include <string>

#include "results/record.h"

namespace conebench::results {

/// A record as a solver that reached `eta` in `solve_s` leaves it, without a curve.
inline Record make_record(const std::string& problem, const std::string& solver, double eta,
                          double solve_s) {
  Record record;
  record.problem = {.name = problem,
                    .content_sha256 = "sha-of-" + problem,
                    .path = "/data/" + problem + ".h5",
                    .family = "dem/test",
                    .cones = 7};
  record.solver = solver;
  record.settings = {
      .tol = 1e-8, .time_limit_s = 10.0, .memory_limit_bytes = 1 << 20, .stop = "common"};
  record.status = eta <= 1e-8 ? Status::kConverged : Status::kStalled;
  record.claimed = to_string(record.status);
  record.eta = eta;
  record.solve_s = solve_s;
  record.started_at = "2024-05-01T12:00:00Z";
  record.host = {.cpu = "a processor", .cores = 2, .compiler = "gcc", .build = "", .version = "1"};
  return record;
}

}  // namespace conebench::results
