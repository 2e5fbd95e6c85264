/* State events: which relations have changed at the end of a step, and when the first of them did.
 *
 * A relation that is true means g > 0. It changes only when its guard has passed zero by more than the hysteresis, so
 * rounding noise of a guard that rests at zero cannot switch it. The instant located is the zero itself; a guard that
 * starts inside the hysteresis on the wrong side is located where it leaves the hysteresis. So the guard used here is
 * never zero at a restart. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "looks.h"
#include "swings.h"

enum { ENDLESS = -100 }; /* a status that no model gives */

/* Relations whose guards g are past zero by more than the hysteresis are added to flip; whether there are any. */
static bool add_changed(rt_session *s, const double *g) {
  bool any = false;
  for (int r = 0; r < s->d->n_rel; r++) {
    double held = s->data.rel[r] ? g[r] : -g[r];
    if (!(held < 0 && held < -rt_hysteresis(s, r) && rt_is_state_relation(s, r))) continue;
    s->flip[r] = any = true;
  }
  return any;
}

/* Whether one of flip has crossed. Guards that are past zero by rounding alone are none of them, whatever crosses
 * beside them. */
static bool any_crossed(const rt_session *s, const double *g) {
  for (int r = 0; r < s->d->n_rel; r++)
    if (s->flip[r] && rt_margin(s, r, g[r]) < 0) return true;
  return false;
}

/* Fraction of the bracket [a, b] at which the first guard crosses, by the secants with end values weighted by wa, wb.
 */
static double first_secant(const rt_session *s, const double *ga, double wa, const double *gb, double wb) {
  double fraction = 1;
  for (int r = 0; r < s->d->n_rel; r++) {
    double ma = wa * rt_margin(s, r, ga[r]), mb = wb * rt_margin(s, r, gb[r]);
    if (s->flip[r] && mb < 0) fraction = rt_min(fraction, rt_max(0, ma) / (rt_max(0, ma) - mb));
  }
  return fraction;
}

/* The interval in which the first crossing lies: no guard has crossed at a, one has at b. g_low and g belong to a, b.
 */
typedef struct {
  double a, b, wa, wb; /* wa, wb: weights of the end values in the secant */
  int side;            /* the end that moved last: 1 b, -1 a */
} bracket;

/* Look at t and move the end that belongs there; the value at an end that stays put twice is halved. */
static int narrow(rt_session *s, bracket *k, double t) {
  int status = rt_guards_at(s, t, s->g_trial);
  if (status) return status;
  add_changed(s, s->g_trial);
  bool crossed = any_crossed(s, s->g_trial);
  memcpy(crossed ? s->g : s->g_low, s->g_trial, (size_t)s->d->n_rel * sizeof *s->g);
  *(crossed ? &k->b : &k->a) = t;
  k->wa = crossed && k->side == 1 ? 0.5 * k->wa : 1;
  k->wb = !crossed && k->side == -1 ? 0.5 * k->wb : 1;
  k->side = crossed ? 1 : -1;
  for (int r = 0; !crossed && r < s->d->n_rel; r++)
    rt_extend_guard(s, r, fabs(s->g_trial[r]));
  return 0;
}

/* Where the polynomials of the guards say that the first of them crosses; NAN where one of them has none. */
static double foreseen(rt_session *s, double end) {
  double first = end;
  for (int r = 0; r < s->d->n_rel; r++) {
    if (!s->flip[r]) continue;
    if (!rt_is_shaped(s, r)) return NAN;
    first = rt_min(first, rt_swing_crossing(s, r, end));
  }
  return first;
}

/* Shrink the interval from the start of the step to `end` to the first crossing: Illinois variant of regula falsi on
 * the earliest crossing (Dowell & Jarratt 1971), with steps no closer to an end than half the tolerance, so that both
 * ends move in. A guard at the level of rounding gives secants that say nothing: where two of them have not halved the
 * interval, the third look is at its middle, so that 3 log2(length / tolerance) looks are always enough: the tolerance
 * has a floor, the rounding of time, or a guard that jumps right behind zero would be sought for ever. s->g belongs to
 * *crossing, the end of the interval on entry and the crossing on return. */
static int locate(rt_session *s, double *crossing) {
  bracket k = {s->t_previous, *crossing, 1, 1, 0};
  double length = k.b - k.a, tolerance, sought = foreseen(s, k.b);
  memcpy(s->g_low, s->g_previous, (size_t)s->d->n_rel * sizeof *s->g);
  memcpy(s->v_trial, s->data.v, (size_t)s->d->n_v * sizeof *s->v_trial);
  for (int i = 1; k.b - k.a > (tolerance = 1e-12 * (k.b - s->t_previous) + 0.25 * rt_smallest_step(s)); i++) {
    bool creeps = i % 3 == 0 && k.b - k.a > 0.5 * length;
    double t = k.a + (k.b - k.a) * (creeps ? 0.5 : first_secant(s, s->g_low, k.wa, s->g, k.wb));
    if (i <= 2 && !isnan(sought)) t = sought; /* then beside it */
    t = rt_min(rt_max(t, k.a + 0.5 * tolerance), k.b - 0.5 * tolerance);
    int status = narrow(s, &k, t);
    if (status) return status;
    if (i % 3 == 0) length = k.b - k.a;
  }
  *crossing = k.b;
  s->t_uncrossed = k.a;
  return 0;
}

