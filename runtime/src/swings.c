/* Guards that are affine in the states, on the polynomial of a step: they are polynomials too.
 *
 * A guard may move far less than the states that it is made of: a small swing on a large state, the difference of two
 * that drift together. The error test of a method sees the states, and takes steps in which such a guard crosses and
 * comes back as it likes. So the guards are tested too (rt_swing_error): the error of a step in a guard must be small
 * beside the guard's own swing in that step, or beside its distance from zero. And what a resolved guard does in the
 * step is sought on its polynomial, whose extremes are found for sure: between two of them it crosses once. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "polynomial.h"
#include "swings.h"

enum { MOST = RT_MOST_COEFFICIENTS };
_Static_assert(MOST == RT_DENSE_DEGREE + 1, "polynomials of guards have the degree of those of states");
static const double share = 0.01; /* error of a step in a guard, of its swing there: its extremes are known to 1 % */
static const double tenth = 0.1;  /* of that, where errors of many short steps add up */
static const double clear = 0.1;  /* or of its distance from zero: the polynomial errs by a few times the estimate */
enum { BETWEEN = 3 };
static const double between[BETWEEN] = {0.15, 0.45, 0.85}; /* of the step: nodes of no method, see `compared` */
static const double of_slope = 0.25; /* an error of x' there, times the step, makes about this error of x */

enum { PLACES = 5 };
static const double along[PLACES] = {0, 0.23, 0.48, 0.77, 1}; /* of a step: no period joins them */
static const double parabola = 0.05; /* most of |(u - a) (u - b) (u - c)| in [0, 1], of three places among those */
static const double smooth = 0.04;   /* error of the parabola, of the rates: a step is up to a quarter of a swing */

/* The guards' polynomials, from the dense output of the last step; `error` of that step, NULL: not known. Where they
 * cannot be computed, guards are looked at as those that are not affine. */
void rt_swing_shape(rt_session *s, const double *error) {
  const mdl_descriptor *d = s->d;
  s->shaped = s->far = false;
  if (!d->guard_rates || !s->options.locate_events) return;
  rt_dense_prepare(s);
  mdl_failure before = s->data.failure;
  int status = 0;
  if (error) status = d->guard_rates(&s->data, 0, error, s->shape);
  for (int k = 1; !status && k <= s->dense.degree; k++)
    status = d->guard_rates(&s->data, k == 1 ? s->dense.h : 0, s->dense.c + k * d->n_x, s->shape + k * d->n_rel);
  if (status) s->data.failure = before;
  s->shaped = !status;
  s->quiet = false;
  for (int r = 0; r < d->n_rel; r++)
    s->g_reach[r] = fabs(s->shape[d->n_rel + r]);
  for (int k = 2; k <= s->dense.degree; k++)
    for (int r = 0; r < d->n_rel; r++)
      s->g_reach[r] += fabs(s->shape[k * d->n_rel + r]);
}

/* Guard r is nowhere in the last step closer to zero than this, where its relation holds; `g` is its value at
 * t_previous. Far less work than its polynomial; -INFINITY where that is wanted all the same. */
static double least(const rt_session *s, int r, double g) {
  return s->t_previous == s->dense.t0 ? (s->data.rel[r] ? g : -g) - s->g_reach[r] : -INFINITY;
}

/* Guard r, of which s->g is at the start of the step, keeps so far away from zero that it decides nothing. */
static bool is_far(const rt_session *s, int r) {
  double distance = least(s, r, s->g[r]);
  return distance >= s->g_reach[r] && fabs(s->shape[r]) <= 0.1 * clear * distance;
}

bool rt_is_shaped(const rt_session *s, int r) {
  return s->shaped && s->d->affine_guards[r];
}

bool rt_all_affine(const mdl_descriptor *d) {
  for (int r = 0; d->affine_guards && r < d->n_rel; r++)
    if (!d->affine_guards[r] && !(d->relations[r].kind & MDL_OF_TIME)) return false;
  return d->affine_guards != NULL;
}

