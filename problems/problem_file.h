#pragma once

#include <filesystem>
#include <optional>

#include "problems/problem.h"

namespace conebench::problems {

/// What a node of a continuum does in its step, as files write it.
enum class NodeState : int {
  kLoose = 0,   ///< below the largest density: dry, and free to compress until it is reached
  kBonded = 1,  ///< below the largest density, but cohesive as if it were dense
  kDense = 2,   ///< at the largest density
};

/// Where the cones are in space: what a 3D view needs. Every table has one row a cone, or a body.
struct Geometry {
  using Table = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  using Pairs = Eigen::Matrix<int, Eigen::Dynamic, 2, Eigen::RowMajor>;

  Table points;                     ///< cones x 3 [m]
  Table frames;                     ///< cones x 9: normal, first and second tangent, unit vectors
  Pairs bodies_of_cone;             ///< cones x 2: body indices; -1 is a wall or the ground
  Table body_positions;             ///< bodies x 3 [m]
  Eigen::VectorXd body_radii;       ///< bodies; 0 where a body is not a sphere [m]
  Eigen::VectorXd volume_fraction;  ///< cones; of the medium there [-]; 0: not a node of a medium
  std::vector<int> state;           ///< cones; a NodeState, -1: not a node of a medium
};

/// An answer to the *standard* problem.
struct Solution {
  Eigen::VectorXd r;  ///< r' = r + kappa e_n, one entry a row [force_unit]
  Eigen::VectorXd u;  ///< one entry a row, or empty [rate_unit]
  Eigen::VectorXd v;  ///< one entry a dof, or empty
  double eta = 0.0;   ///< its residual when it was written
};

/// Everything a problem file holds.
struct ProblemFile {
  Problem problem;
  std::optional<Geometry> geometry;
  Eigen::VectorXd guess;  ///< r' to start from, or empty
  std::optional<Solution> solution;
};

/// Writes version 1 of our format: to a temporary name beside `path`, synced, renamed.
/// Throws OutputError (unwritable, disk full) and then leaves nothing behind.
void write_problem_file(const std::filesystem::path& path, const ProblemFile& file);

/// Changes how many steps a file of ours says that it stands for, in place, and syncs it. The
/// problem and its hash stay. Not atomic: for files that nobody reads yet. Throws OutputError.
void set_sampling_weight(const std::filesystem::path& path, double weight);

/// The same as write_problem_file() for another program to solve: the standard problem, its guess
/// (empty: none), and root attribute `rate_scale` in any case.
void write_external_problem(const std::filesystem::path& path, const Problem& standard,
                            const Eigen::VectorXd& guess);

/// Reads version 1 of our format. Throws InputError naming file and dataset.
ProblemFile read_problem_file(const std::filesystem::path& path);

/// Writes a file with /solution/{r,u,v} only, atomically; what `conebench solve -o` leaves.
void write_solution_file(const std::filesystem::path& path, const Problem& problem,
                         const Solution& solution);

/// What a program of somebody else wrote.
struct ForeignAnswer {
  Eigen::VectorXd r;            ///< /solution/r
  std::int64_t iterations = 0;  ///< attribute `iterations` of /solution; 0 when there is none
};

/// Throws InputError unless r has `rows` finite numbers and the iterations are a whole number >= 0.
ForeignAnswer read_foreign_answer(const std::filesystem::path& path, Eigen::Index rows);

/// SHA-256 (hex) over the canonical content of the problem: little-endian numbers, rows sorted,
/// stored zeros dropped, duplicates summed. Twins in two formats hash alike; names do not count.
std::string content_sha256(const Problem& problem);

}  // namespace conebench::problems
