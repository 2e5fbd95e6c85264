/* Explicit Euler and the classical Runge-Kutta method of order 4, at a fixed step. */
#include "onestep.h"

static int euler_attempt(rt_session *s, rt_onestep *o, double h) {
  static const double b[] = {1};
  return rt_explicit_stage(s, o, h, s->d->n_x, 1, 1, b, true);
}

static void euler_dense(int n, const rt_onestep *o, rt_dense *dense) {
  dense->degree = 1;
  for (int i = 0; i < n; i++) {
    dense->c[i] = o->x0[i];
    dense->c[n + i] = o->x1[i] - o->x0[i];
  }
}

static int rk4_attempt(rt_session *s, rt_onestep *o, double h) {
  static const double c[5] = {0, 0.5, 0.5, 1, 1};
  static const double a[5][4] = {{0}, {0.5}, {0, 0.5}, {0, 0, 1}, {1. / 6, 1. / 3, 1. / 3, 1. / 6}};
  static const mdl_scheme tableau = {.stages = 5, .nodes = c, .weights = &a[0][0]};
  if (s->d->stages) return rt_stages_at_once(s, o, h, &tableau);
  int status = 0;
  for (int j = 1; j < 5 && !status; j++)
    status = rt_explicit_stage(s, o, h, s->d->n_x, j, c[j], a[j], j == 4);
  return status;
}

/* Cubic Hermite polynomial through both ends of the step: local error O(h^4), so one event does not cost the order. */
static void rk4_dense(int n, const rt_onestep *o, rt_dense *dense) {
  dense->degree = 3;
  for (int i = 0; i < n; i++) {
    double rise = o->x1[i] - o->x0[i], f0 = o->h * o->f0[i], f1 = o->h * o->f1[i];
    dense->c[i] = o->x0[i];
    dense->c[n + i] = f0;
    dense->c[2 * n + i] = 3 * rise - 2 * f0 - f1;
    dense->c[3 * n + i] = f0 + f1 - 2 * rise;
  }
}

static const rt_scheme euler = {.stages = 2, .ends_are_stages = true, .attempt = euler_attempt, .dense = euler_dense};
static const rt_scheme rk4 = {.stages = 5, .ends_are_stages = true, .attempt = rk4_attempt, .dense = rk4_dense};

static void *create_euler(rt_session *s) {
  return rt_onestep_create(s, &euler);
}
static void *create_rk4(rt_session *s) {
  return rt_onestep_create(s, &rk4);
}

const rt_method rt_method_euler = {
    .name = "euler",
    .needs_step = true,
    .create = create_euler,
    .destroy = rt_onestep_destroy,
    .begin = rt_onestep_begin,
    .restart = rt_onestep_restart,
    .step = rt_onestep_step,
    .dense = rt_onestep_dense,
    .count = rt_onestep_count,
};
const rt_method rt_method_rk4 = {
    .name = "rk4",
    .needs_step = true,
    .create = create_rk4,
    .destroy = rt_onestep_destroy,
    .begin = rt_onestep_begin,
    .restart = rt_onestep_restart,
    .step = rt_onestep_step,
    .dense = rt_onestep_dense,
    .count = rt_onestep_count,
};
