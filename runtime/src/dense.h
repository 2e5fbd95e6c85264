/* Dense output: the last step as a polynomial, whatever the method. */
#ifndef RT_DENSE_H
#define RT_DENSE_H

#include <stdbool.h>

#include "lacuna_runtime.h"

/* The last step as one polynomial for each state: x_i(t) = sum_k c[k * n_x + i] s^k, s = (t - t0) / h. */
#define RT_DENSE_DEGREE 5
typedef struct {
  double t0, h;
  int degree;
  bool valid;
  double *c; /* [(RT_DENSE_DEGREE + 1) * n_x] */
} rt_dense;

void rt_dense_prepare(rt_session *s);
void rt_dense_point(rt_session *s, double t, double *x);
void rt_dense_eval(const rt_dense *dense, int n, double t, double *x);

/* State i of n where (t - t0) / h is theta; written out for the degree of dopri5, of which a run records the most. */
static inline double rt_dense_state(const rt_dense *dense, int n, int i, double theta) {
  const double *c = dense->c + i;
  if (dense->degree == 4) return (((c[4 * n] * theta + c[3 * n]) * theta + c[2 * n]) * theta + c[n]) * theta + c[0];
  double sum = *(c += dense->degree * n);
  for (int k = dense->degree; k > 0; k--)
    sum = sum * theta + *(c -= n);
  return sum;
}

#endif
