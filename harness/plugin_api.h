/*
 * The C interface between conebench and a solver in a shared library of its own. C99 and C++.
 *
 *   cc -O2 -fPIC -shared -I DIR_ABOVE_harness my_solver.c -o my_solver.so
 *   conebench solve FILE -s plugin:./my_solver.so
 *   conebench solve FILE -s "plugin:./my_solver.so[omega=1.3]"
 *
 * `conebench solver new NAME` writes a library that works; docs/add-a-solver.md is the way from
 * there to a ranking. The problem itself is described in problems/problem.h, eta in
 * problems/residual.h.
 *
 * Versions  A library is refused, before anything else of it is read, unless struct_size and
 *           abi_version of its conebench_plugin are those of the program. Its other structures
 *           are refused unless their struct_size is that of this file. CONEBENCH_ABI_VERSION
 *           changes with every change of this file that a compiled library would notice; the
 *           first two members of conebench_plugin never change.
 * Memory    What one side hands to the other stays its own. The program's structures, arrays
 *           and texts are valid until the function that got them returns; a library's must stay
 *           as they are for the life of the process.
 * Process   A library is loaded in a worker process that solves one task, and before that in
 *           one that only asks for name and parameters: it may crash, leak or hang without harm
 *           to anything but its own row in the results. It is never unloaded. stdout is thrown
 *           away, of stderr the end is kept.
 * Threads   All functions of a library are called from one thread, one at a time. It may start
 *           threads; only the one that solve() was called from may call the program's functions.
 *           omp_get_max_threads() is the number that the task allows.
 * Errors    Exceptions must not leave a library's functions; longjmp must not pass through the
 *           program's.
 */
#ifndef CONEBENCH_PLUGIN_API_H
#define CONEBENCH_PLUGIN_API_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define CONEBENCH_ABI_VERSION 1u

/* ---- The problem. */

/*
 * A sparse matrix by compressed rows: row i holds value[k] in column[k] for row_start[i] <= k <
 * row_start[i + 1], columns increasing, each at most once.
 */
typedef struct conebench_matrix {
  size_t struct_size;
  int32_t rows, columns;
  const int32_t* row_start; /* rows + 1 entries, the first is 0 */
  const int32_t* column;    /* row_start[rows] entries */
  const double* value;      /* row_start[rows] entries */
} conebench_matrix;

/*
 * The standard problem (cohesion is already shifted away): find r such that
 *
 *   M v = f + H^T r,  u = H v + w    (the primal form), or    u = W r + q    (the reduced one),
 *   u_hat_i = u_i + theta_i |u_it| e_n in the dual of K_i,  orthogonal to  r_i in K_i,
 *   K_i = { x : |x_t| <= mu_i x_n }.
 *
 * Cone i owns the rows start[i] <= row < start[i + 1]; its first row is normal (n), the others are
 * tangential (t). Units: r in force_unit, u, w and q in rate_unit, e.g. N s and m/s.
 */
typedef struct conebench_problem {
  size_t struct_size;
  const char* name;
  const char* force_unit;
  const char* rate_unit;
  int32_t cones;
  int32_t rows; /* = start[cones] */
  int32_t dofs; /* entries of v; 0 in the reduced form */

  /* Per cone. */
  const int32_t* start; /* cones + 1 entries */
  const int32_t* dim;   /* start[i + 1] - start[i], >= 1 */
  const double* mu;     /* friction coefficient [-], >= 0 */
  const double* theta;  /* flow coefficient [-]: mu for Coulomb friction, 0 for the associated */
  /* lambda_i = |W_ii|_2 [rate_unit / force_unit], >= 0: the step that eta takes is 1 / lambda_i. */
  const double* mobility;

  /* U: eta = max_i lambda_i |r_i - P_Ki(r_i - u_hat_i / lambda_i)| / U [rate_unit]. */
  double rate_scale;

  /* The primal form; all four are NULL in the reduced one. */
  const conebench_matrix* M; /* dofs x dofs, symmetric positive definite */
  const conebench_matrix* H; /* rows x dofs */
  const double* f;           /* dofs entries */
  const double* w;           /* rows entries */

  /* The reduced form. W is NULL in the primal form (conebench_host.delassus makes it), q is not. */
  const conebench_matrix* W; /* rows x rows, positive semidefinite, almost symmetric */
  const double* q;           /* rows entries: u at r = 0 */
} conebench_problem;

/* ---- Parameters. */

typedef enum conebench_type {
  CONEBENCH_BOOLEAN = 0,
  CONEBENCH_INTEGER = 1,
  CONEBENCH_REAL = 2,
  CONEBENCH_TEXT = 3
} conebench_type;

/* A value; the member of the parameter's type counts, the others are 0. */
typedef struct conebench_value {
  size_t struct_size;
  int32_t boolean; /* 0 or 1 */
  int64_t integer;
  double real;
  const char* text;
} conebench_value;

/* A parameter: what may stand in plugin:FILE[name=value]. */
typedef struct conebench_parameter {
  size_t struct_size;
  const char* name;           /* letters, digits, '_' and '-' */
  int32_t type;               /* a conebench_type */
  conebench_value fallback;   /* the default; within the range */
  double low, high;           /* of numbers, inclusive; may be infinite (-HUGE_VAL, HUGE_VAL) */
  const char* const* choices; /* of a text: those that there are, then NULL. NULL: any text */
  const char* doc;            /* one sentence, with the unit */
} conebench_parameter;

