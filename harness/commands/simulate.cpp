#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "dem/simulation.h"
#include "dem/svg_frame.h"
#include "problems/engine/text_file.h"
#include "dem/vtk_writer.h"
#include "harness/commands/commands.h"
#include "harness/interrupt.h"
#include "harness/step_solver.h"
#include "problems/error.h"

namespace conebench::harness {
namespace {

// ParaView needs a film, not every step.
constexpr std::int64_t kVtkFiles = 100;

struct SimulateOptions {
  std::string scene, folder, solver;
  std::int64_t steps = 0;
  std::int64_t frames = 0;
  bool json = false;
};

// Takes `count` pictures, the first of the start and the last of the end, and draws them in one
// common view once all are there.
class Film {
 public:
  Film(std::int64_t count, std::int64_t steps) : count_(count), steps_(steps) {}

  void look(const dem::Simulation& simulation) {
    const auto taken = static_cast<std::int64_t>(frames_.size());
    if (taken >= count_) return;
    const std::int64_t due = count_ == 1 ? steps_ : taken * steps_ / (count_ - 1);
    if (simulation.summary().steps < due) return;
    frames_.push_back(dem::make_frame(simulation.spheres(), simulation.time_s()));
  }

  void write(const dem::Scene& scene, const std::filesystem::path& folder) const {
    const dem::View view = dem::fit_view(scene, frames_);
    for (std::size_t i = 0; i < frames_.size(); ++i) {
      engine::write_text_file(folder / fmt::format("frame_{:03}.svg", i),
                           dem::draw_svg(scene, frames_[i], view));
    }
  }

