#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "mpm/step.h"

namespace conebench::mpm {

/// Totals of a run so far.
struct Summary {
  std::int64_t steps = 0;              ///< cone problems posed and advanced
  std::int64_t repeated_steps = 0;     ///< done again with half the step: a cell was crossed
  std::int64_t unconverged_steps = 0;  ///< the engine went on with the solver's best answer
  std::int64_t solves = 0;             ///< of all steps; more than steps with law `monotone`
  std::int64_t cycles = 0;             ///< steps whose states came back to ones already tried
  std::int64_t capped = 0;             ///< steps that gave up after MonotoneSearch::kMostSolves
  std::int64_t iterations = 0;         ///< of the step solver
  std::int64_t last_cones = 0, most_cones = 0;
  std::int64_t left_particles = 0;  ///< through free walls
  double left_volume_m3 = 0.0;      ///< of solid, likewise
  double transfer_s = 0.0;          ///< particles to grid and back
  double assembly_s = 0.0;          ///< of the cone problems
  double solve_s = 0.0;             ///< in the step solver
};

/// What a heap is judged by at one moment. Up is against gravity (y or z without gravity).
struct State {
  double time_s = 0.0;
  double front_m = 0.0;                                ///< largest x of a particle
  double top_m = 0.0;                                  ///< greatest height of a particle
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();  ///< of mass
  double fastest_m_s = 0.0;
  double kinetic_J = 0.0;    ///< of the particles' velocities, bodies included
  double potential_J = 0.0;  ///< bodies included
  Eigen::Vector3d momentum = Eigen::Vector3d::Zero();  ///< of the particles [kg m/s]
};

/// Sand as a continuum: material points on a grid (regular, or refined at the heap's boundary),
/// implicit Drucker-Prager stress, one cone problem a step.
///
///   P2G;  v* = v + h g (and implicit viscosity);  M v = f + H^T r, (Hv + w, r) in the cones;
///   G2P;  x += h v(x).
///
/// A step is step_s, or the shorter one that the CFL number asks for: step_s is then divided into
/// equal parts. A step whose answer moves a particle by more than a cell is done again at half.
///
/// Cost    transfers are linear in the particles, assembly in the nodes; the solver dominates.
/// Errors  InputError for an unusable scene; std::runtime_error when the step solver returns
///         numbers that are not finite. A step that does not converge is counted, not an error.
/// Source  Daviet & Bertails-Descoubes, ACM TOG 35(4), 2016. Differs: APIC, cohesion laws.
class Simulation {
 public:
  Simulation(Scene scene, engine::StepSolver solver);

  /// Called after every step, in the order they were added.
  void add_observer(Observer observer) { observers_.push_back(std::move(observer)); }

  void step();
  bool finished() const;  ///< duration_s is reached

  const Scene& scene() const { return scene_; }
  const Particles& particles() const { return particles_; }
  const std::vector<RigidBody>& bodies() const { return bodies_; }
  const Summary& summary() const { return summary_; }
  double time_s() const { return time_s_; }
  State state() const;

  /// Everything that the future depends on, in one file (CBOR, atomically written), and back: a
  /// restarted run goes on bit for bit. restart() throws InputError when the file is not a
  /// checkpoint, or one of another scene.
  void save(const std::filesystem::path& path) const;
  void restart(const std::filesystem::path& path);

 private:
  /// One frozen set of states, solved.
  struct Solved {
    std::vector<NodeState> states;
    std::optional<problems::Problem> problem, standard;
    Eigen::VectorXd guess;
    engine::StepAnswer answer;
  };

  double choose_step() const;
  bool try_step(double h);
  Solved solve(const problems::Problem& base, const LawInput& input,
               const std::vector<NodeState>& states, const Eigen::VectorXd& unshifted_guess);
  Solved search_states(const problems::Problem& base, const LawInput& input,
                       const Eigen::VectorXd& unshifted_guess);
  std::vector<Particles::Stress> node_stress(const Solved& solved, double h) const;
  void move_bodies(const Assembly& assembly, const Eigen::VectorXd& v, double h);
  void keep_inside();
  void recall_stress();
  void recall_states(std::vector<NodeState>& states) const;

  Scene scene_;
  engine::StepSolver solver_;
  std::unique_ptr<CohesionLaw> law_;
  Particles particles_;
  std::vector<RigidBody> bodies_, bodies_before_;
  Nodes nodes_;
  // Where the next step starts: nodes of the grid in the last step, their stress and state.
  std::vector<int> last_index_;
  std::vector<Particles::Stress> last_stress_;
  std::vector<NodeState> last_states_;
  double time_s_ = 0.0;
  Summary summary_;
  std::vector<Observer> observers_;
};

}  // namespace conebench::mpm
