/* The baseline of the bench: IDA as its examples use it. Variable-order BDF, analytic dense Jacobian, root
 * functions, and at every event IDAReInit and IDACalcIC. */
#include "problem.h"

#include <ida/ida.h>
#include <math.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <time.h>

typedef struct {
  const problem *p;
  problem_mode mode;
  bench_counters *counters;
  SUNContext context;
  N_Vector y, yp, id;
  SUNMatrix matrix;
  SUNLinearSolver linear;
  void *ida;
} solver;

static int residual(sunrealtype t, N_Vector y, N_Vector yp, N_Vector r, void *user) {
  (void)t;
  const solver *s = user;
  s->p->residual(&s->mode, N_VGetArrayPointer(y), N_VGetArrayPointer(yp), N_VGetArrayPointer(r));
  return 0;
}

static int jacobian(sunrealtype t, sunrealtype cj, N_Vector y, N_Vector yp, N_Vector r, SUNMatrix matrix, void *user,
                    N_Vector tmp1, N_Vector tmp2, N_Vector tmp3) {
  (void)t, (void)yp, (void)r, (void)tmp1, (void)tmp2, (void)tmp3;
  const solver *s = user;
  s->p->jacobian(&s->mode, N_VGetArrayPointer(y), cj, SUNDenseMatrix_Cols(matrix));
  return 0;
}

static int guards(sunrealtype t, N_Vector y, N_Vector yp, sunrealtype *g, void *user) {
  (void)t, (void)yp;
  const solver *s = user;
  s->p->guards(&s->mode, N_VGetArrayPointer(y), g);
  return 0;
}

/* Each call's status is kept in `status`; the first failure stops the set-up. */
static int set_up(solver *s, double rtol, double atol) {
  const int n = s->p->n_y;
  const int directions[MAX_GUARDS] = {-1, -1};
  SUNContext_Create(0, &s->context);
  s->y = N_VNew_Serial(n, s->context);
  s->yp = N_VNew_Serial(n, s->context);
  s->id = N_VNew_Serial(n, s->context);
  s->matrix = SUNDenseMatrix(n, n, s->context);
  s->linear = SUNLinSol_Dense(s->y, s->matrix, s->context);
  s->ida = IDACreate(s->context);
  for (int i = 0; i < n; i++) {
    NV_Ith_S(s->id, i) = i < s->p->n_differential;
    NV_Ith_S(s->yp, i) = 0.0;
  }
  s->p->start(&s->mode, N_VGetArrayPointer(s->y));
  int status = IDAInit(s->ida, residual, 0.0, s->y, s->yp);
  status = status ? status : IDASStolerances(s->ida, rtol, atol);
  status = status ? status : IDASetUserData(s->ida, s);
  status = status ? status : IDASetId(s->ida, s->id);
  status = status ? status : IDASetLinearSolver(s->ida, s->linear, s->matrix);
  status = status ? status : IDASetJacFn(s->ida, jacobian);
  status = status ? status : IDARootInit(s->ida, s->p->n_guards, guards);
  status = status ? status : IDASetRootDirection(s->ida, (int *)directions);
  return status ? status : IDASetMaxNumSteps(s->ida, 1000000);
}

static void tear_down(solver *s) {
  IDAFree(&s->ida);
  SUNLinSolFree(s->linear);
  SUNMatDestroy(s->matrix);
  N_VDestroy(s->id);
  N_VDestroy(s->yp);
  N_VDestroy(s->y);
  SUNContext_Free(&s->context);
}

/* IDAReInit clears IDA's counters, so they are added up before each. */
static void collect(solver *s) {
  long steps = 0, residuals = 0, jacobians = 0, roots = 0;
  IDAGetNumSteps(s->ida, &steps);
  IDAGetNumResEvals(s->ida, &residuals);
  IDAGetNumJacEvals(s->ida, &jacobians);
  IDAGetNumGEvals(s->ida, &roots);
  s->counters->steps += steps;
  s->counters->residuals += residuals;
  s->counters->jacobians += jacobians;
  s->counters->roots += roots;
}

static int restart(solver *s, double t) {
  collect(s);
  int status = IDAReInit(s->ida, t, s->y, s->yp);
  status = status ? status : IDACalcIC(s->ida, IDA_YA_YDP_INIT, t + s->p->interval);
  return status ? status : IDAGetConsistentIC(s->ida, s->y, s->yp);
}

/* Integrate to `goal`, over all events on the way. */
static int advance(solver *s, double *t, double goal) {
  while (*t < goal) {
    const double event = s->p->next_time_event(&s->mode);
    int status = event < s->p->stop ? IDASetStopTime(s->ida, event) : 0;
    status = status ? status : IDASolve(s->ida, goal, t, s->y, s->yp, IDA_NORMAL);
    if (status < 0) {
      return status;
    }
    if (status != IDA_ROOT_RETURN && status != IDA_TSTOP_RETURN) {
      return 0;
    }
    s->counters->events += 1;
    if (status == IDA_ROOT_RETURN) {
      s->p->guard_event(&s->mode, N_VGetArrayPointer(s->y));
    } else {
      s->p->time_event(&s->mode);
    }
    status = restart(s, *t);
    if (status < 0) {
      return status;
    }
  }
  return 0;
}

static int run(solver *s, double *rows) {
  const int points = (int)lround(s->p->stop / s->p->interval), n_x = s->p->n_x;
  double t = 0.0;
  int status = restart(s, t);
  for (int k = 0; k <= points && status == 0; k++) {
    status = k ? advance(s, &t, k * s->p->interval) : 0;
    for (int i = 0; i < n_x; i++) {
      rows[k * n_x + i] = NV_Ith_S(s->y, i);
    }
  }
  collect(s);
  return status;
}

int solve_with_ida(const problem *p, double rtol, double atol, double *rows, bench_counters *counters) {
  struct timespec begin, end;
  *counters = (bench_counters){0};
  solver s = {.p = p, .counters = counters};
  clock_gettime(CLOCK_MONOTONIC, &begin);
  int status = set_up(&s, rtol, atol);
  status = status ? status : run(&s, rows);
  tear_down(&s);
  clock_gettime(CLOCK_MONOTONIC, &end);
  counters->seconds = (double)(end.tv_sec - begin.tv_sec) + 1e-9 * (double)(end.tv_nsec - begin.tv_nsec);
  return status;
}
