/* State events: which relations have changed at the end of a step, and when the first of them did.
 *
 * A relation that is true means g > 0. It changes only when its guard has passed zero by more than the hysteresis, so
 * rounding noise of a guard that rests at zero cannot switch it. The instant located is the zero itself; a guard that
 * starts inside the hysteresis on the wrong side is located where it leaves the hysteresis. So the guard used here is
 * never zero at a restart. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "session.h"

static const double VISIBLE_DIP = 1e-3; /* of the hysteresis: more than rounding */

/* In the unit of the guard. 1e-10 is far above rounding of operands of 1e4 and far below any physical play; the second
 * part covers guards that run over a larger range. */
double rt_hysteresis(const rt_session *s, int r) {
  return 1e-10 + 1e-12 * s->g_span[r];
}

/* Positive while relation r keeps its value. */
static double margin(const rt_session *s, int r, double g) {
  bool holds = s->data.rel[r];
  double at_start = holds ? s->g_previous[r] : -s->g_previous[r];
  return (holds ? g : -g) + (at_start > 0 ? 0 : rt_hysteresis(s, r));
}

static bool is_state_relation(const rt_session *s, int r) {
  return !s->d->relations[r].is_time;
}

static bool any_changed(const rt_session *s) {
  for (int r = 0; r < s->d->n_rel; r++)
    if (is_state_relation(s, r) && (s->data.rel[r] ? s->g[r] : -s->g[r]) < -rt_hysteresis(s, r)) return true;
  return false;
}

static bool any_negative(const rt_session *s, const double *g) {
  for (int r = 0; r < s->d->n_rel; r++)
    if (is_state_relation(s, r) && margin(s, r, g[r]) < 0) return true;
  return false;
}

static int guards_at(rt_session *s, double t, double *g) {
  rt_dense_eval(&s->dense, s->d->n_x, t, s->x_trial);
  int status = rt_rhs(s, t, s->x_trial, s->xdot_trial, s->v_trial);
  s->result->counters.root_evaluations++;
  return status ? status : s->d->roots(&s->data, t, s->x_trial, s->xdot_trial, s->v_trial, g);
}

/* Fraction of the bracket [a, b] at which the first guard crosses, by the secants with end values weighted by wa, wb.
 */
static double first_secant(const rt_session *s, const double *ga, double wa, const double *gb, double wb) {
  double fraction = 1;
  for (int r = 0; r < s->d->n_rel; r++) {
    double ma = wa * margin(s, r, ga[r]), mb = wb * margin(s, r, gb[r]);
    if (is_state_relation(s, r) && mb < 0) fraction = rt_min(fraction, rt_max(0, ma) / (rt_max(0, ma) - mb));
  }
  return fraction;
}

/* Smallest value on [0, 1] of the parabola through (0, a), (1, b) with second derivative c, and where it is. */
static double lowest(double a, double b, double c, double *where) {
  double slope = b - a - 0.5 * c;
  *where = c > 0 ? rt_min(1, rt_max(0, -slope / c)) : a < b ? 0 : 1;
  return a + *where * (slope + 0.5 * c * *where);
}

/* Could a guard have crossed twice inside the step? Judged by the parabola through the last three points with four
 * times its curvature; there is no third point after a restart, so then it could. */
static bool may_dip(const rt_session *s) {
  if (isnan(s->t_before)) return true;
  double h = s->t - s->t_previous, before = s->t_previous - s->t_before, where;
  double weight = 2 * h / (h + before), back = weight * h / before;
  for (int r = 0; r < s->d->n_rel; r++) {
    double sign = s->data.rel[r] ? 1 : -1, a = sign * s->g_previous[r], b = sign * s->g[r];
    double c = weight * (b - a) - back * (a - sign * s->g_before[r]);
    double least = a < b ? a : b;
    if (c > 1.5 * least && c > 0 && is_state_relation(s, r) && lowest(a, b, 4 * c, &where) < 0.25 * least) return true;
  }
  return false;
}

