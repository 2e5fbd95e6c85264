/* Dense output: the last step as a polynomial, whatever the method. */
#include "session.h"

void rt_dense_prepare(rt_session *s) {
  if (s->dense.valid) return;
  s->method->dense(s, s->memory, &s->dense);
  s->dense.valid = true;
}

/* x [n_x] inside the last step; `alone`: hardly another point of the step is wanted soon. */
void rt_dense_point(rt_session *s, double t, bool alone, double *x) {
  if (alone && !s->dense.valid && s->method->point) {
    s->method->point(s, s->memory, t, x);
    return;
  }
  rt_dense_prepare(s);
  rt_dense_eval(&s->dense, s->d->n_x, t, x);
}

/* x [n] at t, by Horner's rule. */
void rt_dense_eval(const rt_dense *dense, int n, double t, double *x) {
  double theta = (t - dense->t0) / dense->h;
  const double *highest = dense->c + dense->degree * n;
  for (int i = 0; i < n; i++) {
    double sum = highest[i];
    for (const double *c = highest - n; c >= dense->c; c -= n)
      sum = sum * theta + c[i];
    x[i] = sum;
  }
}

/* State i of n at many instants, all as polynomials of the highest degree: a loop of known length. */
void rt_dense_column(const rt_dense *dense, int n, int i, size_t points, const double *t, double *x) {
  double per_step = 1 / dense->h, c[RT_DENSE_DEGREE + 1] = {0};
  for (int power = 0; power <= dense->degree; power++)
    c[power] = dense->c[power * n + i];
  for (size_t k = 0; k < points; k++) {
    double theta = (t[k] - dense->t0) * per_step, sum = c[RT_DENSE_DEGREE];
    for (int power = RT_DENSE_DEGREE - 1; power >= 0; power--)
      sum = sum * theta + c[power];
    x[k] = sum;
  }
}
