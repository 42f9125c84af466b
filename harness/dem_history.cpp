#include "harness/dem_history.h"

#include <fmt/format.h>

#include "problems/error.h"

namespace conebench::harness {

DemHistory::DemHistory(std::filesystem::path path, const dem::Summary& so_far)
    : path_(std::move(path)), file_(path_), before_(so_far) {
  write(
      "time_s,cones,bonds,iterations,converged,kinetic_J,potential_J,contact_s,assembly_s,solve_s,"
      "engine_s\n");
}

void DemHistory::add(const dem::Simulation& simulation) {
  const dem::Summary& now = simulation.summary();
  const dem::EnergyLedger& energy = simulation.energy();
  write(fmt::format("{},{},{},{},{},{},{},{},{},{},{}\n", simulation.time_s(), now.last_cones,
                    now.last_bonds, now.iterations - before_.iterations,
                    now.unconverged_steps == before_.unconverged_steps ? 1 : 0, energy.kinetic_J,
                    energy.potential_J, now.contact_s - before_.contact_s,
                    now.assembly_s - before_.assembly_s, now.solve_s - before_.solve_s,
                    now.engine_s - before_.engine_s));
  before_ = now;
}

void DemHistory::write(const std::string& line) {
  file_ << line << std::flush;
  if (!file_) throw problems::OutputError(path_.string(), "cannot be written");
}

}  // namespace conebench::harness
