#include "dem/simulation.h"

#include <algorithm>
#include <chrono>

#include "dem/export.h"
#include "dem/overlaps.h"
#include "problems/engine/island_solver.h"

namespace conebench::dem {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

void rotate(Eigen::Quaterniond& orientation, const Eigen::Vector3d& angle) {
  const double size = angle.norm();
  if (size == 0.0) return;
  orientation = Eigen::Quaterniond(Eigen::AngleAxisd(size, angle / size)) * orientation;
  orientation.normalize();
}

}  // namespace

Simulation::Simulation(Scene scene, engine::StepSolver solver)
    : scene_(std::move(scene)),
      solver_(engine::by_islands(std::move(solver))),
      placement_(place_bodies(scene_, scene_.name)),
      contacts_(scene_, placement_) {
  energy_.kinetic_J = kinetic_energy(bodies());
  energy_.potential_J = potential_energy(scene_, bodies());
  energy_.initial_J = energy_.kinetic_J + energy_.potential_J;
}

void Simulation::run(std::int64_t count) {
  while (summary_.steps < count) step();
}

void Simulation::step() {
  const auto start = Clock::now();
  drive(scene_, placement_, time_s(), bodies_now());
  before_ = bodies();
  contacts_.update(before_, time_s());
  refuse_sunk(scene_, summary_.steps, contacts_.contacts(), placement_);
  const auto listed = Clock::now();
  summary_.contact_s += std::chrono::duration<double>(listed - start).count();
  assembly_ = assemble(scene_, before_, contacts_);

  StepView view;
  view.step = summary_.steps;
  view.dimension = scene_.dimension;
  view.bodies = &bodies();
  view.before = &before_;
  view.contacts = &contacts_;
  view.entered = assembly_.entered;

  std::optional<problems::Problem> problem, standard;
  engine::StepAnswer answer;
  double solve_s = 0.0;
  if (assembly_.cones.empty()) {
    fly();
  } else {
    problem.emplace(make_problem(scene_, view.step, assembly_));
    standard.emplace(problem->shifted());
    summary_.assembly_s += seconds_since(listed);
    const auto assembled = Clock::now();
    answer = solver_(*standard, assembly_.guess);
    solve_s = seconds_since(assembled);
    engine::check_answer(answer, standard->rows(), scene_.name, view.step);
    scatter_velocity(scene_.dimension, standard->velocity(answer.r), bodies_now());
    apply(*problem, answer);
    view.problem = &*problem;
    view.standard = &*standard;
    view.guess = &assembly_.guess;
    view.answer = &answer;
  }
  move();
  book_step(answer);
  view.time_s = time_s();
  summary_.solve_s += solve_s;
  summary_.engine_s += seconds_since(start) - solve_s;
  for (const Observer& observer : observers_) observer(view);
}

// Nothing touches: M v = f.
void Simulation::fly() {
  ++summary_.free_steps;
  for (Contact& contact : contacts_.contacts()) contact.reaction.setZero();
  const problems::Inertia inertia(assembly_.data.M, scene_.name);
  scatter_velocity(scene_.dimension, inertia.solve(assembly_.data.f), bodies_now());
}

// Gives the contacts their reactions, and books their work.
void Simulation::apply(const problems::Problem& problem, const engine::StepAnswer& answer) {
  for (Contact& contact : contacts_.contacts()) contact.reaction.setZero();
  const auto cones = problem.cones();
  for (std::size_t i = 0; i < cones.size(); ++i) {
    Contact& contact = contacts_.contacts()[static_cast<std::size_t>(assembly_.entered[i])];
    const Eigen::Matrix3d frame = frame_of(contact, scene_.dimension);
    Eigen::Vector3d r = Eigen::Vector3d::Zero();
    const int start = problem.start(static_cast<int>(i));
    for (int k = 0; k < cones[i].dim; ++k) r[k] = answer.r[start + k];
    r[0] -= cones[i].kappa;
    contact.reaction = frame * r;
    if (r[0] > 0.0) contacts_.touch(contact, time_s());
    const auto local = [&](const Eigen::Vector3d& u) {
      return Eigen::Vector3d(frame.transpose() * u);
    };
    book_work(r, cones[i].kappa, local(relative_velocity(before_, contact)),
              local(relative_velocity(bodies(), contact)), local(driven_velocity(before_, contact)),
              energy_);
  }
}

void Simulation::move() {
  const double h = scene_.step_s;
  Bodies& bodies = bodies_now();
  for (std::size_t i = 0; i < bodies.position.size(); ++i) {
    bodies.position[i] += h * bodies.velocity[i];
    rotate(bodies.orientation[i], h * bodies.angular_velocity[i]);
  }
  book_scheme(scene_, before_, bodies, energy_);
}

void Simulation::book_step(const engine::StepAnswer& answer) {
  energy_.kinetic_J = kinetic_energy(bodies());
  energy_.potential_J = potential_energy(scene_, bodies());
  ++summary_.steps;
  summary_.iterations += answer.iterations;
  summary_.last_cones = static_cast<std::int64_t>(assembly_.entered.size());
  summary_.most_cones = std::max(summary_.most_cones, summary_.last_cones);
  if (!assembly_.entered.empty() && !answer.converged) ++summary_.unconverged_steps;
  summary_.last_bonds = 0;
  for (const Contact& contact : contacts_.contacts()) {
    summary_.last_bonds += contact.bonded;
    summary_.deepest_overlap_m = std::max(summary_.deepest_overlap_m, -contact.gap);
  }
}

}  // namespace conebench::dem
