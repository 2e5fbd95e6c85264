/* T1: DC servo on a square wave, with dry friction that sticks.
 *
 *   L i' = u - R i - Ke w          J w' = Ke i - b w - tauc mode   (0 while stuck)
 *   u = +-U, reversed every Th     stuck until |Ke i| > tauc, sliding until w changes sign
 *
 * States [i A, w rad/s]; no algebraic unknowns. */
#include "problem.h"

static const double R = 3.5, L = 3.3e-3, Ke = 0.03, J = 7e-6, b = 2e-5, tauc = 2e-3, U = 12.0, Th = 0.1;

/* Keeps the guard of a sliding mode strictly positive where sliding begins, at w = 0. */
static const double w_guard = 1e-10;

static void start(problem_mode *m, double *y) {
  *m = (problem_mode){.mode = 0, .switches = 0, .level = U};
  y[0] = y[1] = 0.0;
}

static void derivatives(const problem_mode *m, const double *x, double *dx) {
  dx[0] = (m->level - R * x[0] - Ke * x[1]) / L;
  dx[1] = m->mode == 0 ? 0.0 : (Ke * x[0] - b * x[1] - m->mode * tauc) / J;
}

static void residual(const problem_mode *m, const double *y, const double *yp, double *r) {
  r[0] = L * yp[0] - (m->level - R * y[0] - Ke * y[1]);
  r[1] = J * yp[1] - (m->mode == 0 ? 0.0 : Ke * y[0] - b * y[1] - m->mode * tauc);
}

static void jacobian(const problem_mode *m, const double *y, double cj, double *const *columns) {
  (void)y;
  columns[0][0] = L * cj + R;
  columns[1][0] = Ke;
  columns[0][1] = m->mode == 0 ? 0.0 : -Ke;
  columns[1][1] = J * cj + (m->mode == 0 ? 0.0 : b);
}

static void guards(const problem_mode *m, const double *x, double *g) {
  g[0] = m->mode == 0 ? tauc - Ke * x[0] : m->mode * x[1] + w_guard;
  g[1] = m->mode == 0 ? tauc + Ke * x[0] : 1.0;
}

static double next_time_event(const problem_mode *m) {
  return Th * (m->switches + 1);
}

static void time_event(problem_mode *m) {
  m->switches += 1;
  m->level = -m->level;
}

static void guard_event(problem_mode *m, const double *x) {
  const double torque = Ke * x[0];
  if (m->mode == 0) {
    m->mode = torque > 0 ? 1 : -1;
  } else {
    m->mode = torque > tauc ? 1 : torque < -tauc ? -1 : 0;
  }
}

const problem servo_t1 = {
    "T1",       2,          2, 2, 2, 10.0, 1e-3, start, derivatives, residual, jacobian, guards, next_time_event,
    time_event, guard_event};
