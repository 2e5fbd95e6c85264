/* Sensitivities at an event: the instant itself moves with the parameters.
 *
 * Where the guard g(t, x, p) is zero, its instant moves by
 *
 *     dt/dp = -(g_x s- + g_p) / (g_t + g_x f-)
 *
 * and states that the event maps by h(t, x, p) have, at fixed time after it,
 *
 *     s+ = h_x s- + h_p + (h_t + h_x f- - f+) dt/dp
 *
 * (I. A. Hiskens, M. A. Pai, IEEE Trans. Circuits Syst. I 47 (2000) 204-220). This is computed in three moves: the
 * total derivative along the moving instant X = s- + f- dt/dp; the event's own derivative applied to it, pass by pass
 * as the event is iterated, with time moving by dt/dp; and back to fixed time, s+ = h(X) - f+ dt/dp. Instants of time
 * events and samples move with the parameters in them, those of inputs do not.
 *
 * That holds while the events keep their order. A guard that is grazed (its slope is lost in its terms, or within the
 * tolerance it need not have been passed) ends the sensitivities with a flag; two events within the uncertainty of
 * their instants that move differently get one; and `margin` is how far each parameter may go before two instants meet.
 */

#include <string.h>

#include "sensitivity.h"

/* Relative accuracy of dt/dp that may be expected of a run with the relative tolerance rtol. */
static const double ACCURACY = 100;
static const double INVISIBLE = 1e-3; /* of the tolerance */

static int guards_of(rt_session *s, mdl_tangent *bundle, double *rows) {
  const struct mdl_tangents *f = s->d->tangents;
  mdl_data *m = &s->data;
  return f->rhs(m, s->t, m->x, m->xdot, m->v, bundle) ||
         f->roots(m, s->t, m->x, m->xdot, m->v, bundle, (mdl_lanes *)rows);
}

/* Everything in `probe` zero. */
static void clear_probe(rt_session *s) {
  const mdl_descriptor *d = s->d;
  mdl_tangent *probe = &s->sensitivities->probe;
  memset(probe->x, 0, (size_t)d->n_x * sizeof(mdl_lanes));
  memset(probe->u, 0, (size_t)d->n_u * sizeof(mdl_lanes));
  memset(probe->t, 0, sizeof(mdl_lanes));
}

/* Guards at fixed time, and their slopes along the run, at the instant before anything of the event has happened. */
rt_status rt_jump_measure(rt_session *s) {
  rt_sensitivities *f = s->sensitivities;
  if (!f || f->lost) return RT_OK;
  for (int i = 0; i < s->d->n_u; i++)
    f->input_slope[i] = rt_input_slope(s, i);
  if (!s->d->n_rel) return RT_OK;
  clear_probe(s);
  for (int i = 0; i < s->d->n_x; i++)
    rt_rows(f->probe.x)[i * MDL_LANES] = s->data.xdot[i];
  for (int i = 0; i < s->d->n_u; i++)
    rt_rows(f->probe.u)[i * MDL_LANES] = f->input_slope[i];
  rt_rows(f->probe.t)[0] = 1;
  if (guards_of(s, &f->at, f->guards) || guards_of(s, &f->probe, f->probed))
    return rt_fail_model(s, s->t, "differentiating the guards of an event");
  for (int r = 0; r < s->d->n_rel; r++)
    f->slopes[r] = f->probed[r * MDL_LANES];
  return RT_OK;
}

typedef struct {
  double noise; /* of the guard, within the run's tolerances */
  double terms; /* sum of the sizes of what its slope is added up from */
} spread;

/* How well guard r and its slope are known: the derivatives of the guard by each state, a few at a time, with the
 * relations as they were before the event. */
static spread measure_spread(rt_session *s, int r) {
  rt_sensitivities *f = s->sensitivities;
  spread found = {0, 0};
  for (int first = 0; first < s->d->n_x; first += MDL_LANES) {
    clear_probe(s);
    for (int k = 0; k < MDL_LANES && first + k < s->d->n_x; k++)
      rt_rows(f->probe.x)[(first + k) * MDL_LANES + k] = 1;
    if (guards_of(s, &f->probe, f->probed)) return (spread){INFINITY, INFINITY};
    for (int k = 0; k < MDL_LANES && first + k < s->d->n_x; k++) {
      int i = first + k;
      double by_state = fabs(f->probed[r * MDL_LANES + k]);
      found.noise += by_state * (s->atol[i] + s->options.rtol * fabs(s->data.x[i]));
      found.terms += by_state * fabs(s->data.xdot[i]);
    }
  }
  return found;
}

/* Whether guard r only touches zero: see the head of this file. Its curvature is that of the parabola through its value
 * at the start of the step. */
