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

#endif