/* To the crossing, or to just before it where the branch that is left there has no finite values any more. */
static rt_status move_back(rt_session *s, double t) {
  const mdl_descriptor *d = s->d;
  if (s->t == s->t_end) rt_keep_step_end(s);
  for (int k = 0; k < 2; k++) {
    s->t = k ? s->t_uncrossed : t;
    rt_dense_eval(&s->dense, d->n_x, s->t, s->data.x);
    if (!rt_evaluate(s) && rt_has_values(s, s->data.xdot, s->data.v)) return RT_OK;
    memcpy(s->data.v, s->v_end, (size_t)d->n_v * sizeof(double));
  }
  return rt_fail_model(s, t, "evaluating the model at an event");
}

/* Extremes of the guards. */
static void extend(rt_session *s) {
  for (int r = 0; r < s->d->n_rel; r++)
    rt_extend_guard(s, r, fabs(s->g[r]));
}

/* A guard that was thrown back and comes through again in time without having switched its
 * relation has lost an event: the last hops of its series are smaller than the hysteresis. */
static rt_status check_due_back(rt_session *s) {
  for (int r = 0; r < s->d->n_rel; r++) {
    double held = s->data.rel[r] ? s->g[r] : -s->g[r];
    if (s->due_back[r] < s->t_previous || !s->options.locate_events || held <= rt_hysteresis(s, r)) continue;
    s->due_back[r] = -INFINITY;
    return rt_fail(s, RT_CHATTERING, s->t_previous, -1, &s->d->relations[r].source,
                   "the events of this relation come faster and faster at time %.9g s (Zeno), until rounding swallows "
                   "one: give the model a mode in which it rests, for instance when the speed after the event is below "
                   "a threshold",
                   s->t_previous);
  }
  return RT_OK;
}

/* Whether no guard has come near zero in the step, nor is past it at its end. */
static bool is_calm(const rt_session *s) {
  if (!(s->shaped && s->far && s->all_affine)) return false;
  for (int r = 0; r < s->d->n_rel; r++)
    if (!(s->data.rel[r] ? s->g[r] > 0 : s->g[r] < 0) && rt_is_state_relation(s, r)) return false;
  return true;
}

/* A guard that has been zero so far has the size that it reaches in the step, where it keeps its side: beside it, what
 * the rounding of an equation makes of rest is no crossing. */
static void foresee_sizes(rt_session *s) {
  for (int r = 0; r < s->d->n_rel; r++) {
    double held = s->data.rel[r] ? s->g[r] : -s->g[r];
    if (s->g_span[r] == 0 && held > 0) s->g_span[r] = held;
  }
}

/* The first crossing in the step. Before one that the end of the step shows, other guards may have crossed twice. Each
 * pass but the first is called for by one of them: a guard that is no polynomial calls once, as it is in flip from then
 * on; of degree five, it does at its two lowest points at most. */
static int search(rt_session *s, double *crossing) {
  for (int passes = 1 + 2 * s->d->n_rel; passes >= 0; passes--) {
    if (add_changed(s, s->g)) {
      s->pending |= RT_PENDING_STATE;
      if (!s->options.locate_events) return 0;
      rt_dense_prepare(s);
      int status = locate(s, crossing);
      if (status) return status;
    }
    double inside = *crossing;
    int status = s->options.locate_events ? rt_find_swing(s, &inside) : 0;
    if (!status && s->options.locate_events && rt_may_dip(s, inside)) status = rt_find_dip(s, &inside);
    if (status || !(inside < *crossing)) return status;
    *crossing = inside;
  }
  return ENDLESS;
}

/* Guards that cross ever earlier are no functions of time and states: the first of them. */
static rt_status fail_endless(rt_session *s) {
  int r = 0;
  while (r < s->d->n_rel - 1 && !s->flip[r])
    r++;
  return rt_fail(s, RT_CHATTERING, s->t_previous, -1, &s->d->relations[r].source,
                 "what this relation compares crosses ever earlier in one step at time %.9g s: is it a function of "
                 "time and states?",
                 s->t_previous);
}

/* Where a relation has changed in the step, move its end back to the first change. */
static rt_status find_change(rt_session *s) {
  foresee_sizes(s);
  double crossing = s->t;
  if (!s->shaped) rt_swing_shape(s, NULL);
  int status = search(s, &crossing);
  if (status) return status == ENDLESS ? fail_endless(s) : rt_fail_model(s, s->t, "locating an event");
  if (!s->pending) return RT_OK;
  for (int r = 0; r < s->d->n_rel; r++)
    s->flip[r] = s->flip[r] && rt_margin(s, r, s->g[r]) < 0;
  return crossing < s->t ? move_back(s, crossing) : RT_OK;
}

/* Guards at the end of the step, and the first change of a relation in it. */
rt_status rt_find_state_event(rt_session *s) {
  const mdl_descriptor *d = s->d;
  if (!d->n_rel) return RT_OK;
  mdl_data *m = &s->data;
  double *oldest = s->g_oldest;
  s->g_oldest = s->g_before;
  s->g_before = s->g_previous;
  s->g_previous = s->g;
  s->g = oldest;
  s->result->counters.root_evaluations++;
  if (d->roots(m, s->t, m->x, m->xdot, m->v, s->g)) return rt_fail_model(s, s->t, "evaluating relations");
  rt_status status = is_calm(s) ? RT_OK : find_change(s);
  if (status) return status;
  s->t_oldest = s->t_before;
  s->t_before = s->t_previous;
  extend(s);
  return s->last_due_back < s->t_previous ? RT_OK : check_due_back(s);
}
