/* The ladder and the chain of bench/growth written out by hand over IDA and KLU, with sparse analytic Jacobians. */
#include "sparse.h"

#include <ida/ida.h>
#include <nvector/nvector_serial.h>
#include <stdlib.h>
#include <string.h>
#include <sunlinsol/sunlinsol_klu.h>
#include <sunmatrix/sunmatrix_sparse.h>
#include <time.h>

static const double V = 1.0, R = 100.0, C = 1e-6;          /* V, Ohm, F */
static const double M = 0.1, K = 1e4, D = 1.0, PULL = 1.0; /* kg, N/m, N.s/m, N */

/* v[k] of the capacitors: C v' = (v[k-1] - v[k])/R - (v[k] - v[k+1])/R, the first behind the source. */
static int ladder_residual(sunrealtype t, N_Vector y, N_Vector yp, N_Vector r, void *user) {
  (void)t;
  const int n = *(const int *)user;
  const double *v = N_VGetArrayPointer(y), *dv = N_VGetArrayPointer(yp);
  double *out = N_VGetArrayPointer(r), left = (V - v[0]) / R;
  for (int k = 0; k < n; k++) {
    const double right = k + 1 < n ? (v[k] - v[k + 1]) / R : 0.0;
    out[k] = C * dv[k] - (left - right);
    left = right;
  }
  return 0;
}

static int ladder_jacobian(sunrealtype t, sunrealtype cj, N_Vector y, N_Vector yp, N_Vector r, SUNMatrix a, void *user,
                           N_Vector tmp1, N_Vector tmp2, N_Vector tmp3) {
  (void)t, (void)y, (void)yp, (void)r, (void)tmp1, (void)tmp2, (void)tmp3;
  const int n = *(const int *)user;
  sunindextype *start = SM_INDEXPTRS_S(a), *row = SM_INDEXVALS_S(a), at = 0;
  double *value = SM_DATA_S(a);
  for (int k = 0; k < n; k++) {
    start[k] = at;
    if (k > 0) row[at] = k - 1, value[at++] = -1 / R;
    row[at] = k, value[at++] = C * cj + (k + 1 < n ? 2 : 1) / R;
    if (k + 1 < n) row[at] = k + 1, value[at++] = -1 / R;
  }
  start[n] = at;
  return 0;
}

/* s[0], v[0], s[1], v[1] ...: s' = v, M v' = f[k+1] - f[k] with f[k] of the link before body k, PULL at the end. */
static int chain_residual(sunrealtype t, N_Vector y, N_Vector yp, N_Vector r, void *user) {
  (void)t;
  const int bodies = *(const int *)user / 2;
  const double *s = N_VGetArrayPointer(y), *ds = N_VGetArrayPointer(yp);
  double *out = N_VGetArrayPointer(r), before = K * s[0] + D * s[1];
  for (int k = 0; k < bodies; k++) {
    const double *at = s + 2 * k;
    const double after = k + 1 < bodies ? K * (at[2] - at[0]) + D * (at[3] - at[1]) : PULL;
    out[2 * k] = ds[2 * k] - at[1];
    out[2 * k + 1] = M * ds[2 * k + 1] - (after - before);
    before = after;
  }
  return 0;
}

static int chain_jacobian(sunrealtype t, sunrealtype cj, N_Vector y, N_Vector yp, N_Vector r, SUNMatrix a, void *user,
                          N_Vector tmp1, N_Vector tmp2, N_Vector tmp3) {
  (void)t, (void)y, (void)yp, (void)r, (void)tmp1, (void)tmp2, (void)tmp3;
  const int bodies = *(const int *)user / 2;
  sunindextype *start = SM_INDEXPTRS_S(a), *row = SM_INDEXVALS_S(a), at = 0;
  double *value = SM_DATA_S(a);
  for (int k = 0; k < bodies; k++) {
    const int links = k + 1 < bodies ? 2 : 1;
    for (int speed = 0; speed < 2; speed++) {
      const double slope = speed ? D : K;
      start[2 * k + speed] = at;
      if (k > 0) row[at] = 2 * k - 1, value[at++] = -slope;
      row[at] = 2 * k, value[at++] = speed ? -1.0 : cj;
      row[at] = 2 * k + 1, value[at++] = links * slope + (speed ? M * cj : 0.0);
      if (k + 1 < bodies) row[at] = 2 * k + 3, value[at++] = -slope;
    }
  }
  start[2 * bodies] = at;
  return 0;
}

typedef struct {
  SUNContext context;
  N_Vector y, yp;
  SUNMatrix matrix;
  SUNLinearSolver linear;
  void *ida;
} solver;

static int set_up(solver *s, int chain, int *n, double rtol, double atol) {
  SUNContext_Create(0, &s->context);
  s->y = N_VNew_Serial(*n, s->context);
  s->yp = N_VNew_Serial(*n, s->context);
  s->matrix = SUNSparseMatrix(*n, *n, 4 * *n, CSC_MAT, s->context);
  s->linear = SUNLinSol_KLU(s->y, s->matrix, s->context);
  s->ida = IDACreate(s->context);
  double *dy = N_VGetArrayPointer(s->yp);
  N_VConst(0.0, s->y);
  N_VConst(0.0, s->yp);
  if (chain)
    dy[*n - 1] = PULL / M;
  else
    dy[0] = V / R / C;
  int status = IDAInit(s->ida, chain ? chain_residual : ladder_residual, 0.0, s->y, s->yp);
  status = status ? status : IDASStolerances(s->ida, rtol, atol);
  status = status ? status : IDASetUserData(s->ida, n);
  status = status ? status : IDASetLinearSolver(s->ida, s->linear, s->matrix);
  status = status ? status : IDASetJacFn(s->ida, chain ? chain_jacobian : ladder_jacobian);
  return status ? status : IDASetMaxNumSteps(s->ida, 1000000);
}

int solve_sparse(int chain, int n, double stop, int points, double rtol, double atol, double *rows, long *steps) {
  solver s;
  int status = set_up(&s, chain, &n, rtol, atol);
  memcpy(rows, N_VGetArrayPointer(s.y), (size_t)n * sizeof *rows);
  for (int k = 1; k < points && status >= 0; k++) {
    double reached;
    status = IDASolve(s.ida, stop * k / (points - 1), &reached, s.y, s.yp, IDA_NORMAL);
    memcpy(rows + (size_t)k * (size_t)n, N_VGetArrayPointer(s.y), (size_t)n * sizeof *rows);
  }
  IDAGetNumSteps(s.ida, steps);
  IDAFree(&s.ida);
  SUNLinSolFree(s.linear);
  SUNMatDestroy(s.matrix);
  N_VDestroy(s.yp);
  N_VDestroy(s.y);
  SUNContext_Free(&s.context);
  return status < 0 ? status : 0;
}