/* Look inside the step for a guard that crossed twice: at the middle, then at the bottom of each parabola through three
 * points. Where one is found s->g belongs to *inside, otherwise *inside stays as it is. */
static int find_dip(rt_session *s, double *inside) {
  double h = s->t - s->t_previous, where;
  rt_dense_prepare(s);
  memcpy(s->v_trial, s->data.v, (size_t)s->d->n_v * sizeof *s->v_trial);
  int status = guards_at(s, s->t_previous + 0.5 * h, s->g_low);
  for (int r = 0; !status && r < s->d->n_rel; r++) {
    if (!is_state_relation(s, r)) continue;
    double sign = s->data.rel[r] ? 1 : -1, a = sign * s->g_previous[r], middle = sign * s->g_low[r], b = sign * s->g[r];
    double eps = rt_hysteresis(s, r), noticeable = s->rebound[r] ? VISIBLE_DIP * eps : eps;
    if (lowest(a, b, 4 * (a - 2 * middle + b), &where) >= -noticeable || where <= 0 || where >= 1) continue;
    status = guards_at(s, s->t_previous + where * h, s->g_trial);
    if (status) break;
    s->g_lowest[r] = rt_min(s->g_lowest[r], sign * s->g_trial[r]);
    if (sign * s->g_trial[r] >= -eps) continue;
    *inside = s->t_previous + where * h;
    memcpy(s->g, s->g_trial, (size_t)s->d->n_rel * sizeof *s->g);
    return 0;
  }
  return status;
}

/* The interval in which the first crossing lies: no guard has crossed at a, one has at b. g_low and g belong to a, b.
 */
typedef struct {
  double a, b, wa, wb; /* wa, wb: weights of the end values in the secant */
  int side;            /* the end that moved last: 1 b, -1 a */
} bracket;

/* Look at t and move the end that belongs there; the value at an end that stays put twice is halved. */
static int narrow(rt_session *s, bracket *k, double t) {
  int status = guards_at(s, t, s->g_trial);
  if (status) return status;
  bool crossed = any_negative(s, s->g_trial);
  memcpy(crossed ? s->g : s->g_low, s->g_trial, (size_t)s->d->n_rel * sizeof *s->g);
  *(crossed ? &k->b : &k->a) = t;
  k->wa = crossed && k->side == 1 ? 0.5 * k->wa : 1;
  k->wb = !crossed && k->side == -1 ? 0.5 * k->wb : 1;
  k->side = crossed ? 1 : -1;
  return 0;
}

/* Shrink the interval from the start of the step to `end` to the first crossing: Illinois variant of regula falsi on
 * the earliest crossing (Dowell & Jarratt 1971), with steps no closer to an end than half the tolerance, so that both
 * ends move in. A guard at the level of rounding gives secants that say nothing: where two of them have not halved the
 * interval, the third look is at its middle, so that 3 log2(length / tolerance) looks are always enough. s->g belongs
 * to *crossing, the end of the interval on entry and the crossing on return. */
static int locate(rt_session *s, double *crossing) {
  bracket k = {s->t_previous, *crossing, 1, 1, 0};
  double tolerance = 1e-12 * (k.b - k.a) + 4 * DBL_EPSILON * fabs(k.b), length = k.b - k.a;
  memcpy(s->g_low, s->g_previous, (size_t)s->d->n_rel * sizeof *s->g);
  memcpy(s->v_trial, s->data.v, (size_t)s->d->n_v * sizeof *s->v_trial);
  for (int i = 1; k.b - k.a > tolerance; i++) {
    bool creeps = i % 3 == 0 && k.b - k.a > 0.5 * length;
    double t = k.a + (k.b - k.a) * (creeps ? 0.5 : first_secant(s, s->g_low, k.wa, s->g, k.wb));
    t = rt_min(rt_max(t, k.a + 0.5 * tolerance), k.b - 0.5 * tolerance);
    int status = narrow(s, &k, t);
    if (status) return status;
    if (i % 3 == 0) length = k.b - k.a;
  }
  *crossing = k.b;
  return 0;
}