 private:
  std::int64_t count_, steps_;
  std::vector<dem::Frame> frames_;
};

// What a collapse is judged by: highest point and mean height along z, and the root mean square
// distance from the vertical through the centre of mass, of the spheres that can move.
nlohmann::json shape_of(const dem::Simulation& simulation) {
  const dem::Spheres& spheres = simulation.spheres();
  double top = -std::numeric_limits<double>::infinity(), squares = 0.0, mass = 0.0;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < spheres.position.size(); ++i) {
    if (spheres.first_dof[i] < 0) continue;
    const Eigen::Vector3d& x = spheres.position[i];
    top = std::max(top, x.z() + spheres.radius[i]);
    centre += spheres.mass[i] * x;
    squares += spheres.mass[i] * x.head<2>().squaredNorm();
    mass += spheres.mass[i];
  }
  centre /= mass;
  const double spread = std::sqrt(std::max(0.0, squares / mass - centre.head<2>().squaredNorm()));
  return {{"top_m", top}, {"mean_height_m", centre.z()}, {"spread_m", spread}};
}

nlohmann::json summarise(const dem::Simulation& simulation, const std::string& solver) {
  const dem::Summary& summary = simulation.summary();
  const dem::EnergyLedger& energy = simulation.energy();
  return {{"scene", simulation.scene().name},
          {"engine", "dem"},
          {"solver", solver},
          {"tol", simulation.scene().solver.tol},
          {"bodies", simulation.spheres().count()},
          {"steps", summary.steps},
          {"time_s", simulation.time_s()},
          {"steps_without_contacts", summary.free_steps},
          {"steps_not_converged", summary.unconverged_steps},
          {"iterations", summary.iterations},
          {"cones_last", summary.last_cones},
          {"cones_most", summary.most_cones},
          {"bonds_last", summary.last_bonds},
          {"deepest_overlap_m", summary.deepest_overlap_m},
          {"solve_s", summary.solve_s},
          {"engine_s", summary.engine_s},
          {"shape", shape_of(simulation)},
          {"energy",
           {{"kinetic_J", energy.kinetic_J},
            {"potential_J", energy.potential_J},
            {"initial_J", energy.initial_J},
            {"bond_J", energy.bond_J},
            {"friction_J", energy.friction_J},
            {"impact_J", energy.impact_J},
            {"scheme_J", energy.scheme_J},
            {"relative_closure", energy.relative_closure()}}}};
}

void print_summary(const nlohmann::json& s) {
  const auto number = [](const nlohmann::json& value) { return value.get<double>(); };
  const auto count = [](const nlohmann::json& value) { return value.get<std::int64_t>(); };
  fmt::print("scene     {} ({} bodies)\n", s["scene"].get<std::string>(), count(s["bodies"]));
  fmt::print("solver    {} to eta {:g}: {} iterations, {} steps did not converge\n",
             s["solver"].get<std::string>(), number(s["tol"]), count(s["iterations"]),
             count(s["steps_not_converged"]));
  fmt::print("steps     {} = {:g} s, {} without contacts\n", count(s["steps"]), number(s["time_s"]),
             count(s["steps_without_contacts"]));
  fmt::print("contacts  {} at the end ({} bonded), {} at most\n", count(s["cones_last"]),
             count(s["bonds_last"]), count(s["cones_most"]));
  fmt::print(
      "shape     top {:.3g} m, mean height {:.3g} m, spread {:.3g} m (rms); deepest overlap "
      "{:.2g} m\n",
      number(s["shape"]["top_m"]), number(s["shape"]["mean_height_m"]),
      number(s["shape"]["spread_m"]), number(s["deepest_overlap_m"]));
  const auto& energy = s["energy"];
  fmt::print(
      "energy    kinetic {:.4g} J, friction {:.4g} J, impact {:.4g} J, bonds {:.4g} J; "
      "ledger closes to {:.1e}\n",
      number(energy["kinetic_J"]), number(energy["friction_J"]), number(energy["impact_J"]),
      number(energy["bond_J"]), number(energy["relative_closure"]));
  fmt::print("time      {:.3g} s in the step solver, {:.3g} s in the engine\n",
             number(s["solve_s"]), number(s["engine_s"]));
}

int simulate(const SimulateOptions& options) {
  problems::require(options.frames == 0 || !options.folder.empty(), "--frames",
                    "needs a folder for its pictures, expected -o DIR");
  const dem::Scene scene = dem::load_scene(options.scene);
  const std::string solver = options.solver.empty() ? scene.solver.name : options.solver;
  const std::int64_t steps = options.steps > 0 ? options.steps : scene.step_count();
  dem::Simulation simulation(scene,
                             make_step_solver(solver, scene.solver.tol, scene.solver.time_limit_s,
                                              scene.solver.max_iterations));
  std::optional<dem::VtkWriter> vtk;
  if (!options.folder.empty()) {
    vtk.emplace(options.folder, scene.step_s, std::max<std::int64_t>(1, steps / kVtkFiles));
    simulation.add_observer(std::ref(*vtk));
  }
  Film film(options.frames, steps);
  film.look(simulation);

  catch_interrupts();
  while (simulation.summary().steps < steps && !interrupted()) {
    simulation.step();
    film.look(simulation);
  }

  const nlohmann::json summary = summarise(simulation, solver);
  if (vtk) {
    vtk->finish();
    engine::write_text_file(std::filesystem::path(options.folder) / "summary.json",
                         summary.dump(2) + "\n");
    film.write(scene, options.folder);
  }
  if (options.json) {
    fmt::print("{}\n", summary.dump());
  } else {
    print_summary(summary);
  }
  return interrupted() ? kInterruptedExit : 0;
}

}  // namespace

void add_simulate(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<SimulateOptions>();
  CLI::App* verb = app.add_subcommand("simulate", "Run a scene through its engine");
  verb->add_option("SCENE", options->scene, "Built-in name or .toml file")->required();
  verb->add_option("-o,--output", options->folder, "Folder for ParaView files and summary.json");
  verb->add_option("-s,--solver", options->solver, "Step solver (default: the scene's)");
  verb->add_option("--steps", options->steps, "Steps to run (default: the scene's duration)")
      ->check(CLI::PositiveNumber);
  verb->add_option("--frames", options->frames, "Also draw N pictures (SVG) in the folder")
      ->check(CLI::PositiveNumber);
  verb->add_flag("--json", options->json, "Print the summary as one JSON object");
  verb->callback([options, &exit_code] { exit_code = simulate(*options); });
}

}  // namespace conebench::harness
