/* The rates of affine guards inside the last step: what its polynomial errs by there.
 *
 * The polynomial x(t) has the defect x' - f(t, x), which of rates far above 1 / h is mostly what they make of rounding:
 * at an open switch beside an inductance 1e8 in a second. The error of x is that of a step of the implicit Euler method
 * from the polynomial, (I - h gamma J)^-1 h gamma times the defect (Hairer & Wanner, Solving Ordinary Differential
 * Equations II, IV.8), which of slow rates is the same. So where a method has such a matrix the defect goes through it.
 */
#include <string.h>

#include "swings.h"

/* x' [n] at t. */
static void slope_at(const rt_dense *dense, int n, double t, double *slope) {
  double theta = (t - dense->t0) / dense->h;
  for (int i = 0; i < n; i++) {
    double sum = 0;
    for (int k = dense->degree; k > 0; k--)
      sum = sum * theta + k * dense->c[k * n + i];
    slope[i] = sum / dense->h;
  }
}

/* xdot_trial, which is f at (t, x_trial, v_trial): the slope of the polynomial without its filtered defect. */
static void filter(rt_session *s, double t) {
  int n = s->d->n_x;
  slope_at(&s->dense, n, t, s->yp);
  for (int i = 0; i < n; i++)
    s->xdot_trial[i] = s->yp[i] - s->xdot_trial[i];
  s->method->filter(s, s->memory, t, s->xdot_trial);
  slope_at(&s->dense, n, t, s->yp);
  for (int i = 0; i < n; i++)
    s->xdot_trial[i] = s->yp[i] - s->xdot_trial[i];
}

/* Rates of the guards at places along the step to `to`, a row of s->rates each; whether there are. */
bool rt_look_along(rt_session *s, double to, const double *places, int count) {
  const mdl_descriptor *d = s->d;
  memcpy(s->v_trial, s->data.v, (size_t)d->n_v * sizeof *s->v_trial);
  for (int i = 0; i < count; i++) {
    double t = s->t_previous + places[i] * (to - s->t_previous);
    rt_dense_eval(&s->dense, d->n_x, t, s->x_trial);
    if (rt_derivatives(s, t, s->x_trial, s->xdot_trial, s->v_trial)) return false;
    if (s->method->filter) filter(s, t);
    if (d->guard_rates(&s->data, 1, s->xdot_trial, s->rates + i * d->n_rel)) return false;
  }
  return true;
}
