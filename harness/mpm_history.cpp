#include "harness/mpm_history.h"

#include <fmt/format.h>

#include "problems/error.h"

namespace conebench::harness {

MpmHistory::MpmHistory(std::filesystem::path path, const mpm::Summary& so_far)
    : path_(std::move(path)), file_(path_), solves_(so_far.solves), iterations_(so_far.iterations) {
  write(
      "time_s,h,front_m,top_m,centre_x_m,centre_y_m,centre_z_m,fastest_m_s,kinetic_J,potential_J,"
      "cones,solves,iterations\n");
}

void MpmHistory::add(const mpm::Simulation& simulation, double h) {
  const mpm::State s = simulation.state();
  const mpm::Summary& summary = simulation.summary();
  write(fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{}\n", s.time_s, h, s.front_m, s.top_m,
                    s.centre_m[0], s.centre_m[1], s.centre_m[2], s.fastest_m_s, s.kinetic_J,
                    s.potential_J, summary.last_cones, summary.solves - solves_,
                    summary.iterations - iterations_));
  solves_ = summary.solves;
  iterations_ = summary.iterations;
}

void MpmHistory::write(const std::string& line) {
  file_ << line << std::flush;
  if (!file_) throw problems::OutputError(path_.string(), "cannot be written");
}

}  // namespace conebench::harness