/* Guard r as a polynomial p [MOST] of (t - t_previous) / (to - t_previous), positive while its relation holds; `g` is
 * its value at t_previous. The degree. */
static int polynomial(const rt_session *s, int r, double g, double to, double *p) {
  int n = s->dense.degree;
  double sign = s->data.rel[r] ? 1 : -1, power = 1;
  double start = (s->t_previous - s->dense.t0) / s->dense.h, span = (to - s->t_previous) / s->dense.h;
  const double *shape = s->shape + r;
  for (int k = 1; k <= n; k++)
    p[k] = *(shape += s->d->n_rel);
  for (int i = 0; i < n && start != 0; i++)
    for (int k = n - 1; k >= (i > 0 ? i : 1); k--)
      p[k] += start * p[k + 1];
  for (int k = 1; k <= n; k++)
    p[k] *= sign * (power *= span);
  p[0] = sign * g;
  return n;
}

/* From least to most of what guard r has been in the last three steps and this one, whose bounds those are. */
static double recent(const rt_session *s, int r, double low, double high) {
  const double *earlier[] = {s->g_previous, s->g_before, s->g_oldest};
  double sign = s->data.rel[r] ? 1 : -1;
  int known = isnan(s->t_before) ? 0 : isnan(s->t_oldest) ? 1 : 3;
  for (int i = 0; i < known; i++) {
    low = rt_min(low, sign * earlier[i][r]);
    high = rt_max(high, sign * earlier[i][r]);
  }
  return high - low;
}

/* What an error of guard r in the step may be, of which p is the polynomial: a share of its swing, or of its distance
 * from zero, or the hysteresis, as what is below it is noise. *near: the guard may be about to cross. */
static double allowed(const rt_session *s, int r, int n, const double *p, bool *near) {
  double low, high;
  rt_enclose(n, p, &low, &high);
  *near = low < high - low + fabs(s->shape[r]) / clear;
  double swing = s->method->multistep ? tenth * recent(s, r, low, high) : high - low;
  return rt_max(rt_max(share * swing, clear * low), rt_max(rt_max(rt_hysteresis(s, r), s->g_floor[r]), DBL_MIN));
}

/* What the least tolerances of the states leave of the guards: no step is asked to be more exact. A guard that rises
 * from zero as a power of time bends alike in every step, however small: only this ends it. Two weightings, as what
 * one leaves of a sum may cancel. */
static bool set_floors(rt_session *s) {
  double *size = s->x_trial, *reach = s->g_trial;
  for (int weighting = 1; weighting <= 2; weighting++) {
    for (int i = 0; i < s->d->n_x; i++)
      size[i] = RT_ROUNDING * s->nominal[i] * (1.5 + cos(weighting * (i + 1)));
    if (s->d->guard_rates(&s->data, 0, size, reach)) return false;
    for (int r = 0; r < s->d->n_rel; r++)
      s->g_floor[r] = rt_max(s->g_floor[r], fabs(reach[r]));
  }
  return true;
}

/* The error estimate of the step to `to`, over what it may be, of the guard for which that is most; *near: one is. Its
 * polynomial and its bound are kept. */
static double estimated(rt_session *s, double to, bool *near) {
  double largest = 0;
  *near = false;
  s->quiet = s->t_previous == s->dense.t0;
  for (int r = 0; r < s->d->n_rel; r++) {
    s->bound[r] = 0;
    if (!s->d->affine_guards[r] || is_far(s, r)) continue;
    bool here;
    double *p = s->swing + r * MOST, bound = allowed(s, r, polynomial(s, r, s->g[r], to, p), p, &here);
    largest = rt_max(largest, fabs(s->shape[r]) / bound);
    if (here) s->bound[r] = bound;
    *near |= here;
    s->quiet &= least(s, r, s->g[r]) >= 0;
  }
  return largest;
}

