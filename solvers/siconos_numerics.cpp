#include "solvers/siconos_numerics.h"

// The only file that includes Siconos. Its headers choose CXSparse's index type by a macro: cs.h
// must not be included before them.
#include <FrictionContactProblem.h>
#include <Friction_cst.h>
#include <NonSmoothDrivers.h>
#include <NumericsMatrix.h>
#include <NumericsVerbose.h>
#include <SolverOptions.h>
#include <SparseBlockMatrix.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <vector>

namespace conebench::solvers {
namespace {

using problems::SparseMatrix;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Siconos' structures are made of malloc'ed arrays. They live as long as the process.
template <class T>
T* array_of(std::size_t count) {
  return static_cast<T*>(std::calloc(std::max<std::size_t>(count, 1), sizeof(T)));
}

int solver_id(SiconosSolver solver, int dim) {
  switch (solver) {
    case SiconosSolver::kNsgs:
      return dim == 2 ? SICONOS_FRICTION_2D_NSGS : SICONOS_FRICTION_3D_NSGS;
    case SiconosSolver::kNsgsPli:
      return SICONOS_FRICTION_3D_NSGS;
    case SiconosSolver::kNsnAc:
      return SICONOS_FRICTION_3D_NSN_AC;
    case SiconosSolver::kNsnFb:
      return SICONOS_FRICTION_3D_NSN_FB;
    case SiconosSolver::kViEg:
      return SICONOS_FRICTION_3D_VI_EG;
    case SiconosSolver::kProx:
      return SICONOS_FRICTION_3D_PROX;
    case SiconosSolver::kAclmFp:
      return SICONOS_FRICTION_3D_ACLMFP;
    case SiconosSolver::kAdmm:
      return SICONOS_FRICTION_3D_ADMM;
    case SiconosSolver::kSoclcp:
      return SICONOS_FRICTION_3D_SOCLCP;
  }
  return -1;
}

int error_evaluation(SiconosError error) {
  switch (error) {
    case SiconosError::kFull:
      return SICONOS_FRICTION_3D_NSGS_ERROR_EVALUATION_FULL;
    case SiconosError::kLight:
      return SICONOS_FRICTION_3D_NSGS_ERROR_EVALUATION_LIGHT_WITH_FULL_FINAL;
  }
  return -1;
}

SolverOptions* make_options(const SiconosSettings& settings, int dim) {
  SolverOptions* options = solver_options_create(solver_id(settings.solver, dim));
  options->dparam[SICONOS_DPARAM_TOL] = settings.tol;
  options->iparam[SICONOS_IPARAM_MAX_ITER] = settings.max_iterations;
  if (settings.solver == SiconosSolver::kNsgsPli) {
    solver_options_update_internal(
        options, 0, SICONOS_FRICTION_3D_ONECONTACT_ProjectionOnConeWithLocalIteration);
  }
  const bool sweeps =
      settings.solver == SiconosSolver::kNsgs || settings.solver == SiconosSolver::kNsgsPli;
  if (sweeps) {
    options->iparam[SICONOS_FRICTION_3D_IPARAM_ERROR_EVALUATION] = error_evaluation(settings.error);
  }
  return options;
}

// Block columns of one block row, in order; the diagonal block always, since Siconos expects it.
std::vector<int> block_columns(const SparseMatrix& W, int block_row, int dim) {
  std::vector<int> columns{block_row};
  for (int row = block_row * dim; row < (block_row + 1) * dim; ++row) {
    for (SparseMatrix::InnerIterator entry(W, row); entry; ++entry) {
      columns.push_back(static_cast<int>(entry.col()) / dim);
    }
  }
  std::sort(columns.begin(), columns.end());
  columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
  return columns;
}

void copy_block_row(const SparseMatrix& W, int block_row, int dim, const std::vector<int>& columns,
                    double** blocks) {
  for (int i = 0; i < dim; ++i) {
    for (SparseMatrix::InnerIterator entry(W, block_row * dim + i); entry; ++entry) {
      const int column = static_cast<int>(entry.col());
      const auto found = std::lower_bound(columns.begin(), columns.end(), column / dim);
      blocks[found - columns.begin()][i + dim * (column % dim)] += entry.value();
    }
  }
}

SparseBlockStructuredMatrix* block_matrix(const SparseMatrix& W, int dim) {
  const int count = static_cast<int>(W.rows()) / dim;
  const auto rows = static_cast<std::size_t>(count);
  std::vector<std::vector<int>> columns;
  std::size_t total = 0;
  for (int i = 0; i < count; ++i) {
    columns.push_back(block_columns(W, i, dim));
    total += columns.back().size();
  }

  SparseBlockStructuredMatrix* matrix = SBM_new();
  matrix->nbblocks = static_cast<unsigned>(total);
  matrix->blocknumber0 = matrix->blocknumber1 = static_cast<unsigned>(count);
  matrix->filled1 = rows + 1;
  matrix->filled2 = total;
  matrix->block = array_of<double*>(total);
  matrix->blocksize0 = array_of<unsigned>(rows);
  matrix->blocksize1 = array_of<unsigned>(rows);
  matrix->index1_data = array_of<std::size_t>(rows + 1);
  matrix->index2_data = array_of<std::size_t>(total);
  const auto entries = static_cast<std::size_t>(dim * dim);
  double* values = array_of<double>(total * entries);
  std::size_t at = 0;
  for (std::size_t i = 0; i < rows; ++i) {
    matrix->blocksize0[i] = matrix->blocksize1[i] =
        static_cast<unsigned>(dim) * static_cast<unsigned>(i + 1);
    matrix->index1_data[i] = at;
    for (const int column : columns[i]) {
      matrix->index2_data[at] = static_cast<std::size_t>(column);
      matrix->block[at] = values + at * entries;
      ++at;
    }
    copy_block_row(W, static_cast<int>(i), dim, columns[i], matrix->block + matrix->index1_data[i]);
  }
  matrix->index1_data[rows] = at;
  return matrix;
}

// Sparse blocks are the fast storage of Gauss-Seidel, and no solver is slower with them than with
// compressed columns.
NumericsMatrix* matrix_of(const SparseMatrix& W, int dim) {
  const int rows = static_cast<int>(W.rows());
  NumericsMatrix* M = NM_new_SBM(rows, rows, block_matrix(W, dim));
  SBM_diagonal_block_indices(M->matrix1);
  return M;
}

}  // namespace

void run_siconos(const SiconosProblem& problem, const SiconosSettings& settings,
                 std::span<double> r, SiconosAnswer& answer) {
  const auto start = Clock::now();
  numerics_set_verbose(0);
  std::vector<double> q(problem.q.begin(), problem.q.end());
  std::vector<double> mu(problem.mu.begin(), problem.mu.end());
  std::vector<double> u(q.size());
  FrictionContactProblem* posed =
      frictionContactProblem_new_with_data(problem.dim, static_cast<int>(mu.size()),
                                           matrix_of(problem.W, problem.dim), q.data(), mu.data());
  SolverOptions* options = make_options(settings, problem.dim);
  answer.build_s = seconds_since(start);

  const auto driven = Clock::now();
  answer.info = problem.dim == 2 ? fc2d_driver(posed, r.data(), u.data(), options)
                                 : fc3d_driver(posed, r.data(), u.data(), options);
  answer.drive_s = seconds_since(driven);
  answer.iterations = options->iparam[SICONOS_IPARAM_ITER_DONE];
  answer.finished = true;
}

}  // namespace conebench::solvers
