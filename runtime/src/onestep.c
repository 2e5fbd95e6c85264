/* The driver of the one-step methods: landing on limits, step size control, rejection. The step size survives events. */
#include "onestep.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

void *rt_onestep_create(rt_session *s, const rt_scheme *scheme) {
  size_t n = (size_t)s->d->n_x;
  rt_onestep *o = calloc(1, sizeof *o);
  double *block = calloc((5 + (size_t)scheme->stages) * n + 1, sizeof *block);
  void *work = calloc(1, 1 + (scheme->work_size ? scheme->work_size(s->d) : 0));
  if (!o || !block || !work) {
    free(o);
    free(block);
    free(work);
    return NULL;
  }
  *o = (rt_onestep){.scheme = scheme, .work = work, .x0 = block, .f0 = block + n, .x1 = block + 2 * n, .f1 = block + 3 * n,
                    .x_stage = block + 4 * n, .k = block + 5 * n};
  return o;
}

void rt_onestep_destroy(void *memory) {
  rt_onestep *o = memory;
  free(o->work);
  free(o->x0);
  free(o);
}

double rt_error_norm(const rt_session *s, const rt_onestep *o, const double *e) {
  double sum = 0;
  for (int i = 0; i < s->d->n_x; i++) {
    double scale = s->atol[i] + s->options.rtol * fmax(fabs(o->x0[i]), fabs(o->x1[i]));
    sum += (e[i] / scale) * (e[i] / scale);
  }
  return s->d->n_x ? sqrt(sum / s->d->n_x) : 0;
}

const double *rt_stage(const rt_session *s, rt_onestep *o, double h, int n, const double *a) {
  int n_x = s->d->n_x;
  for (int i = 0; i < n_x; i++) {
    double sum = 0;
    for (int j = 0; j < n; j++) sum += a[j] * o->k[j * n_x + i];
    o->x_stage[i] = o->x0[i] + h * sum;
  }
  return o->x_stage;
}

static void load(const rt_session *s, rt_onestep *o) {
  size_t bytes = (size_t)s->d->n_x * sizeof(double);
  memcpy(o->x0, s->data.x, bytes);
  memcpy(o->f0, s->data.xdot, bytes);
  o->t0 = s->t;
}

/* First step size: Hairer, Norsett & Wanner I, II.4, from the sizes of x, x' and x''. */
static double first_step(rt_session *s, rt_onestep *o) {
  size_t bytes = (size_t)s->d->n_x * sizeof(double);
  double span = s->stop - s->start;
  memcpy(o->x1, o->x0, bytes);
  double d0 = rt_error_norm(s, o, o->x0), d1 = rt_error_norm(s, o, o->f0);
  double h0 = fmin(d0 < 1e-5 || d1 < 1e-5 ? 1e-6 * span : 0.01 * d0 / d1, span);
  for (int i = 0; i < s->d->n_x; i++) o->x_stage[i] = o->x0[i] + h0 * o->f0[i];
  if (rt_rhs(s, s->t + h0, o->x_stage, o->f1, s->v_trial)) return h0;
  for (int i = 0; i < s->d->n_x; i++) o->x_stage[i] = (o->f1[i] - o->f0[i]) / h0;
  double largest = fmax(d1, rt_error_norm(s, o, o->x_stage));
  double h1 = largest <= 1e-15 ? fmax(1e-6 * span, 1e-3 * h0) : pow(0.01 / largest, 1.0 / o->scheme->order);
  return fmin(100 * h0, h1);
}

rt_status rt_onestep_begin(rt_session *s, void *memory) {
  rt_onestep *o = memory;
  o->last_error = 1e-4;
  if (s->options.step > 0) return RT_OK;
  load(s, o);
  memcpy(s->v_trial, s->data.v, (size_t)s->d->n_v * sizeof *s->v_trial);
  o->h_next = s->d->n_x ? first_step(s, o) : s->stop - s->start;
  return RT_OK;
}