/* Initializers of a conebench_parameter. */
#define CONEBENCH_BOOLEAN_PARAMETER(name, fallback, doc)                       \
  {                                                                            \
    sizeof(conebench_parameter), name, CONEBENCH_BOOLEAN,                      \
        {sizeof(conebench_value), fallback, 0, 0.0, NULL}, 0.0, 1.0, NULL, doc \
  }
#define CONEBENCH_INTEGER_PARAMETER(name, fallback, low, high, doc)             \
  {                                                                             \
    sizeof(conebench_parameter), name, CONEBENCH_INTEGER,                       \
        {sizeof(conebench_value), 0, fallback, 0.0, NULL}, low, high, NULL, doc \
  }
#define CONEBENCH_REAL_PARAMETER(name, fallback, low, high, doc)              \
  {                                                                           \
    sizeof(conebench_parameter), name, CONEBENCH_REAL,                        \
        {sizeof(conebench_value), 0, 0, fallback, NULL}, low, high, NULL, doc \
  }
#define CONEBENCH_TEXT_PARAMETER(name, fallback, choices, doc)                 \
  {                                                                            \
    sizeof(conebench_parameter), name, CONEBENCH_TEXT,                         \
        {sizeof(conebench_value), 0, 0, 0.0, fallback}, 0.0, 0.0, choices, doc \
  }

/* ---- A solve. */

typedef enum conebench_test {
  CONEBENCH_COMMON_TEST = 0, /* eta, which check() looks at while the clock stands still */
  CONEBENCH_OWN_TEST = 1     /* the solver's own, inside the clock; check() watches the limits */
} conebench_test;

typedef struct conebench_stop {
  size_t struct_size;
  double tol;             /* on eta, or on the own test [-], > 0 */
  int64_t max_iterations; /* of the outermost loop, >= 0 */
  double time_limit_s;    /* of solver time, > 0; may be infinite */
  int32_t test;           /* a conebench_test: who decides that an answer is good enough */
} conebench_stop;

/* What the program does for a solver. `context` is the first argument of each function. */
typedef struct conebench_host {
  size_t struct_size;
  void* context;

  /*
   * To be called before the first iteration (which ends the set-up) and after every one, with the
   * number of iterations done and the iterate (rows entries; conebench_result.r, or another array,
   * which is copied). Returns 1 to go on and 0 to stop: the tolerance is met (common test), or a
   * limit is reached.
   */
  int32_t (*check)(void* context, int64_t iteration, const double* r);

  /* u = W r + q by the program's own factor of M; r and u have rows entries. Inside the clock. */
  void (*rate)(void* context, const double* r, double* u);

  /*
   * W = H M^-1 H^T of the primal form, or the problem's W. Assembled at the first call, inside the
   * clock; valid until solve() returns. It can be far larger than H.
   */
  const conebench_matrix* (*delassus)(void* context);

  /* Adds a line to the notes of the result, for readers of the table. The text is copied. */
  void (*note)(void* context, const char* text);
} conebench_host;

typedef enum conebench_status {
  CONEBENCH_STOPPED = 0,   /* check() said stop, and knows why; what stands without a word */
  CONEBENCH_CONVERGED = 1, /* a claim: r meets tol. It is verified; a wrong one is `refuted` */
  CONEBENCH_ITERATION_LIMIT = 2,
  CONEBENCH_TIME_LIMIT = 3,
  CONEBENCH_STALLED = 4,    /* r does not get better */
  CONEBENCH_DIVERGED = 5,   /* a NaN or an infinity appeared */
  CONEBENCH_INFEASIBLE = 6, /* there is no solution; certificate is the proof, and is verified */
  CONEBENCH_UNSUPPORTED = 7 /* no problem for this solver; refuses() is the better place */
} conebench_status;

/* The program fills it in before solve(), the solver changes what it has to say. */
typedef struct conebench_result {
  size_t struct_size;
  int32_t status;     /* a conebench_status; CONEBENCH_STOPPED at first */
  int64_t iterations; /* done, of the outermost loop; 0 at first */

  /*
   * rows entries: at first where to start from, r = 0 or a guess; then the answer, the best that
   * is known whatever the status. With the common test the best r that check() saw counts.
   */
  double* r;
  /* Entries of r that are an answer: to be set to rows; 0 at first, which is no answer. */
  size_t r_size;

  /* CONEBENCH_INFEASIBLE: rows entries, zeros at first, for y (solvers/certificate.h). */
  double* certificate;
} conebench_result;

/* ---- The library. */

typedef struct conebench_plugin {
  size_t struct_size;   /* sizeof(conebench_plugin); stays first */
  uint32_t abi_version; /* CONEBENCH_ABI_VERSION; stays second */
  const char* name;     /* for people; in results the solver is called by its file */
  const char* summary;  /* one line */
  const conebench_parameter* parameters; /* parameter_count of them; NULL if there are none */
  size_t parameter_count;

  /* NULL: takes every problem. Else returns NULL to take this one, or why not, in a few words. */
  const char* (*refuses)(const conebench_problem* problem, const conebench_value* values);

  /* values[k] belongs to parameters[k]; defaults are filled in and ranges checked. */
  void (*solve)(const conebench_problem* problem, const conebench_value* values,
                const conebench_stop* stop, const conebench_host* host, conebench_result* result);
} conebench_plugin;

#define CONEBENCH_EXPORT __attribute__((visibility("default")))

/* The one symbol that a library must have. */
CONEBENCH_EXPORT const conebench_plugin* conebench_plugin_entry(void);

#ifdef __cplusplus
}
#endif

#endif