static rt_status move_back(rt_session *s, double t) {
  const mdl_descriptor *d = s->d;
  memcpy(s->x_end, s->data.x, (size_t)d->n_x * sizeof(double));
  memcpy(s->xdot_end, s->data.xdot, (size_t)d->n_x * sizeof(double));
  memcpy(s->v_end, s->data.v, (size_t)d->n_v * sizeof(double));
  s->t = t;
  rt_dense_eval(&s->dense, d->n_x, t, s->data.x);
  return rt_evaluate(s) ? rt_fail_model(s, t, "evaluating the model at an event") : RT_OK;
}

/* Go on to the end of the step that an event without consequences cut short. */
void rt_resume_step(rt_session *s) {
  const mdl_descriptor *d = s->d;
  s->resume = false;
  s->t = s->t_end;
  memcpy(s->data.x, s->x_end, (size_t)d->n_x * sizeof(double));
  memcpy(s->data.xdot, s->xdot_end, (size_t)d->n_x * sizeof(double));
  memcpy(s->data.v, s->v_end, (size_t)d->n_v * sizeof(double));
}

/* Extremes of the guards. A guard that was thrown back by reinit, dipped to the other side by less than the hysteresis
 * and comes through again has lost an event to rounding: the events of its relation were piling up. */
static rt_status follow(rt_session *s) {
  for (int r = 0; r < s->d->n_rel; r++) {
    double size = fabs(s->g[r]), held = s->data.rel[r] ? s->g[r] : -s->g[r];
    if (size > s->g_span[r]) s->g_span[r] = size;
    if (size > s->g_travel[r]) s->g_travel[r] = size;
    if (!s->rebound[r] || !s->options.locate_events) continue;
    double eps = rt_hysteresis(s, r);
    s->g_lowest[r] = rt_min(s->g_lowest[r], held);
    if (held <= eps) continue;
    s->rebound[r] = 0;
    if (s->g_lowest[r] < -VISIBLE_DIP * eps)
      return rt_fail(
          s, RT_CHATTERING, s->t_previous, -1, &s->d->relations[r].source,
          "chattering: the events of this relation come faster and faster at time %.9g s, until rounding swallows one",
          s->t_previous);
  }
  return RT_OK;
}

static int search(rt_session *s, double *crossing) {
  bool located = s->options.locate_events, changed = any_changed(s);
  int status = 0;
  if (!changed && located && may_dip(s)) {
    status = find_dip(s, crossing);
    changed = *crossing < s->t;
  }
  if (!changed) return status;
  s->pending |= RT_PENDING_STATE;
  if (!located) return 0;
  rt_dense_prepare(s);
  return locate(s, crossing);
}

/* Guards at the end of the step; where a relation has changed, move the end of the step back to the first change. */
rt_status rt_find_state_event(rt_session *s) {
  const mdl_descriptor *d = s->d;
  if (!d->n_rel) return RT_OK;
  mdl_data *m = &s->data;
  double *oldest = s->g_before;
  s->g_before = s->g_previous;
  s->g_previous = s->g;
  s->g = oldest;
  s->result->counters.root_evaluations++;
  if (d->roots(m, s->t, m->x, m->xdot, m->v, s->g)) return rt_fail_model(s, s->t, "evaluating relations");
  double crossing = s->t;
  if (search(s, &crossing)) return rt_fail_model(s, s->t, "locating an event");
  if (s->pending) {
    for (int r = 0; r < d->n_rel; r++)
      s->flip[r] = is_state_relation(s, r) && margin(s, r, s->g[r]) < 0;
    if (crossing < s->t && move_back(s, crossing)) return s->failure.status;
  }
  s->t_before = s->t_previous;
  return follow(s);
}
