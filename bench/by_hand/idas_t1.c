/* The yardstick of sensitivities: T1 with its seven parameters over IDAS, as IDAS's examples use it. Staggered
 * corrector, analytic Jacobian and sensitivity residual, columns in the error test with tolerances from the parameters'
 * values, root functions; at every event the jump of the sensitivities, IDAReInit, IDASensReInit and IDACalcIC.
 *
 *   L i' = u - R i - Ke w          J w' = Ke i - b w - tauc mode   (0 while stuck)
 *
 * The states go on continuously; where a guard g(x, p) ends a mode its instant moves by
 * dt/dp = -(g_x s + g_p) / (g_x f-), and s jumps by (f- - f+) dt/dp. Reversals of the supply are at fixed times. */
#include "problem.h"

#include <idas/idas.h>
#include <math.h>
#include <nvector/nvector_serial.h>
#include <string.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <time.h>

enum { PR, PL, PKE, PJ, PB, PTAUC, PU, N_P, N = 2 };

static const double R = 3.5, L = 3.3e-3, Ke = 0.03, J = 7e-6, b = 2e-5, tauc = 2e-3, U = 12.0;

typedef struct {
  problem_mode mode;
  bench_counters *counters;
  SUNContext context;
  N_Vector y, yp, id, *s, *sp;
  SUNMatrix matrix;
  SUNLinearSolver linear;
  void *ida;
} solver;

static int residual(sunrealtype t, N_Vector y, N_Vector yp, N_Vector r, void *user) {
  (void)t;
  const solver *s = user;
  servo_t1.residual(&s->mode, N_VGetArrayPointer(y), N_VGetArrayPointer(yp), N_VGetArrayPointer(r));
  return 0;
}

static int jacobian(sunrealtype t, sunrealtype cj, N_Vector y, N_Vector yp, N_Vector r, SUNMatrix matrix, void *user,
                    N_Vector tmp1, N_Vector tmp2, N_Vector tmp3) {
  (void)t, (void)yp, (void)r, (void)tmp1, (void)tmp2, (void)tmp3;
  const solver *s = user;
  servo_t1.jacobian(&s->mode, N_VGetArrayPointer(y), cj, SUNDenseMatrix_Cols(matrix));
  return 0;
}

static int guards(sunrealtype t, N_Vector y, N_Vector yp, sunrealtype *g, void *user) {
  (void)t, (void)yp;
  const solver *s = user;
  servo_t1.guards(&s->mode, N_VGetArrayPointer(y), g);
  return 0;
}

/* F_y s + F_y' s' + F_p of every column. */
static int sensitivity_residual(int count, sunrealtype t, N_Vector vy, N_Vector vyp, N_Vector r, N_Vector *vs,
                                N_Vector *vsp, N_Vector *vrs, void *user, N_Vector t1, N_Vector t2, N_Vector t3) {
  (void)t, (void)r, (void)t1, (void)t2, (void)t3;
  const solver *s = user;
  const double i = NV_Ith_S(vy, 0), w = NV_Ith_S(vy, 1), di = NV_Ith_S(vyp, 0), dw = NV_Ith_S(vyp, 1);
  const double slides = s->mode.mode != 0, mode = s->mode.mode;
  const double by_parameter[N_P][N] = {{i, 0},          {di, 0},   {w, -slides * i},       {0, dw},
                                       {0, slides * w}, {0, mode}, {-s->mode.level / U, 0}};
  for (int k = 0; k < count; k++) {
    const double *x = N_VGetArrayPointer(vs[k]), *dx = N_VGetArrayPointer(vsp[k]);
    double *out = N_VGetArrayPointer(vrs[k]);
    out[0] = L * dx[0] + R * x[0] + Ke * x[1] + by_parameter[k][0];
    out[1] = J * dx[1] - slides * (Ke * x[0] - b * x[1]) + by_parameter[k][1];
  }
  return 0;
}

static int set_up_sensitivities(solver *s, double rtol, double atol) {
  const double values[N_P] = {R, L, Ke, J, b, tauc, U};
  double tolerances[N_P];
  s->s = N_VCloneVectorArray(N_P, s->y);
  s->sp = N_VCloneVectorArray(N_P, s->y);
  for (int k = 0; k < N_P; k++) {
    N_VConst(0.0, s->s[k]);
    N_VConst(0.0, s->sp[k]);
    tolerances[k] = atol / values[k];
  }
  int status = IDASensInit(s->ida, N_P, IDA_STAGGERED, sensitivity_residual, s->s, s->sp);
  status = status ? status : IDASensSStolerances(s->ida, rtol, tolerances);
  return status ? status : IDASetSensErrCon(s->ida, 1);
}

