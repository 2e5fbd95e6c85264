/* Guards that cross twice inside a step, of those that are no polynomials: what the ends of the step do not show. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "swings.h"

/* Smallest value on [0, 1] of the parabola through (0, a), (1, b) with second derivative c, and where it is. */
static double lowest(double a, double b, double c, double *where) {
  double slope = b - a - 0.5 * c;
  *where = c > 0 ? rt_min(1, rt_max(0, -slope / c)) : a < b ? 0 : 1;
  return a + *where * (slope + 0.5 * c * *where);
}

/* What tells curvatures, as h^2 times the second derivative, of the last three steps: by the differences of a guard. */
typedef struct {
  double ahead, back; /* now: of this step's and the last one's */
  double late, early; /* a step earlier: of the last one's and the one before it; 0: not known */
} weights;

static weights weigh(const rt_session *s, double h) {
  double before = s->t_previous - s->t_before, ahead = 2 * h / (h + before);
  weights w = {.ahead = ahead, .back = ahead * h / before};
  if (isnan(s->t_oldest)) return w;
  double early = s->t_before - s->t_oldest, scale = 2 * h * h / (before + early);
  w.late = scale / before;
  w.early = scale / early;
  return w;
}

/* Could a guard have crossed twice in the step up to `end`, besides those that cross there? Judged by the parabola
 * through the last three points with four times its curvature, or what that has changed by since the step before; there
 * is no third point after a restart, so then it could. */
bool rt_may_dip(const rt_session *s, double end) {
  if (s->shaped && s->all_affine) return false;
  if (isnan(s->t_before)) return true;
  const weights w = weigh(s, end - s->t_previous);
  double where;
  for (int r = 0; r < s->d->n_rel; r++) {
    if (s->flip[r] || rt_is_shaped(s, r)) continue;
    double sign = s->data.rel[r] ? 1 : -1, a = sign * s->g_previous[r], b = sign * s->g[r];
    double step = a - sign * s->g_before[r], c = w.ahead * (b - a) - w.back * step;
    if (w.late > 0) c = rt_max(c, fabs(c - w.late * step + w.early * sign * (s->g_before[r] - s->g_oldest[r])));
    double least = a < b ? a : b;
    if (c > 1.5 * least && c > 0 && rt_is_state_relation(s, r) && lowest(a, b, 4 * c, &where) < 0.25 * least)
      return true;
  }
  return false;
}

/* The return of a guard that an event has thrown back: it lies anywhere from the start of the step on, so the step is
 * halved towards its start until the guard is on the other side. */
static int find_return(rt_session *s, double *inside) {
  double h = *inside - s->t_previous, least = rt_smallest_step(s);
  for (int r = 0; r < s->d->n_rel; r++) {
    if (s->due_back[r] < s->t_previous || s->flip[r] || rt_is_shaped(s, r)) continue;
    double sign = s->data.rel[r] ? 1 : -1;
    double part = h;
    while ((part *= 0.5) > least) {
      int status = rt_guards_at(s, s->t_previous + part, s->g_trial);
      if (status) return status;
      if (sign * s->g_trial[r] >= -rt_hysteresis(s, r)) continue;
      *inside = s->t_previous + part;
      memcpy(s->g, s->g_trial, (size_t)s->d->n_rel * sizeof *s->g);
      return 0;
    }
  }
  return 0;
}

/* What a guard is at three places of a step, u in [0, 1]: between the outer two it may be below zero. */
typedef struct {
  double u[3], g[3];
} bracket;

/* Could it be, judged by the parabola through the three with four times its curvature; *bottom: where that through them
 * is lowest. */
static bool may_cross(const bracket *b, double eps, double *bottom) {
  double span = b->u[2] - b->u[0], where;
  double left = (b->g[1] - b->g[0]) / (b->u[1] - b->u[0]), right = (b->g[2] - b->g[1]) / (b->u[2] - b->u[1]);
  double curvature = 2 * (right - left) * span;
  lowest(b->g[0], b->g[2], curvature, bottom);
  *bottom = b->u[0] + *bottom * span;
  return lowest(b->g[0], b->g[2], 4 * curvature, &where) < -eps && where > 0 && where < 1;
}

static const double new_place = 1e-3; /* of a bracket: rounding weighs on the slopes between places that are nearer */
enum { CREEP = 3 }; /* of so many places one halves, so that a bracket shrinks where parabolas creep */

/* The next place to look at: the bottom of the parabola, where it is one between the outer two that says something
 * new, else the middle of the longer part. */
static double next_place(const bracket *b, double bottom, bool halve) {
  double least = new_place * (b->u[2] - b->u[0]);
  bool is_new = bottom > b->u[0] + least && bottom < b->u[2] - least && fabs(bottom - b->u[1]) > least;
  if (is_new && !halve && b->g[1] <= b->g[0] && b->g[1] <= b->g[2]) return bottom;
  bool first = b->u[1] - b->u[0] > b->u[2] - b->u[1];
  return 0.5 * (b->u[1] + b->u[first ? 0 : 2]);
}

/* The three places among four that stand about the lowest. */
static void narrow(bracket *b, double u, double g) {
  bool left = u < b->u[1];
  double first = left ? rt_min(b->g[0], g) : rt_min(b->g[0], b->g[1]);
  double last = left ? rt_min(b->g[1], b->g[2]) : rt_min(g, b->g[2]);
  const bracket was = *b;
  if (left && first <= last)
    *b = (bracket){{was.u[0], u, was.u[1]}, {was.g[0], g, was.g[1]}};
  else if (left)
    b->u[0] = u, b->g[0] = g;
  else if (first <= last)
    b->u[2] = u, b->g[2] = g;
  else
    *b = (bracket){{was.u[1], u, was.u[2]}, {was.g[1], g, was.g[2]}};
}