static bool is_grazed(const rt_session *s, int r, spread known) {
  double slope = s->sensitivities->slopes[r], back = s->t - s->t_previous;
  double curvature = back > 0 ? 2 * fabs(s->g_previous[r] - s->g[r] + slope * back) / (back * back) : 0;
  return !(fabs(slope) > 0) || fabs(slope) < s->options.rtol * known.terms ||
         slope * slope < 2 * curvature * known.noise;
}

/* dt/dp of one cause of the event, against that of the others: at one instant all have to move alike. */
static void add_cause(rt_session *s, rt_instant *at, const double *guard, double slope, int relation) {
  rt_sensitivities *f = s->sensitivities;
  bool disagree = false;
  for (int k = 0; k < f->n; k++) {
    double moved = guard ? -guard[k] / slope : 0, known = f->event_time[k];
    if (!at->any) f->event_time[k] = moved;
    double apart = at->any ? fabs(moved - known) : 0, size = fabs(moved) + fabs(known);
    disagree |= apart > ACCURACY * s->options.rtol * size && apart * f->scale[k] > s->clock.tolerance;
  }
  if (disagree) {
    at->disagree = true;
    at->other = relation;
  }
  if (!at->any) at->relation = relation;
  at->any = true;
}

static void relation_cause(rt_session *s, rt_instant *at, int r) {
  rt_sensitivities *f = s->sensitivities;
  if (rt_is_state_relation(s, r)) {
    memcpy(s->rel_trial, s->data.rel, (size_t)s->d->n_rel);
    memcpy(s->data.rel, s->rel_before, (size_t)s->d->n_rel);
    spread known = measure_spread(s, r);
    memcpy(s->data.rel, s->rel_trial, (size_t)s->d->n_rel);
    if (is_grazed(s, r, known)) {
      at->grazed = true;
      at->relation = r;
      return;
    }
    at->uncertain = rt_max(at->uncertain, known.noise / fabs(f->slopes[r]));
  }
  add_cause(s, at, f->guards + r * f->columns, f->slopes[r], r);
}

/* A sample ticks at first + n interval; the clock has moved on to the next tick. */
static void sample_cause(rt_session *s, rt_instant *at, int i) {
  rt_sensitivities *f = s->sensitivities;
  double n = (double)(s->clock.next[i] - 1);
  for (int k = 0; k < f->columns; k++)
    f->tick[k] = f->first[i * f->columns + k] + n * f->interval[i * f->columns + k];
  add_cause(s, at, f->tick, -1, -1);
}

/* How far each parameter may go until this event and the last one meet; closer than their instants are known is
 * flagged.
 */
static void compare_with_last(rt_session *s) {
  rt_sensitivities *f = s->sensitivities;
  const rt_instant *at = &f->instant;
  double between = s->t - f->t_before, known = at->uncertain + f->t_uncertain;
  bool close = false;
  for (int k = 0; k < f->n; k++) {
    double now = f->event_time[k], before = f->event_time_before[k], apart = fabs(now - before);
    if (!(apart > 16 * DBL_EPSILON * (fabs(now) + fabs(before)))) continue;
    f->margin[k] = rt_min(f->margin[k], between / apart);
    close |= between <= known;
  }
  if (close) rt_result_flag(s->result, s->t, RT_FLAG_ORDER, at->relation, f->relation_before);
  f->t_before = s->t;
  f->t_uncertain = at->uncertain;
  f->relation_before = at->relation;
  memcpy(f->event_time_before, f->event_time, (size_t)f->columns * sizeof(double));
}

/* dt/dp from what has switched or ticked, and the total derivatives along the moving instant. */
void rt_jump_begin(rt_session *s) {
  const mdl_descriptor *d = s->d;
  rt_sensitivities *f = s->sensitivities;
  if (!f || f->lost) return;
  rt_instant *at = &f->instant;
  *at = (rt_instant){.relation = -1, .other = -1};
  memset(f->event_time, 0, (size_t)f->columns * sizeof(double));
  for (int r = 0; r < d->n_rel && !at->grazed; r++)
    if (s->data.rel[r] != s->rel_before[r]) relation_cause(s, at, r);
  for (int i = 0; i < d->n_sample; i++)
    if (s->data.tick[i]) sample_cause(s, at, i);
  if (s->pending & RT_PENDING_JUMP) add_cause(s, at, NULL, 1, -1);
  if (at->grazed) memset(f->event_time, 0, (size_t)f->columns * sizeof(double));
  memcpy(f->x_before, f->at.x, (size_t)(d->n_x * f->columns) * sizeof(double));
  memcpy(s->d_before, s->data.d, (size_t)d->n_d * sizeof(double));
  double *x = rt_rows(f->at.x), *t = rt_rows(f->at.t), *u = rt_rows(f->at.u);
  for (int k = 0; k < f->columns; k++) {
    t[k] = f->event_time[k];
    for (int i = 0; i < d->n_u; i++)
      u[i * f->columns + k] = f->input_slope[i] * t[k];
    for (int i = 0; i < d->n_x; i++)
      x[i * f->columns + k] += s->xdot_before[i] * t[k];
  }
}

