#pragma once

#include <problems/problem_file.h>

/// Equal blocks that touch each other in a row on the floor, the first of them pushed along the
/// row, harder in every step: they stick, and then slide as one. Two dimensions; blocks do not
/// turn. Velocities (x, y) of block 0, of block 1, ... [m/s].
struct Row {
  int blocks = 8;
  double mass_kg = 2.0;
  double side_m = 0.1;
  double friction = 0.3;         ///< of the floor and between blocks [-]
  double push_per_step_N = 5.0;  ///< step 0 pushes once, step 1 twice, ...
  double gravity_m_s2 = 9.81;
  double step_s = 1e-3;

  Eigen::VectorXd x, y;      ///< centres of the blocks [m]
  Eigen::VectorXd velocity;  ///< 2 x blocks entries [m/s]

  Row();

  /// The contact problem of a step: blocks - 1 contacts between neighbours, then one of each block
  /// with the floor. Component 0 of a contact is normal, component 1 tangential.
  conebench::problems::Problem problem(int step) const;

  /// Where the contacts are, for pictures and for matching one step's answers with the next.
  conebench::problems::Geometry geometry() const;

  /// Takes the velocities of the end of a step and moves the blocks.
  void advance(const Eigen::VectorXd& velocity_at_end);

  /// What the common velocity is after `steps` steps, by Newton's and Coulomb's laws.
  double expected_velocity_m_s(int steps) const;
};
