#include <fmt/format.h>

#include <cmath>

#include "results/report.h"

namespace conebench::results {
namespace {

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c;
  }
  return out + "\"";
}

std::string number(double value) {
  return std::isfinite(value) ? fmt::format("{}", value) : std::string();
}

// Nothing where only the time to a tighter tolerance is known.
std::string time_to(const Record& record, double tol) {
  const bool known = tol <= record.settings.tol || !record.curve.empty();
  return known ? number(time_to_tolerance(record, tol)) : std::string();
}

std::string joined(const std::vector<std::string>& notes) {
  return fmt::format("{}", fmt::join(notes, "; "));
}

}  // namespace

std::string csv_report(std::span<const Record> records) {
  std::string csv =
      "problem,content_sha256,path,family,cones,solver,solver_build,kind,tol,time_limit_s,"
      "memory_limit_bytes,stop,mode,threads,timing,repetition,sequence,sequence_index,donor,status,"
      "claimed,"
      "eta,fclib_residual,siconos_residual,attainable_eta,guess_eta,model_eta,iterations,time_to_"
      "1e-4_s,"
      "time_to_1e-6_s,time_to_tol_s,setup_s,solve_s,timed_solves,time_spread,solver_cpu_s,"
      "allocations,solver_memory_bytes,wall_s,cpu_s,peak_memory_bytes,started_at,notes,error\n";
  for (const Record& r : records) {
    const Settings& s = r.settings;
    csv += fmt::format("{},{},{},{},{},{},{},{},", quoted(r.problem.name), r.problem.content_sha256,
                       quoted(r.problem.path), quoted(r.problem.family), r.problem.cones,
                       quoted(r.solver), r.solver_build, r.kind);
    csv += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},", s.tol, number(s.time_limit_s),
                       s.memory_limit_bytes, s.stop, s.mode, s.threads, s.timing, r.repetition,
                       quoted(r.sequence.name), r.sequence.index, quoted(r.donor),
                       to_string(r.status), r.claimed);
    csv += fmt::format("{},{},{},{},{},{},{},{},{},{},", number(r.eta), number(r.fclib_residual),
                       number(r.siconos_residual), number(r.attainable_eta), number(r.guess_eta),
                       number(r.model_eta), r.iterations, time_to(r, 1e-4), time_to(r, 1e-6),
                       time_to(r, s.tol));
    csv += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{}\n", r.setup_s, r.solve_s,
                       r.timed_solves, number(r.time_spread), r.solver_cpu_s, r.allocations,
                       r.solver_memory_bytes, r.wall_s, r.cpu_s, r.peak_memory_bytes, r.started_at,
                       quoted(joined(r.notes)), quoted(r.error));
  }
  return csv;
}

}  // namespace conebench::results
