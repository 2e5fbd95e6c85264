/* A hybrid problem written out by hand: what a careful engineer would program without a generator.
 *
 * The ODE form has the first n_x unknowns, the DAE form n_y of them: the differential ones, then the algebraic.
 * `mode` holds the discrete variables of the problem. Guards are strictly positive inside a mode and fall
 * through zero at its end. */
#ifndef LACUNA_BENCH_PROBLEM_H
#define LACUNA_BENCH_PROBLEM_H

enum { MAX_Y = 6, MAX_GUARDS = 2 };

typedef struct {
  int mode;     /* T1: -1 backward, 0 stuck, 1 forward; T2: number of commutations so far, from -1 */
  int switches; /* T1: reversals of the supply so far */
  double level; /* T1: supply, V */
} problem_mode;

typedef struct {
  const char *name;
  int n_x;            /* states of the ODE form */
  int n_differential; /* unknowns of the DAE form whose derivative occurs */
  int n_y;            /* unknowns of the DAE form */
  int n_guards;
  double stop;     /* s */
  double interval; /* of the output grid, s */
  void (*start)(problem_mode *m, double *y);
  void (*derivatives)(const problem_mode *m, const double *x, double *dx);
  void (*residual)(const problem_mode *m, const double *y, const double *yp, double *r);
  void (*jacobian)(const problem_mode *m, const double *y, double cj, double *const *columns);
  void (*guards)(const problem_mode *m, const double *x, double *g);
  double (*next_time_event)(const problem_mode *m); /* s; INFINITY where there is none */
  void (*time_event)(problem_mode *m);
  void (*guard_event)(problem_mode *m, const double *x);
} problem;

extern const problem servo_t1, bldc_t2;

typedef struct {
  long steps, residuals, jacobians, roots, events;
  double seconds;
} bench_counters;

/* Solve `p` and write its states on the output grid, row by row, the initial row included.
 * Return 0, or the status of the solver's call that failed. */
int solve_with_ida(const problem *p, double rtol, double atol, double *rows, bench_counters *counters);
int solve_with_rk4(const problem *p, double step, double *rows, bench_counters *counters);

#endif
