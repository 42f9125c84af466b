#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "harness/engine.h"
#include "harness/mpm_history.h"
#include "harness/step_solver.h"
#include "mpm/export.h"
#include "mpm/heap.h"
#include "mpm/simulation.h"
#include "mpm/svg_frame.h"
#include "mpm/vtk_writer.h"
#include "problems/engine/text_file.h"
#include "problems/error.h"

namespace conebench::harness {
namespace {

mpm::ColourBy parse_colour(const std::string& word) {
  if (word.empty() || word == "fraction") return mpm::ColourBy::kFraction;
  problems::require(word == "speed", "--colour", "found \"", word,
                    "\", expected fraction or speed");
  return mpm::ColourBy::kSpeed;
}

class MpmEngine : public Engine {
 public:
  MpmEngine(const mpm::Scene& scene, const engine::SolverChoice& solver, mpm::ColourBy colour)
      : solver_(solver), colour_(colour), simulation_(scene, make_step_solver(solver)) {
    simulation_.add_observer([this](const mpm::StepView& view) { watch_density(view); });
  }

  const engine::SceneHeader& scene() const override { return simulation_.scene(); }
  void step() override { simulation_.step(); }
  std::int64_t steps() const override { return simulation_.summary().steps; }
  double time_s() const override { return simulation_.time_s(); }
  bool finished() const override { return simulation_.finished(); }
  std::int64_t unconverged_steps() const override {
    return simulation_.summary().unconverged_steps;
  }

  Snapshot snapshot() const override;
  void observe(std::function<void(const engine::SolvedStep&)> look) override {
    simulation_.add_observer([look = std::move(look)](const mpm::StepView& view) { look(view); });
  }

  void write_output(const std::filesystem::path& folder, std::int64_t stride) override {
    vtk_.emplace(folder, stride);
    simulation_.add_observer(std::ref(*vtk_));
    history_.emplace(folder / "history.csv", simulation_.summary());
    simulation_.add_observer(
        [this](const mpm::StepView& view) { history_->add(simulation_, view.h); });
  }
  void finish_output() override { vtk_->finish(); }

  void export_to(const std::filesystem::path& folder,
                 const engine::StepSelection& selection) override {
    exporter_.emplace(folder, selection, scene());
    simulation_.add_observer(std::ref(*exporter_));
  }
  Exported finish_export() override {
    exporter_->finish();
    return {exporter_->files(), exporter_->without_cones(), exporter_->cost()};
  }

  void take_frame() override { frames_.push_back(mpm::make_frame(simulation_)); }
  void draw_frames(const std::filesystem::path& folder) const override {
    const mpm::View view = mpm::fit_view(simulation_.scene(), frames_, colour_);
    for (std::size_t i = 0; i < frames_.size(); ++i) {
      engine::write_text_file(folder / frame_name(i),
                              mpm::draw_svg(simulation_.scene(), frames_[i], view));
    }
  }

  nlohmann::json summary() const override;
  std::string summary_text() const override;

  void save(const std::filesystem::path& path) const override { simulation_.save(path); }
  void restart(const std::filesystem::path& path) override { simulation_.restart(path); }

 private:
  // Nodes of the first step are as full as the scene made them.
  void watch_density(const mpm::StepView& view) {
    const double share = mpm::overfull_share(*view.scene, *view.nodes);
    if (!first_overfull_) first_overfull_ = std::max(share, 0.0);
    most_overfull_ = std::max(most_overfull_, share);
  }

