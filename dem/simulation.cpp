#include "dem/simulation.h"

#include <algorithm>
#include <chrono>

#include "dem/export.h"
#include "dem/placement.h"

namespace conebench::dem {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

Eigen::Vector3d local_rate(const Spheres& spheres, const Contact& contact) {
  return contact.frame.transpose() * relative_velocity(spheres, contact);
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
      solver_(std::move(solver)),
      spheres_(place_spheres(scene_, scene_.name)),
      contacts_(scene_) {
  energy_.kinetic_J = kinetic_energy(spheres_);
  energy_.potential_J = potential_energy(scene_, spheres_);
  energy_.initial_J = energy_.kinetic_J + energy_.potential_J;
}

void Simulation::run(std::int64_t count) {
  while (summary_.steps < count) step();
}

void Simulation::step() {
  const auto start = Clock::now();
  before_ = spheres_;
  contacts_.update(scene_, spheres_, time_s());
  assembly_ = assemble(scene_, spheres_, contacts_);

  StepView view;
  view.step = summary_.steps;
  view.spheres = &spheres_;
  view.before = &before_;
  view.contacts = &contacts_;
  view.entered = assembly_.entered;

  std::optional<problems::Problem> problem, standard;
  engine::StepAnswer answer;
  double outside_s = 0.0;
  if (assembly_.cones.empty()) {
    ++summary_.free_steps;
    for (Contact& contact : contacts_.contacts()) contact.reaction.setZero();
    accelerate();
  } else {
    problem.emplace(make_problem(scene_, view.step, assembly_));
    standard.emplace(problem->shifted());
    const auto solver_start = Clock::now();
    answer = solver_(*standard, assembly_.guess);
    outside_s = seconds_since(solver_start);
    engine::check_answer(answer, standard->rows(), scene_.name, view.step);
    accelerate();
    apply_reactions(*problem, answer.r);
    view.problem = &*problem;
    view.standard = &*standard;
    view.guess = &assembly_.guess;
    view.answer = &answer;
  }
  move();
  book_step(answer);
  view.time_s = time_s();
  summary_.solve_s += answer.solve_s;
  summary_.engine_s += seconds_since(start) - outside_s;
  for (const Observer& observer : observers_) observer(view);
}

void Simulation::accelerate() {
  const Eigen::Vector3d change = scene_.step_s * scene_.gravity_m_s2;
  for (std::size_t i = 0; i < spheres_.velocity.size(); ++i) {
    if (spheres_.first_dof[i] >= 0) spheres_.velocity[i] += change;
  }
}

// v += M^-1 H^T r for one contact; `r` is its reaction in the local frame. It acts on `body` and
// its opposite on `other`.
void Simulation::push(const Contact& contact, const Eigen::Vector3d& r) {
  // n x reaction, with n x t1 = t2 and n x t2 = -t1.
  const Eigen::Vector3d turn = r[1] * contact.frame.col(2) - r[2] * contact.frame.col(1);
  const auto apply = [&](int body, double sign) {
    const auto i = static_cast<std::size_t>(body);
    if (spheres_.first_dof[i] < 0) return;
    spheres_.velocity[i] += sign / spheres_.mass[i] * contact.reaction;
    spheres_.angular_velocity[i] -= spheres_.radius[i] / spheres_.inertia[i] * turn;
  };
  apply(contact.body, 1.0);
  if (!contact.with_plane()) apply(contact.other, -1.0);
}

void Simulation::apply_reactions(const problems::Problem& problem,
                                 const Eigen::VectorXd& shifted_r) {
  auto& contacts = contacts_.contacts();
  for (Contact& contact : contacts) contact.reaction.setZero();
  const auto cones = problem.cones();
  const auto contact_of = [&](std::size_t cone) -> Contact& {
    return contacts[static_cast<std::size_t>(assembly_.entered[cone])];
  };
  local_reactions_.resize(cones.size());
  for (std::size_t i = 0; i < cones.size(); ++i) {
    Contact& contact = contact_of(i);
    Eigen::Vector3d r = Eigen::Vector3d::Zero();
    const int start = problem.start(static_cast<int>(i));
    for (int k = 0; k < cones[i].dim; ++k) r[k] = shifted_r[start + k];
    r[0] -= cones[i].kappa;
    local_reactions_[i] = r;
    contact.reaction = contact.frame * r;
    push(contact, r);
    if (r[0] > 0.0 && contacts_.law_of(contact).tensile_force_N > 0.0) contact.bonded = true;
  }
  for (std::size_t i = 0; i < cones.size(); ++i) {
    book_work(local_reactions_[i], cones[i].kappa, local_rate(before_, contact_of(i)),
              local_rate(spheres_, contact_of(i)), energy_);
  }
}

void Simulation::move() {
  const double h = scene_.step_s;
  for (std::size_t i = 0; i < spheres_.position.size(); ++i) {
    if (spheres_.first_dof[i] < 0) continue;
    spheres_.position[i] += h * spheres_.velocity[i];
    rotate(spheres_.orientation[i], h * spheres_.angular_velocity[i]);
    energy_.scheme_J -= 0.5 * h * spheres_.mass[i] *
                        scene_.gravity_m_s2.dot(spheres_.velocity[i] - before_.velocity[i]);
  }
}

void Simulation::book_step(const engine::StepAnswer& answer) {
  energy_.kinetic_J = kinetic_energy(spheres_);
  energy_.potential_J = potential_energy(scene_, spheres_);
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
