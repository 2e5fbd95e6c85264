/* The driver of the one-step methods: landing on limits, step size control, rejection. The step size survives events.
 */
#include "onestep.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "swings.h"

static const double least_cut = 0.05;  /* of a rejected step: after an event the old size may be far too large */
static const double log_floor = -13.3; /* log2 of the smallest error remembered, 1e-4 */

void *rt_onestep_create(rt_session *s, const rt_scheme *scheme) {
  size_t n = (size_t)s->d->n_x, room = n + 1;
  rt_onestep *o = calloc(1, sizeof *o);
  double *block = calloc(5 * room + (size_t)scheme->stages * n + 1, sizeof *block);
  void *work = calloc(1, 1 + (scheme->work_size ? scheme->work_size(s->d) : 0));
  if (!o || !block || !work) {
    free(o);
    free(block);
    free(work);
    return NULL;
  }
  *o = (rt_onestep){.scheme = scheme,
                    .work = work,
                    .x0 = block,
                    .x1 = block + room,
                    .error = block + 2 * room,
                    .k = block + 5 * room};
  o->f0 = scheme->ends_are_stages ? o->k : block + 3 * room;
  o->f1 = scheme->ends_are_stages ? o->k + ((size_t)scheme->stages - 1) * n : block + 4 * room;
  return o;
}

void rt_onestep_destroy(void *memory) {
  rt_onestep *o = memory;
  rt_onestep_tangent_free(o);
  free(o->work);
  free(o->x0);
  free(o);
}

/* Mean square of e_i / (atol_i + rtol max(|x0_i|, |x1_i|)). Divisions that need not wait for e, which comes last, do
 * not. */
static double mean_square(const rt_session *s, const rt_onestep *o, const double *e) {
  double sum = 0;
  int n = s->d->n_x;
  for (int i = 0; i < n; i++) {
    double size0 = fabs(o->x0[i]), size1 = fabs(o->x1[i]);
    double weighted = e[i] * (1 / (s->atol[i] + s->options.rtol * (size0 > size1 ? size0 : size1)));
    sum += weighted * weighted;
  }
  return n ? sum * (1. / n) : 0;
}

/* The same of what is left of the error where time is rounded: each stage is off by as much as time is, and what f
 * changes over the step by its share. No shorter step has less of it. Where that share is as large as the state is,
 * there is none in time's resolution (a pole, which an implicit scheme steps over), and none of the error is left out.
 */
static double beyond_rounding(const rt_session *s, rt_onestep *o) {
  for (int i = 0; i < s->d->n_x; i++) {
    double rounding = rt_time_resolution(s) * fabs(o->f1[i] - o->f0[i]);
    if (!(rounding < rt_max(fabs(o->x0[i]), s->nominal[i]))) continue;
    o->error[i] = copysign(rt_max(0, fabs(o->error[i]) - rounding), o->error[i]);
  }
  return mean_square(s, o, o->error);
}

/* Loops, because a call of memcpy costs more than the few states that most models have. */
static void load(const rt_session *s, rt_onestep *o) {
  for (int i = 0; i < s->d->n_x; i++) {
    o->x0[i] = s->data.x[i];
    o->f0[i] = s->data.xdot[i];
  }
  o->t0 = s->t;
}

/* First step size, after Hairer, Norsett & Wanner I, II.4, from the sizes of x, x' and x'' in tolerances; free of the
 * unit of time: higher derivatives are taken to grow by the same factor, the rate |x''| / |x'|, of which no less is
 * believed than one change over the whole run. Zero where no step is short enough: x' in tolerances is no number. */
