/*
 * my_solver: projected Gauss-Seidel. A sweep does, for each cone i in order,
 *
 *   u_i = W_i r + q_i,    u_hat_i = u_i + theta_i |u_it| e_n,
 *   r_i <- P_Ki(r_i - (omega / lambda_i) u_hat_i),
 *
 * where P_K is the projection on the cone and lambda_i the largest eigenvalue of W_ii. Replace it
 * by something better. harness/plugin_api.h says what the functions get and owe.
 */
#include "harness/plugin_api.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const conebench_parameter kParameters[] = {
    CONEBENCH_REAL_PARAMETER("omega", 1.0, 0.05, 1.95, "relaxation of a step [-]")};

static double norm(const double* x, int32_t size) {
  double sum = 0.0;
  for (int32_t k = 0; k < size; ++k) sum += x[k] * x[k];
  return sqrt(sum);
}

/* The point of { |x_t| <= mu x_n } that is nearest to x, in place. */
static void project(double mu, double* x, int32_t dim) {
  const double tangential = norm(x + 1, dim - 1);
  if (x[0] >= 0.0 && tangential <= mu * x[0]) return;
  if (mu * tangential <= -x[0]) {
    memset(x, 0, (size_t)dim * sizeof *x);
    return;
  }
  x[0] = (x[0] + mu * tangential) / (1.0 + mu * mu);
  for (int32_t k = 1; k < dim; ++k) x[k] *= mu * x[0] / tangential;
}

/* Where a step takes cone i, for its u; returns how far, as a rate: lambda_i |next - r_i|. */
static double step(const conebench_problem* problem, int32_t i, double omega, const double* u,
                   const double* r, double* next) {
  const int32_t dim = problem->dim[i];
  const double lambda = problem->mobility[i];
  const double shift = problem->theta[i] * norm(u + 1, dim - 1);
  double square = 0.0;
  for (int32_t k = 0; k < dim; ++k) next[k] = r[k] - omega / lambda * (u[k] + (k ? 0.0 : shift));
  project(problem->mu[i], next, dim);
  for (int32_t k = 0; k < dim; ++k) square += (next[k] - r[k]) * (next[k] - r[k]);
  return lambda * sqrt(square);
}

static void sweep(const conebench_problem* problem, const conebench_matrix* W, double omega,
                  double* r, double* u, double* next) {
  for (int32_t i = 0; i < problem->cones; ++i) {
    const int32_t start = problem->start[i], dim = problem->dim[i];
    for (int32_t k = 0; k < dim; ++k) {
      u[k] = problem->q[start + k];
      for (int32_t at = W->row_start[start + k]; at < W->row_start[start + k + 1]; ++at)
        u[k] += W->value[at] * r[W->column[at]];
    }
    step(problem, i, omega, u, r + start, next);
    memcpy(r + start, next, (size_t)dim * sizeof *r);
  }
}

/* The residual that an answer is judged by. */
static double eta(const conebench_problem* problem, const conebench_host* host, const double* r,
                  double* u, double* next) {
  double worst = 0.0;
  host->rate(host->context, r, u);
  for (int32_t i = 0; i < problem->cones; ++i) {
    const int32_t start = problem->start[i];
    worst = fmax(worst, step(problem, i, 1.0, u + start, r + start, next));
  }
  return problem->rate_scale > 0.0 ? worst / problem->rate_scale : worst;
}

static const char* refuses(const conebench_problem* problem, const conebench_value* values) {
  (void)values;
  for (int32_t i = 0; i < problem->cones; ++i)
    if (!(problem->mobility[i] > 0.0)) return "W is zero";
  return NULL;
}

static void solve(const conebench_problem* problem, const conebench_value* values,
                  const conebench_stop* stop, const conebench_host* host,
                  conebench_result* result) {
  const double omega = values[0].real;
  const conebench_matrix* W = host->delassus(host->context);
  double* u = malloc(2 * (size_t)problem->rows * sizeof *u);
  if (u == NULL && problem->rows > 0) abort();
  double* next = u + problem->rows;

  result->r_size = (size_t)problem->rows;
  while (host->check(host->context, result->iterations, result->r)) {
    if (stop->test == CONEBENCH_OWN_TEST && eta(problem, host, result->r, u, next) <= stop->tol) {
      result->status = CONEBENCH_CONVERGED;
      break;
    }
    sweep(problem, W, omega, result->r, u, next);
    ++result->iterations;
  }
  free(u);
}

const conebench_plugin* conebench_plugin_entry(void) {
  static const conebench_plugin kPlugin = {
      sizeof(conebench_plugin),
      CONEBENCH_ABI_VERSION,
      "my_solver",
      "projected Gauss-Seidel",
      kParameters,
      sizeof kParameters / sizeof *kParameters,
      refuses,
      solve,
  };
  return &kPlugin;
}
