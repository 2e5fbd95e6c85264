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

#include "swings.h"

enum { MOST = RT_DENSE_DEGREE + 1 };
static const double share = 0.01; /* error of a step in a guard, of its swing there: its extremes are known to 1 % */
static const double clear = 0.1;  /* or of its distance from zero: the polynomial errs by a few times the estimate */
static const double between[] = {0.36,
                                 0.68}; /* of the step: no nodes of a method, and no two that a period could join */
static const double of_slope = 0.25;    /* an error of x' there, times the step, makes about this error of x */

/* The guards' polynomials, from the dense output of the last step; `error` of that step, NULL: not known. Where they
 * cannot be computed, guards are looked at as those that are not affine. */
void rt_swing_shape(rt_session *s, const double *error) {
  const mdl_descriptor *d = s->d;
  s->shaped = false;
  if (!d->guard_rates || !s->options.locate_events) return;
  rt_dense_prepare(s);
  mdl_failure before = s->data.failure;
  int status = 0;
  memset(s->shape, 0, (size_t)d->n_rel * sizeof *s->shape);
  if (error) status = d->guard_rates(&s->data, 0, error, s->shape);
  for (int k = 1; !status && k <= s->dense.degree; k++)
    status = d->guard_rates(&s->data, k == 1 ? s->dense.h : 0, s->dense.c + k * d->n_x, s->shape + k * d->n_rel);
  if (status) s->data.failure = before;
  s->shaped = !status;
}

bool rt_is_shaped(const rt_session *s, int r) {
  return s->shaped && s->d->affine_guards[r];
}

bool rt_all_shaped(const rt_session *s) {
  for (int r = 0; s->shaped && r < s->d->n_rel; r++)
    if (!s->d->affine_guards[r] && rt_is_state_relation(s, r)) return false;
  return s->shaped;
}

/* Guard r as a polynomial p [MOST] of (t - t_previous) / (to - t_previous), positive while its relation holds; `g` is
 * its value at t_previous. The degree. */
static int polynomial(const rt_session *s, int r, double g, double to, double *p) {
  int n = s->dense.degree;
  double sign = s->data.rel[r] ? 1 : -1, power = 1;
  double start = (s->t_previous - s->dense.t0) / s->dense.h, span = (to - s->t_previous) / s->dense.h;
  for (int k = 1; k <= n; k++)
    p[k] = sign * s->shape[k * s->d->n_rel + r];
  for (int i = 0; i < n && start != 0; i++)
    for (int k = n - 1; k >= (i > 0 ? i : 1); k--)
      p[k] += start * p[k + 1];
  for (int k = 1; k <= n; k++)
    p[k] *= power *= span;
  p[0] = sign * g;
  return n;
}

static double horner(int n, const double *p, double x) {
  double sum = p[n];
  for (int k = n - 1; k >= 0; k--)
    sum = sum * x + p[k];
  return sum;
}

/* No value of p on [0, 1] is less than this. */
static double floor_of(int n, const double *p) {
  double sum = p[0];
  for (int k = 1; k <= n; k++)
    sum += rt_min(p[k], 0);
  return sum;
}

/* No two values of p on [0, 1] are further apart. */
static double spread(int n, const double *p) {
  double sum = 0;
  for (int k = 1; k <= n; k++)
    sum += fabs(p[k]);
  return sum;
}

/* Between *low and *high are the values of p on [0, 1]: its coefficients in the basis of Bernstein. */
static void enclose(int n, const double *p, double *low, double *high) {
  double b[MOST] = {p[0]}, choose = 1;
  for (int k = 0; k <= n; k++) {
    b[k] = p[k] / choose;
    choose *= (double)(n - k) / (k + 1);
  }
  for (int i = 1; i <= n; i++)
    for (int k = n; k >= i; k--)
      b[k] += b[k - 1];
  *low = *high = b[0];
  for (int k = 1; k <= n; k++) {
    *low = rt_min(*low, b[k]);
    *high = rt_max(*high, b[k]);
  }
}

/* The root of p between a and b in [0, 1], where its sign is another one: halved until it is as long as rounding, which
 * are 52 rounds. */
static double root_between(int n, const double *p, double a, double b) {
  bool negative = horner(n, p, a) < 0;
  while (b - a > DBL_EPSILON) {
    double middle = 0.5 * (a + b);
    *((horner(n, p, middle) < 0) == negative ? &a : &b) = middle;
  }
  return b;
}

/* Where p changes its sign in (0, 1), in rising order: between two places where its derivative does, it is monotone. */
static int roots_of(int n, const double *p, double *root) {
  double slope[MOST], turn[MOST], a = 0;
  int turns = 0, found = 0;
  for (int k = 1; k <= n; k++)
    slope[k - 1] = k * p[k];
  if (n > 1) turns = roots_of(n - 1, slope, turn);
  bool negative = p[0] < 0;
  for (int i = 0; i <= turns; i++) {
    double b = i < turns ? turn[i] : 1;
    if ((horner(n, p, b) < 0) != negative) {
      root[found++] = root_between(n, p, a, b);
      negative = !negative;
    }
    a = b;
  }
  return found;
}