/* Each step starts from the session's x and x': nothing else has to be renewed, and the step size is kept. */
rt_status rt_onestep_restart(rt_session *s, void *memory) {
  (void)s;
  (void)memory;
  return RT_OK;
}

static rt_status fail_collapse(rt_session *s, const rt_onestep *o, double h) {
  if (s->data.failure.kind != MDL_FAILURE_NONE) return rt_fail_model(s, s->t, "stepping");
  int worst = 0;
  for (int i = 1; i < s->d->n_x; i++)
    if (fabs(o->x1[i] - o->x0[i]) / s->atol[i] > fabs(o->x1[worst] - o->x0[worst]) / s->atol[worst]) worst = i;
  int variable = rt_state_variable(s, worst);
  return rt_fail(s, RT_STEP_COLLAPSE, s->t, variable, NULL, "step size collapsed to %.3g s at time %.9g s; %s changes fastest", h, s->t,
                 variable >= 0 ? s->d->variables[variable].name : "a state");
}

/* PI controller for an accepted step of size h; a step that was cut short to land does not shrink the next one. */
static void control(rt_onestep *o, double h, double error, bool rejected, bool cut) {
  const rt_scheme *scheme = o->scheme;
  double e = fmax(error, 1e-10);
  double factor = 0.9 * pow(e, -(1.0 / scheme->order - 0.75 * scheme->damping)) * pow(o->last_error, scheme->damping);
  factor = fmin(scheme->max_factor, fmax(scheme->min_factor, factor));
  double h_next = h * (rejected ? fmin(1, factor) : factor);
  o->h_next = cut ? fmax(o->h_next, h_next) : h_next;
  o->last_error = fmax(error, 1e-4);
}

static void accept(rt_session *s, rt_onestep *o, double t, double h) {
  size_t bytes = (size_t)s->d->n_x * sizeof(double);
  memcpy(s->data.x, o->x1, bytes);
  memcpy(s->data.xdot, o->f1, bytes);
  o->h = h;
  s->t = t;
  s->result->counters.steps++;
}

/* The size to try: not past the limit, and no sliver of a step left before it. */
static double choose(const rt_session *s, const rt_onestep *o, double remaining) {
  if (s->options.step > 0) return remaining;
  double h = s->options.max_step > 0 ? fmin(o->h_next, s->options.max_step) : o->h_next;
  if (h >= 0.999 * remaining) return remaining;
  return h > 0.5 * remaining ? 0.5 * remaining : h;
}

rt_status rt_onestep_step(rt_session *s, void *memory, double limit) {
  rt_onestep *o = memory;
  bool adaptive = !(s->options.step > 0), rejected = false;
  double remaining = limit - s->t, h = choose(s, o, remaining);
  load(s, o);
  s->data.failure.kind = MDL_FAILURE_NONE;
  for (;;) {
    double error = 0;
    int status = o->scheme->attempt(s, o, h, &error);
    if (status < 0 || (status > 0 && !adaptive)) return rt_fail_model(s, s->t, "stepping");
    if (status == 0 && (!adaptive || error <= 1)) {
      if (adaptive) control(o, h, error, rejected, h < o->h_next);
      accept(s, o, h == remaining ? limit : s->t + h, h);
      return RT_OK;
    }
    s->result->counters.error_test_fails++;
    rejected = true;
    bool usable = status == 0 && isfinite(error);
    h *= usable ? fmax(o->scheme->min_factor, 0.9 * pow(error, -1.0 / o->scheme->order)) : 0.25;
    o->h_next = h;
    if (h < 16 * DBL_EPSILON * fmax(fabs(s->t), 1e-3 * (s->stop - s->start))) return fail_collapse(s, o, h);
  }
}

void rt_onestep_dense(rt_session *s, void *memory, rt_dense *dense) {
  const rt_onestep *o = memory;
  dense->t0 = o->t0;
  dense->h = o->h;
  o->scheme->dense(s, o, dense);
}

void rt_onestep_count(rt_session *s, void *memory) {
  (void)s;
  (void)memory;
}
