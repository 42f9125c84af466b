/* Solves nothing; says in notes what it was given, and whether that fits together. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/plugin_api.h"

enum { kFlag, kCount, kFactor, kAnswer, kLabel, kParameterCount };

static const char* const kAnswers[] = {"stalled", "infeasible", "refusal", NULL};

static const conebench_parameter kParameters[] = {
    CONEBENCH_BOOLEAN_PARAMETER("flag", 1, "a boolean"),
    CONEBENCH_INTEGER_PARAMETER("count", 3, 0, HUGE_VAL, "an integer"),
    CONEBENCH_REAL_PARAMETER("factor", 0.5, -HUGE_VAL, HUGE_VAL, "a real [-]"),
    CONEBENCH_TEXT_PARAMETER("answer", "stalled", kAnswers, "a text of some"),
    CONEBENCH_TEXT_PARAMETER("label", "none", NULL, "any text")};

/* y += A x, or with `transposed` y += A^T x. */
static void multiply(const conebench_matrix* A, int transposed, const double* x, double* y) {
  for (int32_t row = 0; row < A->rows; ++row) {
    for (int32_t k = A->row_start[row]; k < A->row_start[row + 1]; ++k) {
      if (transposed) {
        y[A->column[k]] += A->value[k] * x[row];
      } else {
        y[row] += A->value[k] * x[A->column[k]];
      }
    }
  }
}

static double dot(const double* x, const double* y, int32_t size) {
  double sum = 0.0;
  for (int32_t k = 0; k < size; ++k) sum += x[k] * y[k];
  return sum;
}

/* M v = b by conjugate gradients; b becomes the residual. */
static void solve_mass(const conebench_matrix* M, double* b, double* v) {
  const int32_t n = M->rows;
  double* p = calloc(2 * (size_t)n, sizeof *p);
  double* Mp = p + n;
  memcpy(p, b, (size_t)n * sizeof *p);
  const double enough = 1e-30 * dot(b, b, n);
  for (int32_t k = 0; k < 10 * n && dot(b, b, n) > enough; ++k) {
    const double square = dot(b, b, n);
    memset(Mp, 0, (size_t)n * sizeof *Mp);
    multiply(M, 0, p, Mp);
    const double step = square / dot(p, Mp, n);
    for (int32_t i = 0; i < n; ++i) {
      v[i] += step * p[i];
      b[i] -= step * Mp[i];
    }
    const double turn = dot(b, b, n) / square;
    for (int32_t i = 0; i < n; ++i) p[i] = b[i] + turn * p[i];
  }
  free(p);
}

/* u from the matrices as they were given, in zeroed memory. */
static void rate_from_matrices(const conebench_problem* problem, const double* r, double* u) {
  const size_t dofs = (size_t)problem->dofs;
  if (problem->M == NULL) {
    memcpy(u, problem->q, (size_t)problem->rows * sizeof *u);
    multiply(problem->W, 0, r, u);
    return;
  }
  double* b = calloc(2 * dofs, sizeof *b);
  memcpy(b, problem->f, dofs * sizeof *b);
  multiply(problem->H, 1, r, b);
  solve_mass(problem->M, b, b + dofs);
  memcpy(u, problem->w, (size_t)problem->rows * sizeof *u);
  multiply(problem->H, 0, b + dofs, u);
  free(b);
}

static double distance(const double* x, const double* y, int32_t size) {
  double square = 0.0;
  for (int32_t k = 0; k < size; ++k) square += (x[k] - y[k]) * (x[k] - y[k]);
  return sqrt(square / dot(x, x, size));
}

/* How far three ways to u are apart: rate(), delassus(), the matrices. Relative. */
static double inconsistency(const conebench_problem* problem, const conebench_host* host) {
  const int32_t n = problem->rows;
  double* r = calloc(4 * (size_t)n, sizeof *r);
  double *u = r + n, *by_W = u + n, *by_matrices = by_W + n;
  for (int32_t k = 0; k < n; ++k) r[k] = sin(1.0 + k);
  host->rate(host->context, r, u);
  memcpy(by_W, problem->q, (size_t)n * sizeof *r);
  multiply(host->delassus(host->context), 0, r, by_W);
  rate_from_matrices(problem, r, by_matrices);
  const double worst = fmax(distance(u, by_W, n), distance(u, by_matrices, n));
  free(r);
  return worst;
}

static const char* refuses(const conebench_problem* problem, const conebench_value* values) {
  (void)problem;
  return strcmp(values[kAnswer].text, "refusal") == 0 ? "not today" : NULL;
}

static void solve(const conebench_problem* problem, const conebench_value* values,
                  const conebench_stop* stop, const conebench_host* host,
                  conebench_result* result) {
  char text[200];
  snprintf(text, sizeof text, "flag %d, count %lld, factor %g, label %s",
           (int)values[kFlag].boolean, (long long)values[kCount].integer, values[kFactor].real,
           values[kLabel].text);
  host->note(host->context, text);
  snprintf(text, sizeof text, "%s, %s, %s: %d cones, %d rows, tol %g, test %d", problem->name,
           problem->force_unit, problem->rate_unit, (int)problem->cones, (int)problem->rows,
           stop->tol, (int)stop->test);
  host->note(host->context, text);
  const double apart = inconsistency(problem, host);
  snprintf(text, sizeof text, "%s: %g", apart < 1e-10 ? "consistent" : "inconsistent", apart);
  host->note(host->context, text);

  result->status = CONEBENCH_STALLED;
  result->r_size = (size_t)problem->rows;
  if (strcmp(values[kAnswer].text, "infeasible") == 0) {
    result->status = CONEBENCH_INFEASIBLE;
    for (int32_t k = 0; k < problem->rows; ++k) result->certificate[k] = 1.0;
  }
}

const conebench_plugin* conebench_plugin_entry(void) {
  static const conebench_plugin kPlugin = {sizeof(conebench_plugin),
                                           CONEBENCH_ABI_VERSION,
                                           "talker",
                                           "says what it was given",
                                           kParameters,
                                           kParameterCount,
                                           refuses,
                                           solve};
  return &kPlugin;
}
