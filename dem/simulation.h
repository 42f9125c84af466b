#pragma once

#include <filesystem>

#include "dem/assembly.h"
#include "dem/energy.h"
#include "dem/step.h"

namespace conebench::dem {

/// Totals of a run so far.
struct Summary {
  std::int64_t steps = 0;
  std::int64_t free_steps = 0;         ///< without a contact that entered
  std::int64_t unconverged_steps = 0;  ///< the engine went on with the solver's best answer
  std::int64_t iterations = 0;         ///< of the step solver
  std::int64_t most_cones = 0;         ///< of one step's problem
  std::int64_t last_cones = 0;
  std::int64_t last_bonds = 0;
  double deepest_overlap_m = 0.0;  ///< of all steps
  double contact_s = 0.0;          ///< wall clock: broad and narrow phase
  double assembly_s = 0.0;         ///< wall clock: the problem made
  double solve_s = 0.0;            ///< wall clock: waiting for the step solver, islands included
  double engine_s = 0.0;           ///< wall clock without solve_s and the observers
};

/// Rigid bodies between walls, with Coulomb friction, restitution and cohesion: non-smooth contact
/// dynamics, time-stepping of Moreau and Jean with one cone problem a step (assembly.h), solved
/// island by island.
///
///   contacts listed at x;  M v = f + H^T r  with (u, r) in the cones;
///   x += h v;  rotation by exp(h omega).
///
/// Cost    broad phase and assembly are linear in spheres and contacts; the step solver dominates.
/// Errors  InputError for an unusable scene, and when one thing sinks into another (overlaps.h);
///         std::runtime_error when the step solver returns numbers that are not finite. A step that
///         does not converge is counted, not an error.
/// Source  Jean, CMAME 177 (1999) 235-257 (not checked). Differs: positions move with the new
///         velocity alone, without a midpoint configuration.
class Simulation {
 public:
  Simulation(Scene scene, engine::StepSolver solver);

  /// Called after every step, in the order they were added.
  void add_observer(Observer observer) { observers_.push_back(std::move(observer)); }

  void step();
  /// Steps until `count` steps have been done in all.
  void run(std::int64_t count);

  const Scene& scene() const { return scene_; }
  const Bodies& bodies() const { return placement_.bodies; }
  const Placement& placement() const { return placement_; }
  const ContactList& contacts() const { return contacts_; }
  const EnergyLedger& energy() const { return energy_; }
  const Summary& summary() const { return summary_; }
  /// Writes the state to a file, atomically; restart() goes on from there bit for bit.
  /// Errors: OutputError; InputError naming the file when it is not of this scene as it stands.
  void save(const std::filesystem::path& path) const;
  void restart(const std::filesystem::path& path);

  double time_s() const { return static_cast<double>(summary_.steps) * scene_.step_s; }

 private:
  Bodies& bodies_now() { return placement_.bodies; }
  void fly();
  void apply(const problems::Problem& problem, const engine::StepAnswer& answer);
  void move();
  void book_step(const engine::StepAnswer& answer);

  Scene scene_;
  engine::StepSolver solver_;
  Placement placement_;  // its bodies are the present ones
  Bodies before_;
  ContactList contacts_;
  Assembly assembly_;
  EnergyLedger energy_;
  Summary summary_;
  std::vector<Observer> observers_;
};

}  // namespace conebench::dem
