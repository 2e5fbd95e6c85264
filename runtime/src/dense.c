/* Dense output: the last step as a polynomial, whatever the method. */
#include "session.h"

void rt_dense_prepare(rt_session *s) {
  if (s->dense.valid) return;
  s->method->dense(s, s->memory, &s->dense);
  s->dense.valid = true;
}

/* x [n] at t, by Horner's rule. */
void rt_dense_eval(const rt_dense *dense, int n, double t, double *x) {
  double theta = (t - dense->t0) / dense->h;
  const double *c = dense->c + dense->degree * n;
  for (int i = 0; i < n; i++) x[i] = c[i];
  for (int k = dense->degree - 1; k >= 0; k--) {
    c -= n;
    for (int i = 0; i < n; i++) x[i] = x[i] * theta + c[i];
  }
}

double rt_dense_eval_one(const rt_dense *dense, int n, int i, double t) {
  double theta = (t - dense->t0) / dense->h, x = 0;
  for (int k = dense->degree; k >= 0; k--) x = x * theta + dense->c[k * n + i];
  return x;
}