static int set_up(solver *s, double rtol, double atol) {
  const int directions[MAX_GUARDS] = {-1, -1};
  SUNContext_Create(0, &s->context);
  s->y = N_VNew_Serial(N, s->context);
  s->yp = N_VNew_Serial(N, s->context);
  s->id = N_VNew_Serial(N, s->context);
  s->matrix = SUNDenseMatrix(N, N, s->context);
  s->linear = SUNLinSol_Dense(s->y, s->matrix, s->context);
  s->ida = IDACreate(s->context);
  N_VConst(1.0, s->id);
  N_VConst(0.0, s->yp);
  servo_t1.start(&s->mode, N_VGetArrayPointer(s->y));
  int status = IDAInit(s->ida, residual, 0.0, s->y, s->yp);
  status = status ? status : IDASStolerances(s->ida, rtol, atol);
  status = status ? status : IDASetUserData(s->ida, s);
  status = status ? status : IDASetId(s->ida, s->id);
  status = status ? status : IDASetLinearSolver(s->ida, s->linear, s->matrix);
  status = status ? status : IDASetJacFn(s->ida, jacobian);
  status = status ? status : IDARootInit(s->ida, servo_t1.n_guards, guards);
  status = status ? status : IDASetRootDirection(s->ida, (int *)directions);
  status = status ? status : IDASetMaxNumSteps(s->ida, 1000000);
  return status ? status : set_up_sensitivities(s, rtol, atol);
}

static void tear_down(solver *s) {
  IDAFree(&s->ida);
  SUNLinSolFree(s->linear);
  SUNMatDestroy(s->matrix);
  N_VDestroyVectorArray(s->s, N_P);
  N_VDestroyVectorArray(s->sp, N_P);
  N_VDestroy(s->id);
  N_VDestroy(s->yp);
  N_VDestroy(s->y);
  SUNContext_Free(&s->context);
}

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
  status = status ? status : IDASensReInit(s->ida, IDA_STAGGERED, s->s, s->sp);
  status = status ? status : IDACalcIC(s->ida, IDA_YA_YDP_INIT, t + servo_t1.interval);
  status = status ? status : IDAGetConsistentIC(s->ida, s->y, s->yp);
  return status ? status : IDAGetSensConsistentIC(s->ida, s->s, s->sp);
}

/* The guard that has fallen to zero ends its mode; the sensitivities jump. */
static void guard_event(solver *s) {
  double before[N], after[N], *x = N_VGetArrayPointer(s->y);
  const double sign = Ke * x[0] > 0 ? 1.0 : -1.0;
  const int stuck = s->mode.mode == 0;
  servo_t1.derivatives(&s->mode, x, before);
  servo_t1.guard_event(&s->mode, x);
  servo_t1.derivatives(&s->mode, x, after);
  for (int k = 0; k < N_P; k++) {
    double *column = N_VGetArrayPointer(s->s[k]);
    /* stuck: g = tauc - sign Ke i; sliding: g = mode w, of which the sign cancels */
    const double by_parameter = stuck ? (k == PTAUC) - sign * (k == PKE) * x[0] : 0.0;
    const double moved = stuck ? -sign * Ke * column[0] + by_parameter : column[1];
    const double slope = stuck ? -sign * Ke * before[0] : before[1];
    const double instant = -moved / slope;
    for (int i = 0; i < N; i++)
      column[i] += (before[i] - after[i]) * instant;
  }
}

/* Integrate to `goal`, over all events on the way. */
static int advance(solver *s, double *t, double goal) {
  while (*t < goal) {
    const double event = servo_t1.next_time_event(&s->mode);
    int status = event < servo_t1.stop ? IDASetStopTime(s->ida, event) : 0;
    status = status ? status : IDASolve(s->ida, goal, t, s->y, s->yp, IDA_NORMAL);
    if (status < 0) return status;
    double reached;
    const int found = IDAGetSens(s->ida, &reached, s->s);
    if (found) return found;
    if (status != IDA_ROOT_RETURN && status != IDA_TSTOP_RETURN) return 0;
    s->counters->events += 1;
    if (status == IDA_ROOT_RETURN)
      guard_event(s);
    else
      servo_t1.time_event(&s->mode);
    if ((status = restart(s, *t)) < 0) return status;
  }
  return 0;
}

/* Rows of i, w, then di/dp and dw/dp of each parameter in turn. */
static int run(solver *s, double *rows) {
  const int points = (int)lround(servo_t1.stop / servo_t1.interval), width = N * (1 + N_P);
  double t = 0.0;
  int status = restart(s, t);
  for (int k = 0; k <= points && status == 0; k++) {
    status = k ? advance(s, &t, k * servo_t1.interval) : 0;
    double *row = rows + k * width;
    memcpy(row, N_VGetArrayPointer(s->y), N * sizeof *row);
    for (int j = 0; j < N_P; j++)
      memcpy(row + N * (1 + j), N_VGetArrayPointer(s->s[j]), N * sizeof *row);
  }
  collect(s);
  return status;
}

int solve_t1_with_idas(double rtol, double atol, double *rows, bench_counters *counters) {
  struct timespec begin, end;
  *counters = (bench_counters){0};
  solver s = {.counters = counters};
  clock_gettime(CLOCK_MONOTONIC, &begin);
  int status = set_up(&s, rtol, atol);
  status = status ? status : run(&s, rows);
  tear_down(&s);
  clock_gettime(CLOCK_MONOTONIC, &end);
  counters->seconds = (double)(end.tv_sec - begin.tv_sec) + 1e-9 * (double)(end.tv_nsec - begin.tv_nsec);
  return status;
}