static double first_step(rt_session *s, rt_onestep *o) {
  double span = s->stop - s->start;
  memcpy(o->x1, o->x0, (size_t)s->d->n_x * sizeof *o->x1);
  double d0 = sqrt(mean_square(s, o, o->x0)), d1 = sqrt(mean_square(s, o, o->f0));
  double h0 = rt_min(d0 < 1e-5 || d1 * span < 1e-5 ? 1e-6 * span : 0.01 * d0 / d1, span);
  if (!(h0 > 0)) return 0;
  for (int i = 0; i < s->d->n_x; i++)
    o->x1[i] = o->x0[i] + h0 * o->f0[i];
  if (rt_derivatives(s, s->t + h0, o->x1, o->f1, s->v_trial)) return h0;
  for (int i = 0; i < s->d->n_x; i++)
    o->error[i] = (o->f1[i] - o->f0[i]) / h0;
  double d2 = sqrt(mean_square(s, o, o->error)), speed = rt_max(d1, d2 * h0);
  if (!isfinite(speed)) return h0;
  if (!(speed * span > 1e-15)) return rt_max(1e-6 * span, 1e-3 * h0);
  double rate = rt_max(d2 / speed, 1 / span);
  return rt_min(100 * h0, pow(0.01 * rate / speed, 1.0 / o->scheme->order) / rate);
}

rt_status rt_onestep_begin(rt_session *s, void *memory) {
  rt_onestep *o = memory;
  o->last_log_error = log_floor;
  if (s->options.step > 0) return RT_OK;
  load(s, o);
  memcpy(s->v_trial, s->data.v, (size_t)s->d->n_v * sizeof *s->v_trial);
  o->h_next = s->d->n_x ? first_step(s, o) : s->stop - s->start;
  return RT_OK;
}

/* Mean square of x' in tolerances, a second long. */
static double speed(const rt_session *s, const double *xdot) {
  double sum = 0;
  for (int i = 0; i < s->d->n_x; i++) {
    double weighted = xdot[i] / (s->atol[i] + s->options.rtol * fabs(s->data.x[i]));
    sum += weighted * weighted;
  }
  return sum;
}

/* Each step starts from the session's x and x': nothing else has to be renewed. The step size is kept, but for what x'
 * has grown by: where an event sets off again what had nearly come to rest, so has the error of a step. */
rt_status rt_onestep_restart(rt_session *s, void *memory) {
  rt_onestep *o = memory;
  double before = speed(s, s->xdot_before), after = speed(s, s->data.xdot);
  if (after > before && o->scheme->order > 0)
    o->h_next *= rt_max(least_cut, pow(before / after, 0.5 / o->scheme->order));
  return RT_OK;
}

/* log2 and its inverse from the bits of a double: the mantissa taken for linear is within 6 %, which is plenty for
 * choosing a step and costs a tenth of the library's. */
static double rough_log2(double x) {
  int64_t bits;
  memcpy(&bits, &x, sizeof bits);
  return (double)bits * 0x1p-52 - 1023;
}

static double rough_exp2(double y) {
  int64_t bits = (int64_t)((y + 1023) * 0x1p52);
  double x;
  memcpy(&x, &bits, sizeof x);
  return x;
}

/* PI controller for an accepted step of size h; a step that was cut short to land does not shrink the next one. */
static void control(rt_onestep *o, double h, double square, bool rejected, bool cut) {
  const rt_scheme *scheme = o->scheme;
  double log_error = 0.5 * rough_log2(rt_max(square, 1e-20));
  double exponent = scheme->damping * o->last_log_error - (1.0 / scheme->order - 0.75 * scheme->damping) * log_error;
  double factor = rt_min(scheme->max_factor, rt_max(scheme->min_factor, 0.9 * rough_exp2(exponent)));
  double h_next = h * (rejected ? rt_min(1, factor) : factor);
  o->h_next = cut ? rt_max(o->h_next, h_next) : h_next;
  o->last_log_error = rt_max(log_error, log_floor);
}

static void accept(rt_session *s, rt_onestep *o, double t, double h) {
  for (int i = 0; i < s->d->n_x; i++) {
    s->data.x[i] = o->x1[i];
    s->data.xdot[i] = o->f1[i];
  }
  o->h = h;
  s->t = t;
  if (o->tangent) rt_onestep_tangent_accept(s, o);
  s->result->counters.steps++;
}

