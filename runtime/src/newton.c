/* Newton's method for IDA's steps: that of SUNDIALS (modified Newton, the Jacobian kept while it serves, the
 * convergence test of Brown, Hindmarsh & Petzold, SIAM J. Sci. Comput. 15 (1994) 1467-1488, section 2.1) in one place:
 * of a system of a few unknowns SUNDIALS' own spends most of its time on the way from one vector operation to the next.
 * Where starting values are known (ida_start.c) the solution of a step is one of them. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "ida.h"
#include "vector.h"

static const double unknown = 20;    /* |error| / |change| where no rate has been measured */
static const double ageing = 2;      /* growth of that in a step in which it is not */
static const double slow = 0.01;     /* rate at which another matrix costs less than more changes */
static const double most_rate = 0.9; /* of the changes: slower is no convergence */
static const double done = 1e-4;     /* of the tolerance: so small a first change needs no second */

enum { MOST_ANEW = 10 }; /* from thirty times too far, by halves and then squares, to 1e-10 of it */

typedef struct {
  rt_session *s;
  SUNNonlinSolLSetupFn set_up;
  N_Vector change;
  int most, iteration;
  long iterations, fails;
  double bound, bound_of_new; /* |error| / |change|, from the rate measured last, and last with a new matrix */
  bool is_new, is_old;        /* the matrix: made in this step; changes are slow by now */
} content;

/* A step of Newton's method, as IDA's vectors hold it. */
typedef struct {
  int n;
  double t, cj;
  N_Vector y, yp, residual;
  const double *predicted, *slope, *weight;
  double *correction;
} step;

/* What IDA may recover from by a shorter step. */
int rt_ida_not_finite(rt_session *s, int row, double value) {
  s->data.failure = (mdl_failure){MDL_FAILURE_NONFINITE, s->d->residual_equation[row], -1, value, 0};
  return 1;
}

int rt_ida_residual(sunrealtype t, N_Vector y, N_Vector yp, N_Vector r, void *user) {
  rt_session *s = user;
  if (s->d->n_u) rt_inputs_at(s, t);
  double *values = NV_DATA_S(r), sum = 0;
  s->result->counters.residuals++;
  int status = s->d->residual(&s->data, t, NV_DATA_S(y), NV_DATA_S(yp), values);
  if (status) return status;
  int n = s->d->n_x + s->d->n_z;
  for (int i = 0; i < n; i++)
    sum += values[i];
  if (isfinite(sum)) return 0;
  int row = 0;
  while (row < n - 1 && isfinite(values[row]))
    row++;
  rt_ida *m = s->memory;
  m->t_broken = t;
  N_VScale(1, y, m->broken);
  return rt_ida_not_finite(s, row, values[row]);
}

static SUNNonlinearSolver_Type type(SUNNonlinearSolver solver) {
  (void)solver;
  return SUNNONLINEARSOLVER_ROOTFIND;
}

/* IDA's own functions for the residual, the linear solver and the test are not needed here. */
static int set_system(SUNNonlinearSolver solver, SUNNonlinSolSysFn system) {
  (void)solver, (void)system;
  return 0;
}

static int set_set_up(SUNNonlinearSolver solver, SUNNonlinSolLSetupFn set_up) {
  ((content *)solver->content)->set_up = set_up;
  return 0;
}

static int set_most(SUNNonlinearSolver solver, int most) {
  ((content *)solver->content)->most = most;
  return 0;
}

static int iterations(SUNNonlinearSolver solver, long *count) {
  *count = ((const content *)solver->content)->iterations;
  return 0;
}

static int fails(SUNNonlinearSolver solver, long *count) {
  *count = ((const content *)solver->content)->fails;
  return 0;
}

/* The residual at the corrected point. */
static int residual(content *c, const step *k) {
  double *y = NV_DATA_S(k->y), *yp = NV_DATA_S(k->yp);
  for (int i = 0; i < k->n; i++) {
    y[i] = k->predicted[i] + k->correction[i];
    yp[i] = k->slope[i] + k->cj * k->correction[i];
  }
  return rt_ida_residual(k->t, k->y, k->yp, k->residual, c->s);
}

/* Another correction, from the residual; *size: how much it changes, in tolerances. */
static int correct(content *c, const step *k, double *size) {
  const rt_ida *m = c->s->memory;
  int status = SUNLinSolSolve(m->solver, m->matrix, c->change, k->residual, 0);
  if (status) return status;
  double *change = NV_DATA_S(c->change), sum = 0;
  for (int i = 0; i < k->n; i++) {
    k->correction[i] -= change[i];
    sum += (change[i] * k->weight[i]) * (change[i] * k->weight[i]);
  }
  *size = sqrt(sum / k->n);
  return 0;
}