/* A sweep of the discrete equations, the `first` of a pass or another with the same pre-values: the derivative of the
 * point, with relations and discretes as they were when it was computed, then that of the sweep. */
int rt_jump_sweep(rt_session *s, double *v, bool first) {
  const mdl_descriptor *d = s->d;
  mdl_data *m = &s->data;
  rt_sensitivities *f = s->sensitivities;
  if (!f || f->lost) return 0;
  bool arrived = v == m->v || !memcmp(v, m->v, (size_t)d->n_v * sizeof *v);
  if (!arrived && d->events_follow & MDL_ARRIVAL) { /* what y was on arrival has no row of its own */
    rt_tangent_lose(s, RT_FLAG_ARRIVAL, -1);
    return 0;
  }
  size_t relations = (size_t)d->n_rel, discretes = (size_t)d->n_d * sizeof *m->d;
  if (first) memcpy(f->at.pre_d, f->at.d, (size_t)f->columns * discretes);
  memcpy(s->rel_trial, m->rel, relations);
  memcpy(s->d_after, m->d, discretes);
  memcpy(m->rel, s->rel_swept, relations);
  memcpy(m->d, s->d_swept, discretes);
  int status = d->tangents->rhs(m, s->t, m->x, m->xdot, v, &f->at);
  memcpy(m->rel, s->rel_trial, relations);
  memcpy(m->d, s->d_after, discretes);
  memcpy(m->when, s->when_before, (size_t)d->n_when);
  memcpy(s->x_swept, m->x, (size_t)d->n_x * sizeof *m->x);
  memcpy(f->at.x_after, f->at.x, (size_t)(d->n_x * f->columns) * sizeof(double));
  return status ? status : d->tangents->event(m, s->t, s->x_swept, m->xdot, v, &f->at);
}

/* The pass is over: its states are where the next one starts. */
void rt_jump_accept(rt_session *s) {
  rt_sensitivities *f = s->sensitivities;
  if (f && !f->lost) memcpy(f->at.x, f->at.x_after, (size_t)(s->d->n_x * f->columns) * sizeof(double));
}

/* Whether the event has changed anything: a state, what is kept, or a slope by more than no error test would see over a
 * mean step. Where it has not, nothing jumps whenever it was: a kink that is rounding may have any instant. */
static bool has_consequences(const rt_session *s) {
  const mdl_data *m = &s->data;
  if (memcmp(m->x, s->x_before, (size_t)s->d->n_x * sizeof(double)) ||
      memcmp(m->d, s->d_before, (size_t)s->d->n_d * sizeof(double)))
    return true;
  double step = (s->t - s->start) / (double)(s->steps_taken + 1);
  for (int i = 0; i < s->d->n_x; i++) {
    double bend = fabs(m->xdot[i] - s->xdot_before[i]) * step;
    if (bend > INVISIBLE * (s->atol[i] + s->options.rtol * fabs(m->x[i]))) return true;
  }
  return false;
}

/* Back to fixed time, with the derivatives after the event. */
rt_status rt_jump_end(rt_session *s) {
  const mdl_descriptor *d = s->d;
  rt_sensitivities *f = s->sensitivities;
  if (!f || f->lost) return RT_OK;
  double *x = rt_rows(f->at.x);
  if (has_consequences(s)) {
    if (f->instant.grazed) rt_tangent_lose(s, RT_FLAG_GRAZING, f->instant.relation);
    if (f->instant.disagree) rt_result_flag(s->result, s->t, RT_FLAG_ORDER, f->instant.relation, f->instant.other);
    if (f->instant.any) compare_with_last(s);
    for (int i = 0; i < d->n_x; i++)
      for (int k = 0; k < f->columns; k++)
        x[i * f->columns + k] -= s->data.xdot[i] * f->event_time[k];
  } else {
    memcpy(x, f->x_before, (size_t)(d->n_x * f->columns) * sizeof(double));
  }
  memset(f->at.t, 0, (size_t)f->columns * sizeof(double));
  memset(f->at.u, 0, (size_t)(d->n_u * f->columns) * sizeof(double));
  memset(f->event_time, 0, (size_t)f->columns * sizeof(double));
  rt_status status = rt_tangent_evaluate(s);
  rt_tangent_check_finite(s);
  return status;
}