  engine::SolverChoice solver_;
  mpm::ColourBy colour_;
  mpm::Simulation simulation_;
  std::optional<double> first_overfull_;
  double most_overfull_ = 0.0;
  std::optional<mpm::VtkWriter> vtk_;
  std::optional<MpmHistory> history_;
  std::optional<mpm::Exporter> exporter_;
  std::vector<mpm::Frame> frames_;
};

Snapshot MpmEngine::snapshot() const {
  const mpm::Summary& summary = simulation_.summary();
  const mpm::State state = simulation_.state();
  return {.heap = mpm::heap_of(simulation_),
          .energy_J = state.kinetic_J + state.potential_J,
          .penetration = most_overfull_ - first_overfull_.value_or(0.0),
          .iterations = summary.iterations,
          .solve_s = summary.solve_s};
}

nlohmann::json MpmEngine::summary() const {
  const mpm::Summary& summary = simulation_.summary();
  const mpm::State state = simulation_.state();
  return {{"scene", scene().name},
          {"engine", "mpm"},
          {"solver", solver_.name},
          {"tol", solver_.tol},
          {"particles", simulation_.particles().count()},
          {"steps", summary.steps},
          {"repeated_steps", summary.repeated_steps},
          {"time_s", simulation_.time_s()},
          {"steps_not_converged", summary.unconverged_steps},
          {"solves", summary.solves},
          {"cycles", summary.cycles},
          {"capped", summary.capped},
          {"iterations", summary.iterations},
          {"cones_last", summary.last_cones},
          {"cones_most", summary.most_cones},
          {"left_particles", summary.left_particles},
          {"transfer_s", summary.transfer_s},
          {"assembly_s", summary.assembly_s},
          {"solve_s", summary.solve_s},
          {"state",
           {{"front_m", state.front_m},
            {"top_m", state.top_m},
            {"centre_m", {state.centre_m[0], state.centre_m[1], state.centre_m[2]}},
            {"fastest_m_s", state.fastest_m_s},
            {"kinetic_J", state.kinetic_J},
            {"potential_J", state.potential_J}}}};
}

std::string MpmEngine::summary_text() const {
  const mpm::Summary& summary = simulation_.summary();
  const mpm::State state = simulation_.state();
  std::string out;
  const auto line = [&out](std::string text) { out += std::move(text) + "\n"; };
  line(fmt::format("scene     {} ({} particles, {} left)", scene().name,
                   simulation_.particles().count(), summary.left_particles));
  line(fmt::format("solver    {} to eta {:g}: {} iterations, {} steps did not converge",
                   solver_.name, solver_.tol, summary.iterations, summary.unconverged_steps));
  line(fmt::format("steps     {} = {:g} s, {} repeated", summary.steps, time_s(),
                   summary.repeated_steps));
  line(fmt::format("cones     {} at the end, {} at most", summary.last_cones, summary.most_cones));
  line(fmt::format("law       {} solves; {} steps came back to states already tried, {} gave up",
                   summary.solves, summary.cycles, summary.capped));
  line(fmt::format("shape     front {:.3g} m, top {:.3g} m, centre ({:.3g}, {:.3g}, {:.3g}) m",
                   state.front_m, state.top_m, state.centre_m[0], state.centre_m[1],
                   state.centre_m[2]));
  line(fmt::format("energy    kinetic {:.4g} J, potential {:.4g} J; fastest {:.3g} m/s",
                   state.kinetic_J, state.potential_J, state.fastest_m_s));
  line(
      fmt::format("time      {:.3g} s in the step solver, {:.3g} s in transfers, {:.3g} s in "
                  "assembly",
                  summary.solve_s, summary.transfer_s, summary.assembly_s));
  return out;
}

mpm::Scene parse(const engine::SceneText& scene) {
  return mpm::parse_scene(scene.text, scene.subject);
}

}  // namespace

EngineKind mpm_engine() {
  return {
      .name = "mpm",
      .builtin = mpm::builtin_scenes(),
      .read = [](const engine::SceneText& scene) -> engine::SceneHeader { return parse(scene); },
      .print = [](const engine::SceneText& scene) { return mpm::to_toml(parse(scene)); },
      .make = [](const engine::SceneText& text,
                 const EngineOptions& options) -> std::unique_ptr<Engine> {
        const mpm::Scene scene = parse(text);
        return std::make_unique<MpmEngine>(scene, solver_choice(scene, options),
                                           parse_colour(options.colour));
      }};
}

}  // namespace conebench::harness