/* An estimate may vanish by chance, of a swing that the step passes over above all. So where a guard is near, what its
 * polynomial does is compared with what the equations say, at places where the method has not looked. Two of them may
 * both be extremes of the error: of steps of dopri5 up to two periods of a sine, at all phases, two let an error of
 * 0.57 amplitudes pass, these three one of 0.027 at most. */
static double compared(rt_session *s, double to) {
  const mdl_descriptor *d = s->d;
  double largest = 0, h = to - s->t_previous;
  if (!rt_look_along(s, to, between, BETWEEN)) return INFINITY;
  for (int r = 0; r < d->n_rel; r++) {
    const double *p = s->swing + r * MOST, sign = s->data.rel[r] ? 1 : -1;
    for (int i = 0; i < BETWEEN && s->bound[r] > 0; i++) {
      double slope = 0;
      for (int k = s->dense.degree; k > 0; k--)
        slope = slope * between[i] + k * p[k];
      largest = rt_max(largest, of_slope * fabs(slope - h * sign * s->rates[i * d->n_rel + r]) / s->bound[r]);
    }
  }
  return largest;
}

/* Largest of the divided differences of order k of f, of which those of order k - 1 are given. */
static double difference(int k, double *f) {
  double most = 0;
  for (int i = 0; i + k < PLACES; i++) {
    f[i] = (f[i + 1] - f[i]) / (along[i + k] - along[i]);
    most = rt_max(most, fabs(f[i]));
  }
  return most;
}

/* Of guard r in a first step, from its rates along it: they must be a parabola nearly, so that the step is none of its
 * whole swings; and the error must be small beside the swing that such a bend of the rates is the beginning of. */
static double rough(const rt_session *s, int r, double to) {
  double f[PLACES], bound = s->bound[r], most = 0, h = to - s->t_previous;
  for (int i = 0; i < PLACES; i++) {
    f[i] = s->rates[i * s->d->n_rel + r];
    most = rt_max(most, fabs(f[i]));
  }
  difference(1, f);
  double bend = difference(2, f), off = parabola * difference(3, f);
  double swing = bend > 0 ? h * most * sqrt(most / (2 * bend)) : INFINITY; /* of rates most cos(t / T) */
  return rt_max(off * h / rt_max(bound, smooth * most * h), fabs(s->shape[r]) / rt_max(bound, share * swing));
}

/* The shape of the last step, as far as it is wanted; whether guards come near zero in it, or may. */
static bool come_near(rt_session *s, const double *error) {
  s->far = s->options.locate_events && rt_keep_away(s, error, 0.1 * clear);
  s->shaped = s->far;
  if (!s->far) rt_swing_shape(s, error);
  return s->shaped && !s->far;
}

static double excess(rt_session *s, double to) {
  bool near;
  double largest = estimated(s, to, &near);
  return near && largest <= 1 ? rt_max(largest, compared(s, to)) : largest;
}

static double roughness(rt_session *s, double to) {
  bool near;
  if (!(estimated(s, to, &near) >= 0 && near)) return 0;
  if (!rt_look_along(s, to, along, PLACES)) return INFINITY;
  double largest = 0;
  for (int r = 0; r < s->d->n_rel; r++)
    if (s->bound[r] > 0) largest = rt_max(largest, rough(s, r, to));
  return largest;
}

/* By a test that says how much too large a step is; beyond 1 it is asked again without what is below the floors. */
static double tested(rt_session *s, double to, const double *error, double (*test)(rt_session *, double)) {
  if (!come_near(s, error)) return 0;
  memset(s->g_floor, 0, (size_t)s->d->n_rel * sizeof *s->g_floor);
  double largest = test(s, to);
  return largest > 1 && set_floors(s) ? test(s, to) : largest;
}

/* How much too large the step from t_previous to `to` is for the guards, where its error in the states is known: up to
 * 1 it is not. s->g belongs to its start. */
