/* Dense output: the last step as a polynomial, whatever the method. */
#include "session.h"

void rt_dense_prepare(rt_session *s) {
  if (s->dense.valid) return;
  s->method->dense(s, s->memory, &s->dense);
  s->dense.valid = true;
}

/* x [n_x] inside the last step. */
void rt_dense_point(rt_session *s, double t, double *x) {
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
