#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "dem/export.h"
#include "dem/simulation.h"
#include "dem/svg_frame.h"
#include "dem/vtk_writer.h"
#include "harness/engine.h"
#include "harness/step_solver.h"
#include "problems/engine/text_file.h"
#include "problems/error.h"

namespace conebench::harness {
namespace {

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

nlohmann::json energy_of(const dem::EnergyLedger& energy) {
  return {{"kinetic_J", energy.kinetic_J},   {"potential_J", energy.potential_J},
          {"initial_J", energy.initial_J},   {"bond_J", energy.bond_J},
          {"friction_J", energy.friction_J}, {"impact_J", energy.impact_J},
          {"scheme_J", energy.scheme_J},     {"relative_closure", energy.relative_closure()}};
}

class DemEngine : public Engine {
 public:
  DemEngine(const dem::Scene& scene, const engine::SolverChoice& solver)
      : solver_(solver), simulation_(scene, make_step_solver(solver)) {}

  const engine::SceneHeader& scene() const override { return simulation_.scene(); }
  void step() override { simulation_.step(); }
  std::int64_t steps() const override { return simulation_.summary().steps; }
  double time_s() const override { return simulation_.time_s(); }
  bool finished() const override { return steps() >= scene().step_count(); }
  std::int64_t unconverged_steps() const override {
    return simulation_.summary().unconverged_steps;
  }

  void write_output(const std::filesystem::path& folder, std::int64_t stride) override {
    vtk_.emplace(folder, scene().step_s, stride);
    simulation_.add_observer(std::ref(*vtk_));
  }
  void finish_output() override { vtk_->finish(); }

  void export_to(const std::filesystem::path& folder, engine::StepSelection selection) override {
    exporter_.emplace(folder, selection);
    simulation_.add_observer(std::ref(*exporter_));
  }
  Exported exported() const override {
    return {exporter_->written(), exporter_->without_contacts()};
  }

  void take_frame() override {
    frames_.push_back(dem::make_frame(simulation_.spheres(), simulation_.time_s()));
  }
  void draw_frames(const std::filesystem::path& folder) const override {
    const dem::View view = dem::fit_view(simulation_.scene(), frames_);
    for (std::size_t i = 0; i < frames_.size(); ++i) {
      engine::write_text_file(folder / frame_name(i),
                              dem::draw_svg(simulation_.scene(), frames_[i], view));
    }
  }

  nlohmann::json summary() const override;
  std::string summary_text() const override;

 private:
  engine::SolverChoice solver_;
  dem::Simulation simulation_;
  std::optional<dem::VtkWriter> vtk_;
  std::optional<dem::Exporter> exporter_;
  std::vector<dem::Frame> frames_;
};

nlohmann::json DemEngine::summary() const {
  const dem::Summary& summary = simulation_.summary();
  return {{"scene", scene().name},
          {"engine", "dem"},
          {"solver", solver_.name},
          {"tol", solver_.tol},
          {"bodies", simulation_.spheres().count()},
          {"steps", summary.steps},
          {"time_s", simulation_.time_s()},
          {"steps_without_contacts", summary.free_steps},
          {"steps_not_converged", summary.unconverged_steps},
          {"iterations", summary.iterations},
          {"cones_last", summary.last_cones},
          {"cones_most", summary.most_cones},
          {"bonds_last", summary.last_bonds},
          {"deepest_overlap_m", summary.deepest_overlap_m},
          {"solve_s", summary.solve_s},
          {"engine_s", summary.engine_s},
          {"shape", shape_of(simulation_)},
          {"energy", energy_of(simulation_.energy())}};
}

std::string DemEngine::summary_text() const {
  const dem::Summary& summary = simulation_.summary();
  const dem::EnergyLedger& energy = simulation_.energy();
  const nlohmann::json shape = shape_of(simulation_);
  std::string out;
  const auto line = [&out](std::string text) { out += std::move(text) + "\n"; };
  line(fmt::format("scene     {} ({} bodies)", scene().name, simulation_.spheres().count()));
  line(fmt::format("solver    {} to eta {:g}: {} iterations, {} steps did not converge",
                   solver_.name, solver_.tol, summary.iterations, summary.unconverged_steps));
  line(fmt::format("steps     {} = {:g} s, {} without contacts", summary.steps, time_s(),
                   summary.free_steps));
  line(fmt::format("contacts  {} at the end ({} bonded), {} at most", summary.last_cones,
                   summary.last_bonds, summary.most_cones));
  line(
      fmt::format("shape     top {:.3g} m, mean height {:.3g} m, spread {:.3g} m (rms); deepest "
                  "overlap {:.2g} m",
                  shape["top_m"].get<double>(), shape["mean_height_m"].get<double>(),
                  shape["spread_m"].get<double>(), summary.deepest_overlap_m));
  line(
      fmt::format("energy    kinetic {:.4g} J, friction {:.4g} J, impact {:.4g} J, bonds {:.4g} J; "
                  "ledger closes to {:.1e}",
                  energy.kinetic_J, energy.friction_J, energy.impact_J, energy.bond_J,
                  energy.relative_closure()));
  line(fmt::format("time      {:.3g} s in the step solver, {:.3g} s in the engine", summary.solve_s,
                   summary.engine_s));
  return out;
}

dem::Scene parse(const engine::SceneText& scene) {
  return dem::parse_scene(scene.text, scene.subject);
}

}  // namespace

EngineKind dem_engine() {
  return {
      .name = "dem",
      .builtin = dem::builtin_scenes(),
      .read = [](const engine::SceneText& scene) -> engine::SceneHeader { return parse(scene); },
      .print = [](const engine::SceneText& scene) { return dem::to_toml(parse(scene)); },
      .make = [](const engine::SceneText& text,
                 const EngineOptions& options) -> std::unique_ptr<Engine> {
        problems::require(options.colour.empty() || options.colour == "speed", "--colour",
                          "found \"", options.colour, "\", expected speed with engine dem");
        const dem::Scene scene = parse(text);
        return std::make_unique<DemEngine>(scene, solver_choice(scene, options));
      }};
}

}  // namespace conebench::harness