/* The size to try: not past the limit, and no sliver of a step left before it. */
static double choose(const rt_session *s, const rt_onestep *o, double remaining) {
  if (s->options.step > 0) return remaining;
  double h = s->options.max_step > 0 ? rt_min(o->h_next, s->options.max_step) : o->h_next;
  if (h >= 0.999 * remaining) return remaining;
  return h > 0.5 * remaining ? 0.5 * remaining : h;
}

/* The square of the error that decides: that of the states, or of guards made of them. */
static double test_guards(rt_session *s, rt_onestep *o, double h, double square) {
  if (!s->d->guard_rates) return square;
  o->h = h;
  s->dense.valid = false;
  double swing = rt_swing_error(s, s->t + h, o->error);
  return rt_max(square, swing * swing);
}

/* Whether a step that took other ways than Newton's to a root, or came to one of another branch, has left its branch,
 * be it at a stage alone. */
static bool strays(rt_session *s, rt_onestep *o, double h, rt_status *ended) {
  mdl_contraction seen = s->data.contraction;
  if (!s->d->n_branches || (seen.ratio <= MDL_CONTRACTS && !seen.turned)) return false;
  o->h = h;
  s->dense.valid = false;
  bool strays = rt_branch_strays(s, s->t + h, o->x1, o->f1, seen.turned, ended);
  s->data.contraction = seen;
  return strays;
}

rt_status rt_onestep_step(rt_session *s, void *memory, double limit) {
  rt_onestep *o = memory;
  bool adaptive = !(s->options.step > 0), rejected = false;
  double remaining = limit - s->t, h = choose(s, o, remaining);
  if (!(h > 0)) return rt_fail_collapse(s, h, "the states change too fast for any step");
  load(s, o);
  memcpy(s->v_before, s->data.v, (size_t)s->d->n_v * sizeof *s->v_before);
  for (;;) {
    int status = o->scheme->attempt(s, o, h);
    double square = status == 0 && adaptive ? mean_square(s, o, o->error) : 0;
    if (!status && !(adaptive && o->scheme->error_has_f1 && square <= 1)) status = rt_check_finite(s, o->f1);
    if (status < 0 || (status > 0 && !adaptive)) return rt_fail_model(s, s->t, "stepping");
    if (status == 0 && square > 1) square = beyond_rounding(s, o);
    if (status == 0 && square <= 1 && adaptive) square = test_guards(s, o, h, square);
    if (status == 0 && square <= 1 && o->tangent) {
      status = rt_onestep_tangent_step(s, o, h, adaptive ? &square : NULL);
      if (status < 0 || (status > 0 && !adaptive)) return rt_fail_model(s, s->t, "stepping with sensitivities");
    }
    rt_status ended = RT_OK;
    if (status == 0 && square <= 1 && adaptive && strays(s, o, h, &ended)) square = INFINITY;
    if (ended) return ended;
    if (status == 0 && square <= 1) {
      if (adaptive) control(o, h, square, rejected, h < o->h_next);
      accept(s, o, h == remaining ? limit : s->t + h, h);
      return RT_OK;
    }
    s->result->counters.error_test_fails++;
    rejected = true;
    memcpy(s->data.v, s->v_before, (size_t)s->d->n_v * sizeof *s->data.v); /* a step too long may find other roots */
    rt_branch_retreat(s);
    h *= status == 0 && isfinite(square) ? rt_max(least_cut, 0.9 * pow(square, -0.5 / o->scheme->order)) : 0.25;
    o->h_next = h;
    if (!(h > 0 && h >= rt_smallest_step(s))) return rt_fail_collapse(s, h, "the error test fails");
  }
}

void rt_onestep_dense(rt_session *s, void *memory, rt_dense *dense) {
  const rt_onestep *o = memory;
  dense->t0 = o->t0;
  dense->h = o->h;
  o->scheme->dense(s->d->n_x, o, dense);
}

void rt_onestep_errors(rt_session *s, void *memory, double *error) {
  const rt_onestep *o = memory;
  memcpy(error, o->error, (size_t)s->d->n_x * sizeof *error);
}

void rt_onestep_count(rt_session *s, void *memory) {
  (void)s;
  (void)memory;
}