static int extremes(int n, const double *p, double *place) {
  double slope[MOST];
  for (int k = 1; k <= n; k++)
    slope[k - 1] = k * p[k];
  return n > 1 ? roots_of(n - 1, slope, place) : 0;
}

/* What an error of guard r in the step may be, of which p is the polynomial: a share of its swing, or of its distance
 * from zero, or the hysteresis, as what is below it is noise. *near: the guard may be about to cross. */
static double allowed(const rt_session *s, int r, int n, const double *p, bool *near) {
  double low, high;
  enclose(n, p, &low, &high);
  *near = low < high - low;
  return rt_max(rt_max(share * (high - low), clear * low), rt_max(rt_hysteresis(s, r), DBL_MIN));
}

/* The error estimate of the step to `to`, over what it may be, of the guard for which that is most; *near: one is. */
static double estimated(const rt_session *s, double to, bool *near) {
  double largest = 0, p[MOST];
  *near = false;
  for (int r = 0; r < s->d->n_rel; r++) {
    if (!s->d->affine_guards[r]) continue;
    int n = polynomial(s, r, s->g[r], to, p);
    double error = fabs(s->shape[r]), distance = floor_of(n, p), bound = clear * distance;
    bool here = false;
    if (!(distance > spread(n, p) && error <= 0.1 * bound)) bound = allowed(s, r, n, p, &here);
    largest = rt_max(largest, error / bound);
    *near |= here;
  }
  return largest;
}

/* An estimate may vanish by chance, of a swing that the step passes over above all. So where a guard is near, what its
 * polynomial does is compared with what the equations say, at two places where the method has not looked. */
static double compared(rt_session *s, double to) {
  const mdl_descriptor *d = s->d;
  double largest = 0, p[MOST], h = to - s->t_previous;
  memcpy(s->v_trial, s->data.v, (size_t)d->n_v * sizeof *s->v_trial);
  for (size_t i = 0; i < sizeof between / sizeof *between; i++) {
    double t = s->t_previous + between[i] * h;
    rt_dense_eval(&s->dense, d->n_x, t, s->x_trial);
    if (rt_rhs(s, t, s->x_trial, s->xdot_trial, s->v_trial) || d->guard_rates(&s->data, 1, s->xdot_trial, s->g_trial))
      return INFINITY;
    for (int r = 0; r < d->n_rel; r++) {
      if (!d->affine_guards[r]) continue;
      bool near;
      int n = polynomial(s, r, s->g[r], to, p);
      double bound = allowed(s, r, n, p, &near), slope = 0;
      for (int k = n; k > 0; k--)
        slope = slope * between[i] + k * p[k];
      if (near)
        largest = rt_max(largest, of_slope * fabs(slope - h * (s->data.rel[r] ? 1 : -1) * s->g_trial[r]) / bound);
    }
  }
  return largest;
}

/* How much too large the step from t_previous to `to` is for the guards, where its error in the states is known: up to
 * 1 it is not. s->g belongs to its start. */
double rt_swing_error(rt_session *s, double to, const double *error) {
  bool near;
  rt_swing_shape(s, error);
  if (!s->shaped) return 0;
  double largest = estimated(s, to, &near);
  return near && largest <= 1 ? rt_max(largest, compared(s, to)) : largest;
}

/* Where guard r is first at an extreme that lies past zero by more than the hysteresis, up to `to`, or there; `to`
 * where it is not. */
static double first_bottom(rt_session *s, int r, double to) {
  double p[MOST], place[MOST], low, high, eps = rt_hysteresis(s, r);
  int n = polynomial(s, r, s->g_previous[r], to, p);
  if (floor_of(n, p) >= -eps) return to;
  enclose(n, p, &low, &high);
  if (low >= -eps) return to;
  int count = extremes(n, p, place);
  for (int i = 0; i < count; i++) {
    double value = horner(n, p, place[i]);
    if (value < -eps) return s->t_previous + place[i] * (to - s->t_previous);
    rt_extend_guard(s, r, value);
  }
  return to;
}

/* The first crossing of guard r, which is past zero at `to`; how far it went before counts as its travel. */
double rt_swing_crossing(rt_session *s, int r, double to) {
  double p[MOST], root[MOST], place[MOST];
  int n = polynomial(s, r, s->g_previous[r], to, p), count = extremes(n, p, place);
  p[0] = rt_margin(s, r, s->g_previous[r]);
  double first = roots_of(n, p, root) ? root[0] : 1;
  for (int i = 0; i < count && place[i] < first; i++)
    rt_extend_guard(s, r, horner(n, p, place[i]));
  return s->t_previous + first * (to - s->t_previous);
}

/* Look in the step up to *inside for guards that cross and come back, or cross before they do at its end. Where there
 * is one s->g belongs to *inside, where it is past zero; otherwise *inside stays as it is. */
int rt_find_swing(rt_session *s, double *inside) {
  memcpy(s->v_trial, s->data.v, (size_t)s->d->n_v * sizeof *s->v_trial);
  for (int r = 0; s->shaped && r < s->d->n_rel; r++) {
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
