#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "dem/export.h"
#include "dem/heap.h"
#include "dem/simulation.h"
#include "dem/svg_frame.h"
#include "dem/vtk_writer.h"
#include "harness/dem_history.h"
#include "harness/engine.h"
#include "harness/step_solver.h"
#include "problems/engine/text_file.h"
#include "problems/error.h"

namespace conebench::harness {
namespace {

double top_of(const dem::Placement& placement, int body) {
  const dem::Bodies& bodies = placement.bodies;
  const auto b = static_cast<std::size_t>(body);
  if (bodies.is_ball(body)) return bodies.position[b].z() + bodies.radius[b];
  double top = -std::numeric_limits<double>::infinity();
  for (const dem::Part& part : placement.solids[static_cast<std::size_t>(bodies.solid[b])].parts) {
    top = std::max(top, dem::bounds_of(part.piece, bodies.pose(body) * part.pose).high.z());
  }
  return top;
}

// What a collapse is judged by: highest point and mean height along z, and the root mean square
// distance from the vertical through the centre of mass, of the bodies that can move.
nlohmann::json shape_of(const dem::Simulation& simulation) {
  const dem::Bodies& bodies = simulation.bodies();
  double top = -std::numeric_limits<double>::infinity(), squares = 0.0, mass = 0.0;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (int i = 0; i < bodies.count(); ++i) {
    if (!bodies.is_free(i)) continue;
    const auto b = static_cast<std::size_t>(i);
    const Eigen::Vector3d& x = bodies.position[b];
    top = std::max(top, top_of(simulation.placement(), i));
    centre += bodies.mass[b] * x;
    squares += bodies.mass[b] * x.head<2>().squaredNorm();
    mass += bodies.mass[b];
  }
  centre /= mass;
  const double spread = std::sqrt(std::max(0.0, squares / mass - centre.head<2>().squaredNorm()));
  return {{"top_m", top}, {"mean_height_m", centre.z()}, {"spread_m", spread}};
}

nlohmann::json energy_of(const dem::EnergyLedger& energy) {
  return {{"kinetic_J", energy.kinetic_J},   {"potential_J", energy.potential_J},
          {"initial_J", energy.initial_J},   {"bond_J", energy.bond_J},
          {"friction_J", energy.friction_J}, {"impact_J", energy.impact_J},
          {"driven_J", energy.driven_J},     {"gyro_J", energy.gyro_J},
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

  Snapshot snapshot() const override;
  void observe(std::function<void(const engine::SolvedStep&)> look) override {
    simulation_.add_observer([look = std::move(look)](const dem::StepView& view) { look(view); });
  }

  void write_output(const std::filesystem::path& folder, std::int64_t stride) override {
    vtk_.emplace(folder, scene().step_s, simulation_.placement(), stride);
    simulation_.add_observer(std::ref(*vtk_));
    history_.emplace(folder / "history.csv", simulation_.summary());
    simulation_.add_observer([this](const dem::StepView&) { history_->add(simulation_); });
  }
  void finish_output() override { vtk_->finish(); }

  void export_to(const std::filesystem::path& folder,
                 const engine::StepSelection& selection) override {
    exporter_.emplace(folder, selection, scene());
    simulation_.add_observer(std::ref(*exporter_));
  }
  Exported finish_export() override {
    exporter_->finish();
    return {exporter_->files(), exporter_->without_contacts(), exporter_->cost()};
  }

  void save(const std::filesystem::path& path) const override { simulation_.save(path); }
  void restart(const std::filesystem::path& path) override { simulation_.restart(path); }

  void take_frame() override { frames_.push_back({simulation_.time_s(), simulation_.bodies()}); }
  void draw_frames(const std::filesystem::path& folder) const override {
    if (frames_.empty()) return;
    const dem::Placement& placement = simulation_.placement();
    const dem::View view = dem::fit_view(simulation_.scene(), placement.solids, frames_);
    for (std::size_t i = 0; i < frames_.size(); ++i) {
      engine::write_text_file(folder / frame_name(i),
                              dem::draw_svg(simulation_.scene(), placement, frames_[i], view));
    }
  }

  nlohmann::json summary() const override;
  std::string summary_text() const override;

 private:
  engine::SolverChoice solver_;
  dem::Simulation simulation_;
  std::optional<dem::VtkWriter> vtk_;
  std::optional<DemHistory> history_;
  std::optional<dem::Exporter> exporter_;
  std::vector<dem::Frame> frames_;
};

Snapshot DemEngine::snapshot() const {
  const dem::Summary& summary = simulation_.summary();
  const dem::EnergyLedger& energy = simulation_.energy();
  Snapshot out{.heap = dem::heap_of(simulation_),
               .energy_J = energy.kinetic_J + energy.potential_J,
               .iterations = summary.iterations,
               .solve_s = summary.solve_s};
  double radii = 0.0;
  for (const engine::Grain& grain : out.heap.grains) radii += grain.radius;
  out.penetration = summary.deepest_overlap_m * static_cast<double>(out.heap.grains.size()) / radii;
  return out;
}

nlohmann::json DemEngine::summary() const {
  const dem::Summary& summary = simulation_.summary();
  return {{"scene", scene().name},
          {"engine", "dem"},
          {"solver", solver_.name},
          {"tol", solver_.tol},
          {"bodies", simulation_.bodies().count()},
          {"steps", summary.steps},
          {"time_s", simulation_.time_s()},
          {"steps_without_contacts", summary.free_steps},
          {"steps_not_converged", summary.unconverged_steps},
          {"iterations", summary.iterations},
          {"cones_last", summary.last_cones},
          {"cones_most", summary.most_cones},
          {"bonds_last", summary.last_bonds},
          {"deepest_overlap_m", summary.deepest_overlap_m},
          {"contact_s", summary.contact_s},
          {"assembly_s", summary.assembly_s},
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
  line(fmt::format("scene     {} ({} bodies)", scene().name, simulation_.bodies().count()));
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
  line(fmt::format(
      "time      {:.3g} s in the step solver, {:.3g} s in the engine (contacts {:.3g} s, "
      "assembly {:.3g} s)",
      summary.solve_s, summary.engine_s, summary.contact_s, summary.assembly_s));
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