/* Corrections until the next would be within the tolerance. What is known of the rate gets old, as the matrix does. */
static int iterate(content *c, const step *k, double tolerance) {
  double size, first = 0;
  for (c->iteration = 0; c->iteration < c->most; c->iteration++) {
    int status = c->iteration ? residual(c, k) : 0;
    c->iterations++;
    if (!status) status = correct(c, k, &size);
    if (status) return status;
    if (c->iteration == 0) {
      if (size <= done * tolerance) return 0;
      first = size;
      c->bound *= ageing;
    } else {
      double rate = c->iteration == 1 ? size / first : pow(size / first, 1.0 / c->iteration);
      if (rate > most_rate) return SUN_NLS_CONV_RECVR;
      c->bound = rate / (1 - rate);
      if (c->is_new) c->bound_of_new = c->bound;
      c->is_old = rate > slow;
    }
    if (c->bound * size <= tolerance) return 0;
  }
  return SUN_NLS_CONV_RECVR;
}

/* Corrections with a matrix of each point on the way, where that of the step's start does not serve: by q abs(q) = p
 * the slope at a solution near zero is many times that of where it is looked for. The first may go too far. */
static int iterate_anew(content *c, const step *k, double tolerance, void *ida) {
  double size, last = INFINITY;
  sunbooleantype current = SUNFALSE;
  memset(k->correction, 0, (size_t)k->n * sizeof *k->correction);
  c->is_old = true;
  for (int i = 0; i < MOST_ANEW; i++, last = size) {
    int status = residual(c, k);
    if (!status) status = c->set_up(SUNTRUE, &current, ida);
    if (!status) status = correct(c, k, &size);
    if (status) return status;
    c->iterations++;
    double rate = size / last;
    if (rate > most_rate) return SUN_NLS_CONV_RECVR;
    if (size <= done * tolerance || (i > 0 && rate / (1 - rate) * size <= tolerance)) return 0;
  }
  return SUN_NLS_CONV_RECVR;
}

/* The solution is known. */
static int take(rt_ida *m, const step *k) {
  const double *point = m->starts + m->known * k->n;
  if (!(fabs(k->t - m->start_t[m->known]) < 0.01 * m->h_first)) return IDA_NLS_FAIL; /* IDA is not where it is known */
  for (int i = 0; i < k->n; i++)
    k->correction[i] = point[i] - k->predicted[i];
  m->known++;
  return 0;
}

static int solve(SUNNonlinearSolver solver, N_Vector y0, N_Vector correction, N_Vector weight, sunrealtype tolerance,
                 sunbooleantype set_up, void *ida) {
  (void)y0;
  content *c = solver->content;
  N_Vector predicted, slope;
  void *user;
  step k = {.correction = NV_DATA_S(correction), .weight = NV_DATA_S(weight), .n = (int)NV_LENGTH_S(correction)};
  IDAGetNonlinearSystemData(ida, &k.t, &predicted, &slope, &k.y, &k.yp, &k.residual, &k.cj, &user);
  k.predicted = NV_DATA_S(predicted);
  k.slope = NV_DATA_S(slope);
  c->iterations = c->fails = 0;
  rt_ida *m = c->s->memory;
  if (m->known < RT_IDA_STARTS) return take(m, &k);
  set_up |= k.cj != m->cj_of_matrix || c->is_old;
  sunbooleantype bad = SUNFALSE, current = SUNFALSE;
  for (;;) {
    int status = residual(c, &k);
    c->is_new = set_up;
    if (!status && set_up) {
      status = c->set_up(bad, &current, ida);
      c->bound = c->bound_of_new;
      c->is_old = false;
    }
    bool begun = !status;
    if (begun) status = iterate(c, &k, tolerance);
    if (status == SUN_NLS_CONV_RECVR && c->is_new) status = iterate_anew(c, &k, tolerance, ida);
    if (!status) return 0;
    c->fails++;
    if (status < 0 || !begun || c->is_new) return status;
    set_up = bad = SUNTRUE; /* with a matrix of this step */
    c->bound_of_new = unknown;
    memset(k.correction, 0, (size_t)k.n * sizeof *k.correction);
  }
}

static int destroy(SUNNonlinearSolver solver) {
  content *c = solver->content;
  if (c && c->change) N_VDestroy(c->change);
  free(c);
  solver->content = NULL;
  SUNNonlinSolFreeEmpty(solver);
  return 0;
}

/* Other equations hold: nothing is known of rates. */
void rt_newton_forget(SUNNonlinearSolver solver) {
  content *c = solver->content;
  c->bound = c->bound_of_new = unknown;
}

SUNNonlinearSolver rt_newton_new(rt_session *s, SUNContext context) {
  SUNNonlinearSolver solver = SUNNonlinSolNewEmpty(context);
  content *c = calloc(1, sizeof *c);
  if (c) c->change = rt_vector_new(s->d->n_x + s->d->n_z, context);
  if (!solver || !c || !c->change) {
    if (c && c->change) N_VDestroy(c->change);
    if (solver) SUNNonlinSolFreeEmpty(solver);
    free(c);
    return NULL;
  }
  c->s = s;
  solver->content = c;
  *solver->ops = (struct _generic_SUNNonlinearSolver_Ops){.gettype = type,
                                                          .solve = solve,
                                                          .free = destroy,
                                                          .setsysfn = set_system,
                                                          .setlsetupfn = set_set_up,
                                                          .setmaxiters = set_most,
                                                          .getnumiters = iterations,
                                                          .getnumconvfails = fails};
  return solver;
}