double rt_swing_error(rt_session *s, double to, const double *error) {
  return tested(s, to, error, excess);
}

/* The same of the first steps of a method of rising order, whose polynomials are straight lines as yet, and err by as
 * much as what they begin with: the rates of the guards that are near must be smooth, so that the step is none of their
 * whole swings. */
double rt_swing_roughness(rt_session *s, double to, const double *error) {
  return tested(s, to, error, roughness);
}

/* No tolerance is small enough for a guard: the one that the step to `to` errs in by most. */
rt_status rt_swing_fail(rt_session *s, double to) {
  int worst = 0;
  double most = 0, p[MOST];
  for (int r = 0; r < s->d->n_rel; r++) {
    if (!rt_is_shaped(s, r)) continue;
    bool near;
    double bound = allowed(s, r, polynomial(s, r, s->g[r], to, p), p, &near),
           error = near ? fabs(s->shape[r]) / bound : 0;
    if (error >= most) worst = r, most = error;
  }
  return rt_fail(
      s, RT_STEP_COLLAPSE, s->t, -1, &s->d->relations[worst].source,
      "solver %s cannot resolve what this relation compares at time %.9g s: it swings by less than rounding leaves "
      "of the states",
      s->method->name, s->t);
}

/* Where guard r is first at an extreme that lies past zero by more than the hysteresis, up to `to`, or there; `to`
 * where it is not. */
static double first_bottom(rt_session *s, int r, double to) {
  if (least(s, r, s->g_previous[r]) >= 0) return to;
  double p[MOST], place[MOST], low, high, eps = rt_hysteresis(s, r);
  int n = polynomial(s, r, s->g_previous[r], to, p);
  if (rt_floor_of(n, p) >= -eps) return to;
  rt_enclose(n, p, &low, &high);
  if (low >= -eps) return to;
  int count = rt_extremes(n, p, place);
  for (int i = 0; i < count; i++) {
    double value = rt_horner(n, p, place[i]);
    if (value < -eps) return s->t_previous + place[i] * (to - s->t_previous);
    rt_extend_guard(s, r, value);
  }
  return to;
}

/* The first crossing of guard r, which is past zero at `to`; how far it went before counts as its travel. */
double rt_swing_crossing(rt_session *s, int r, double to) {
  double p[MOST], root[MOST], place[MOST];
  if (s->far) rt_swing_shape(s, NULL);
  int n = polynomial(s, r, s->g_previous[r], to, p), count = rt_extremes(n, p, place);
  p[0] = rt_margin(s, r, s->g_previous[r]);
  double first = rt_roots_between(n, p, count, place, root) ? root[0] : 1;
  for (int i = 0; i < count && place[i] < first; i++)
    rt_extend_guard(s, r, rt_horner(n, p, place[i]));
  return s->t_previous + first * (to - s->t_previous);
}

/* Look in the step up to *inside for guards that cross and come back, or cross before they do at its end. Where there
 * is one s->g belongs to *inside, where it is past zero; otherwise *inside stays as it is. */
int rt_find_swing(rt_session *s, double *inside) {
  if (!s->shaped || s->far || (s->quiet && s->t_previous == s->dense.t0)) return 0;
  memcpy(s->v_trial, s->data.v, (size_t)s->d->n_v * sizeof *s->v_trial);
  for (int r = 0; r < s->d->n_rel; r++) {
    if (!s->d->affine_guards[r]) continue;
    double bottom = first_bottom(s, r, *inside);
    if (!(bottom < *inside && bottom > s->t_previous)) continue;
    int status = rt_guards_at(s, bottom, s->g_trial);
    if (status) return status;
    if ((s->data.rel[r] ? s->g_trial[r] : -s->g_trial[r]) >= -rt_hysteresis(s, r)) continue;
    *inside = bottom;
    memcpy(s->g, s->g_trial, (size_t)s->d->n_rel * sizeof *s->g);
  }
  return 0;
}