/* Where in the step up to `end` guard r, of which the three are known, is on the other side: *where, 0: nowhere. What
 * is too short for time to tell is no dip. */
static int bottom_of(rt_session *s, int r, double end, bracket *b, double *where) {
  double h = end - s->t_previous, sign = s->data.rel[r] ? 1 : -1, eps = rt_hysteresis(s, r), bottom;
  *where = 0;
  for (int pass = 1; may_cross(b, eps, &bottom) && (b->u[2] - b->u[0]) * h > rt_smallest_step(s); pass++) {
    double u = next_place(b, bottom, pass % CREEP == 0);
    int status = rt_guards_at(s, s->t_previous + u * h, s->g_trial);
    if (status) return status;
    double g = sign * s->g_trial[r];
    if (g < -eps) {
      *where = u;
      return 0;
    }
    narrow(b, u, g);
  }
  return 0;
}

/* Look in the step up to *inside for a guard that crossed twice: at the middle, then at the bottom of parabolas. Where
 * one is found s->g belongs to *inside, otherwise *inside stays as it is. */
int rt_find_dip(rt_session *s, double *inside) {
  double end = *inside, h = end - s->t_previous, where;
  rt_dense_prepare(s);
  memcpy(s->v_trial, s->data.v, (size_t)s->d->n_v * sizeof *s->v_trial);
  int status = find_return(s, inside);
  if (status || *inside < end) return status;
  status = rt_guards_at(s, s->t_previous + 0.5 * h, s->g_low);
  for (int r = 0; !status && r < s->d->n_rel; r++) {
    if (!rt_is_state_relation(s, r) || s->flip[r] || rt_is_shaped(s, r)) continue;
    double sign = s->data.rel[r] ? 1 : -1, middle = sign * s->g_low[r];
    bracket b = {{0, 0.5, 1}, {sign * s->g_previous[r], middle, sign * s->g[r]}};
    if (middle > 0) rt_extend_guard(s, r, middle);
    bool at_middle = middle < -rt_hysteresis(s, r);
    where = 0.5;
    if (!at_middle) status = bottom_of(s, r, end, &b, &where);
    if (status || where == 0) continue;
    *inside = s->t_previous + where * h;
    memcpy(s->g, at_middle ? s->g_low : s->g_trial, (size_t)s->d->n_rel * sizeof *s->g);
    return 0;
  }
  return status;
}

/* Guards a little after the event, as they set off: in g_trial. */
static int look_ahead(rt_session *s, double since) {
  const mdl_descriptor *d = s->d;
  double t = s->t + rt_max(1e-3 * since, rt_smallest_step(s));
  for (int i = 0; i < d->n_x; i++)
    s->x_trial[i] = s->data.x[i] + (t - s->t) * s->data.xdot[i];
  memcpy(s->v_trial, s->data.v, (size_t)d->n_v * sizeof *s->v_trial);
  int status = rt_rhs(s, t, s->x_trial, s->xdot_trial, s->v_trial);
  return status ? status : d->roots(&s->data, t, s->x_trial, s->xdot_trial, s->v_trial, s->g_trial);
}

/* Relation r has just switched; does its guard set off for the side that it came from? It rests at zero, or where it
 * left the hysteresis, and moves by more than rounding, which is a millionth of the hysteresis. */
static bool is_thrown_back(const rt_session *s, int r) {
  double sign = s->data.rel[r] ? 1 : -1, eps = rt_hysteresis(s, r);
  return fabs(s->g[r]) <= 2 * eps && sign * (s->g_trial[r] - s->g[r]) < -1e-5 * eps;
}

/* Relations that the event has switched, and those among them that must switch back.
 *
 * Events pile up (Zeno) where a reinit throws the guard that called it back, each time for a shorter while: intervals
 * that shrink like a geometric series have a finite sum, behind which time does not get, and the way of the guard
 * shrinks with them until it is lost in the hysteresis. So a guard is watched if its own relation switched here, if a
 * reinit has turned it round, and for as long as the interval between this switch and the last one the same way: a
 * guard that stays away for longer does not belong to such a series. A relation that switches at a steady rate, that an
 * event switches with others, or whose guard is at rest but for rounding, loses nothing when it stays as it is. */
int rt_follow_switches(rt_session *s, double since) {
  bool thrown = s->reinitialised && s->pending & RT_PENDING_STATE, looked = false;
  for (int r = 0; r < s->d->n_rel; r++) {
    int now = s->data.rel[r];
    if (s->flip[r]) s->due_back[r] = -INFINITY; /* it has switched, even where the event has taken that back */
    if (now == s->rel_before[r] || !rt_is_state_relation(s, r)) continue;
    double interval = s->t - s->changed_at[now][r];
    s->changed_at[now][r] = s->t;
    s->due_back[r] = -INFINITY;
    if (!thrown) continue;
    int status = looked ? 0 : look_ahead(s, since);
    if (status) return status;
    looked = true;
    if (!is_thrown_back(s, r)) continue;
    s->due_back[r] = s->t + interval;
    s->last_due_back = rt_max(s->last_due_back, s->due_back[r]);
  }
  return 0;
}
