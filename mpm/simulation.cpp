#include "mpm/simulation.h"

#include <algorithm>
#include <chrono>
#include <limits>

#include "mpm/export.h"
#include "mpm/monotone_search.h"
#include "mpm/placement.h"
#include "problems/error.h"
#include "problems/residual.h"

namespace conebench::mpm {
namespace {

constexpr int kMostHalvings = 20;

// Adds the wall clock of its life to a total.
class Stopwatch {
 public:
  explicit Stopwatch(double& total) : total_(total) {}
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;
  ~Stopwatch() {
    total_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  double& total_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// Cells a second, the smallest there can be, along the axis where it is most, for a velocity that
// gravity acts on for `h`.
double cells_a_second(const Scene& scene, const Eigen::Vector3d& v, double h) {
  const Grid grid = scene.grid.finest();
  double most = 0.0;
  for (int a = 0; a < grid.dim; ++a) {
    const double speed = std::abs(v[a]) + h * std::abs(scene.gravity_m_s2[a]);
    most = std::max(most, speed / grid.spacing(a));
  }
  return most;
}

std::vector<bool> may_change(const LawInput& input, const std::vector<NodeState>& states) {
  std::vector<bool> free(states.size());
  for (std::size_t i = 0; i < states.size(); ++i) {
    free[i] = states[i] != NodeState::kDense && input.tip[static_cast<Eigen::Index>(i)] > 0.0;
  }
  return free;
}

}  // namespace

Simulation::Simulation(Scene scene, engine::StepSolver solver)
    : scene_(std::move(scene)), solver_(std::move(solver)), law_(make_law(scene_.material.law)) {
  for (const Body& body : scene_.bodies) bodies_.push_back(make_body(body, scene_.grid.dim));
  particles_ = place_particles(scene_, bodies_);
}

bool Simulation::finished() const { return time_s_ >= scene_.duration_s * (1.0 - 1e-12); }

// The rest of the present step_s, in equal parts that keep the CFL number.
double Simulation::choose_step() const {
  const double period = scene_.step_s;
  const double done = std::floor(time_s_ / period + 1e-9) * period;
  double rest = done + period - time_s_;
  if (std::abs(rest - period) < 1e-9 * period) rest = period;
  double speed = 0.0;
  for (const Eigen::Vector3d& v : particles_.velocity) {
    speed = std::max(speed, cells_a_second(scene_, v, rest));
  }
  for (const RigidBody& body : bodies_) {
    if (body.body.motion == Motion::kStatic) continue;
    speed = std::max(speed, cells_a_second(scene_, body.velocity, rest));
  }
  return rest / std::max(1.0, std::ceil(rest * speed / scene_.cfl));
}

void Simulation::step() {
  double h = choose_step();
  for (int halvings = 0; !try_step(h); ++halvings, h *= 0.5) {
    problems::require(halvings < kMostHalvings, scene_.name, "step ", summary_.steps, " of ", h,
                      " s moves a particle by more than a cell, however short: is step_s or a "
                      "velocity of the scene too large?");
    ++summary_.repeated_steps;
  }
}

Simulation::Solved Simulation::solve(const problems::Problem& base, const LawInput& input,
                                     const std::vector<NodeState>& states,
                                     const Eigen::VectorXd& unshifted_guess) {
  Solved solved;
  solved.states = states;
  {
    const Stopwatch watch(summary_.assembly_s);
    solved.problem.emplace(with_states(base, *law_, input, states));
    solved.standard.emplace(solved.problem->shifted());
    solved.guess = unshifted_guess + solved.problem->tip_shift();
  }
  solved.answer = solver_(*solved.standard, solved.guess);
  engine::check_answer(solved.answer, solved.standard->rows(), scene_.name, summary_.steps);
  ++summary_.solves;
  summary_.iterations += solved.answer.iterations;
  summary_.solve_s += solved.answer.solve_s;
  return solved;
}

Simulation::Solved Simulation::search_states(const problems::Problem& base, const LawInput& input,
                                             const Eigen::VectorXd& unshifted_guess) {
  std::vector<NodeState> start = law_->classify(input);
  recall_states(start);
  MonotoneSearch search(start, may_change(input, start));
  const auto count = static_cast<Eigen::Index>(start.size());
  Eigen::VectorXd r = unshifted_guess;
  Solved best;
  do {
    Solved solved = solve(base, input, search.states(), r);
    r = solved.answer.r - solved.problem->tip_shift();
    const Eigen::VectorXd u = solved.standard->rate(solved.answer.r) - solved.problem->w();
    FrozenSolution facts{Eigen::VectorXd(count), Eigen::VectorXd(count),
                         base.mobility().head(count), 0.0};
    for (int i = 0; i < static_cast<int>(count); ++i) {
      facts.reaction[i] = r[base.start(i)];
      facts.rate[i] = u[base.start(i)];
    }
    facts.tol_rate = 10.0 * problems::evaluate_eta(*solved.standard, solved.answer.r) *
                     solved.standard->rate_scale();
    if (search.take(facts)) best = std::move(solved);
  } while (!search.done());
  summary_.cycles += search.cycled();
  summary_.capped += !search.agreed() && !search.cycled();
  return best;
}

bool Simulation::try_step(double h) {
  StepView view;
  {
    const Stopwatch watch(summary_.transfer_s);
    scatter(scene_, particles_, nodes_);
    cover(scene_, bodies_, time_s_, nodes_);
    recall_stress();
  }
  std::optional<problems::Problem> base;
  Assembly assembly;
  {
    const Stopwatch watch(summary_.assembly_s);
    assembly = assemble(scene_, particles_, nodes_, bodies_, time_s_, h);
    if (!assembly.cones.empty()) base.emplace(make_problem(scene_, summary_.steps, h, assembly));
  }
  Solved solved;
  Eigen::VectorXd v = assembly.free_velocity;
  if (base) {
    solved = scene_.material.law == Law::kMonotone
                 ? search_states(*base, assembly.law, assembly.guess)
                 : solve(*base, assembly.law, law_->classify(assembly.law), assembly.guess);
    v = solved.standard->velocity(solved.answer.r);
  }
  const std::vector<Eigen::Vector3d> velocity = node_velocities(assembly, v);
  if (cells_crossed(nodes_, velocity, particles_, h) > 1.0) return false;
  {
    const Stopwatch watch(summary_.transfer_s);
    last_stress_ = node_stress(solved, h);
    last_index_ = nodes_.index;
    last_states_ = solved.states;
    gather(scene_, nodes_, velocity, last_stress_, h, particles_);
    keep_inside();
  }
  bodies_before_ = bodies_;
  move_bodies(assembly, v, h);

  view.step = summary_.steps++;
  time_s_ += h;
  const double nearest = std::round(time_s_ / scene_.step_s) * scene_.step_s;
  if (std::abs(time_s_ - nearest) < 1e-9 * scene_.step_s) time_s_ = nearest;
  view.time_s = time_s_;
  view.h = h;
  summary_.last_cones = static_cast<std::int64_t>(assembly.cones.size());
  summary_.most_cones = std::max(summary_.most_cones, summary_.last_cones);
  summary_.unconverged_steps += base && !solved.answer.converged;
  view.scene = &scene_;
  view.particles = &particles_;
  view.bodies = &bodies_;
  view.bodies_before = &bodies_before_;
  view.nodes = &nodes_;
  view.velocity = &velocity;
  view.assembly = &assembly;
  view.states = &solved.states;
  if (base) {
    view.problem = &*solved.problem;
    view.standard = &*solved.standard;
    view.guess = &solved.guess;
    view.answer = &solved.answer;
  }
  for (const Observer& observer : observers_) observer(view);
  return true;
}

// Unshifted r / h of each node. A node without friction has a pressure only.
std::vector<Particles::Stress> Simulation::node_stress(const Solved& solved, double h) const {
  std::vector<Particles::Stress> stress(nodes_.index.size(), Particles::Stress::Zero());
  if (!solved.problem) return stress;
  const Eigen::VectorXd r = solved.answer.r - solved.problem->tip_shift();
  for (std::size_t i = 0; i < stress.size(); ++i) {
    const int cone = static_cast<int>(i);
    const int dim = solved.problem->cones()[i].dim;
    stress[i].head(dim) = r.segment(solved.problem->start(cone), dim) / h;
  }
  return stress;
}

// What a node carried in the last step is the better guess: on their way through the particles and
// back, stresses are smoothed.
void Simulation::recall_stress() {
  for (std::size_t k = 0; k < last_index_.size(); ++k) {
    const int slot = nodes_.slot_of[static_cast<std::size_t>(last_index_[k])];
    if (slot >= 0) nodes_.stress[static_cast<std::size_t>(slot)] = last_stress_[k];
  }
}

// The search starts from what the nodes were last, where they are under-dense now as then.
void Simulation::recall_states(std::vector<NodeState>& states) const {
  for (std::size_t k = 0; k < last_states_.size(); ++k) {
    const int slot = nodes_.slot_of[static_cast<std::size_t>(last_index_[k])];
    if (slot < 0 || last_states_[k] == NodeState::kDense) continue;
    NodeState& state = states[static_cast<std::size_t>(slot)];
    if (state != NodeState::kDense) state = last_states_[k];
  }
}

void Simulation::move_bodies(const Assembly& assembly, const Eigen::VectorXd& v, double h) {
  const int dim = scene_.grid.dim;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    RigidBody& body = bodies_[b];
    if (const int first = assembly.body_dof[b]; first >= 0) {
      body.velocity.head(dim) = v.segment(first, dim);
      if (dim == 2) {
        body.angular_velocity.z() = v[first + 2];
      } else {
        body.angular_velocity = v.segment<3>(first + 3);
      }
    }
    if (body.body.motion != Motion::kStatic) advance(body, h);
  }
}

// Particles that crossed a free wall leave; the others are put back on the wall, which rounding and
// the solver's tolerance let them cross by a hair.
void Simulation::keep_inside() {
  const Grid& grid = scene_.grid;
  const Eigen::Vector3d high = grid.low_m + grid.size_m;
  particles_.remove_if([&](std::size_t p) {
    Eigen::Vector3d& x = particles_.position[p];
    for (int a = 0; a < grid.dim; ++a) {
      const bool below = x[a]<grid.low_m[a], above = x[a]> high[a];
      if (!below && !above) continue;
      if (scene_.wall(a, above).condition == Condition::kFree) {
        ++summary_.left_particles;
        summary_.left_volume_m3 += particles_.volume[p];
        return true;
      }
      x[a] = std::clamp(x[a], grid.low_m[a], high[a]);
    }
    return false;
  });
}

State Simulation::state() const {
  State state;
  state.time_s = time_s_;
  const double density = scene_.material.density_kg_m3;
  const Eigen::Vector3d& g = scene_.gravity_m_s2;
  const Eigen::Vector3d up = g.norm() > 0.0 ? Eigen::Vector3d(-g.normalized())
                                            : Eigen::Vector3d::Unit(scene_.grid.dim - 1);
  state.front_m = state.top_m = -std::numeric_limits<double>::infinity();
  double mass = 0.0;
  for (std::size_t p = 0; p < particles_.count(); ++p) {
    const double m = density * particles_.volume[p];
    const Eigen::Vector3d &x = particles_.position[p], &v = particles_.velocity[p];
    state.front_m = std::max(state.front_m, x.x());
    state.top_m = std::max(state.top_m, up.dot(x));
    state.centre_m += m * x;
    state.fastest_m_s = std::max(state.fastest_m_s, v.norm());
    state.kinetic_J += 0.5 * m * v.squaredNorm();
    state.potential_J -= m * g.dot(x);
    state.momentum += m * v;
    mass += m;
  }
  if (mass > 0.0) state.centre_m /= mass;
  for (const RigidBody& body : bodies_) {
    if (!body.moves_freely()) continue;
    state.kinetic_J +=
        0.5 * body.mass * body.velocity.squaredNorm() +
        0.5 * body.angular_velocity.dot(body.inertia_tensor() * body.angular_velocity);
    state.potential_J -= body.mass * g.dot(body.centre_m);
  }
  return state;
}

}  // namespace conebench::mpm
