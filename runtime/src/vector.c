/* Vector operations for IDA. Models have tens of unknowns: at such lengths SUNDIALS' serial vectors spend their time in
 * checks, special cases and chains of dependent additions. These are the operations that IDA calls in every step, as
 * plain loops; the rest stays as it is. Norms are summed in four lanes, so that they are the same however the compiler
 * vectorises. */
#include <math.h>

#include "sundials_compat.h"
#include "vector.h"

enum { LANES = 4 };

static void linear_sum(sunrealtype a, N_Vector vx, sunrealtype b, N_Vector vy, N_Vector vz) {
  const double *x = NV_DATA_S(vx), *y = NV_DATA_S(vy);
  double *z = NV_DATA_S(vz);
  for (sunindextype i = 0, n = NV_LENGTH_S(vz); i < n; i++)
    z[i] = a * x[i] + b * y[i];
}

static void set(sunrealtype c, N_Vector vz) {
  double *z = NV_DATA_S(vz);
  for (sunindextype i = 0, n = NV_LENGTH_S(vz); i < n; i++)
    z[i] = c;
}

static void scale(sunrealtype c, N_Vector vx, N_Vector vz) {
  const double *x = NV_DATA_S(vx);
  double *z = NV_DATA_S(vz);
  for (sunindextype i = 0, n = NV_LENGTH_S(vz); i < n; i++)
    z[i] = c * x[i];
}

static void absolute(N_Vector vx, N_Vector vz) {
  const double *x = NV_DATA_S(vx);
  double *z = NV_DATA_S(vz);
  for (sunindextype i = 0, n = NV_LENGTH_S(vz); i < n; i++)
    z[i] = fabs(x[i]);
}

static void invert(N_Vector vx, N_Vector vz) {
  const double *x = NV_DATA_S(vx);
  double *z = NV_DATA_S(vz);
  for (sunindextype i = 0, n = NV_LENGTH_S(vz); i < n; i++)
    z[i] = 1 / x[i];
}

/* sqrt(sum_i (x_i w_i)^2 / n) */
static sunrealtype norm(N_Vector vx, N_Vector vw) {
  const double *x = NV_DATA_S(vx), *w = NV_DATA_S(vw);
  sunindextype n = NV_LENGTH_S(vx), i = 0;
  double sum[LANES] = {0};
  for (; i + LANES <= n; i += LANES)
    for (int k = 0; k < LANES; k++)
      sum[k] += (x[i + k] * w[i + k]) * (x[i + k] * w[i + k]);
  for (; i < n; i++)
    sum[0] += (x[i] * w[i]) * (x[i] * w[i]);
  return sqrt(((sum[0] + sum[1]) + (sum[2] + sum[3])) / (double)n);
}

/* The same over the components whose `id` is 1; the others have 0 there. */
static sunrealtype masked_norm(N_Vector vx, N_Vector vw, N_Vector vid) {
  const double *x = NV_DATA_S(vx), *w = NV_DATA_S(vw), *id = NV_DATA_S(vid);
  sunindextype n = NV_LENGTH_S(vx), i = 0;
  double sum[LANES] = {0};
  for (; i + LANES <= n; i += LANES)
    for (int k = 0; k < LANES; k++)
      sum[k] += id[i + k] * ((x[i + k] * w[i + k]) * (x[i + k] * w[i + k]));
  for (; i < n; i++)
    sum[0] += id[i] * ((x[i] * w[i]) * (x[i] * w[i]));
  return sqrt(((sum[0] + sum[1]) + (sum[2] + sum[3])) / (double)n);
}

/* z = sum_j c_j x_j, over all vectors for a few components at a time: z may be one of them. */
static int combine(int count, sunrealtype *c, N_Vector *vectors, N_Vector vz) {
  double *z = NV_DATA_S(vz);
  sunindextype n = NV_LENGTH_S(vz), i = 0;
  for (; i + LANES <= n; i += LANES) {
    double sum[LANES] = {0};
    for (int j = 0; j < count; j++) {
      const double *x = NV_DATA_S(vectors[j]) + i;
      for (int k = 0; k < LANES; k++)
        sum[k] += c[j] * x[k];
    }
    for (int k = 0; k < LANES; k++)
      z[i + k] = sum[k];
  }
  for (; i < n; i++) {
    double sum = 0;
    for (int j = 0; j < count; j++)
      sum += c[j] * NV_DATA_S(vectors[j])[i];
    z[i] = sum;
  }
  return 0;
}

static int scale_all(int count, sunrealtype *c, N_Vector *x, N_Vector *z) {
  for (int j = 0; j < count; j++)
    scale(c[j], x[j], z[j]);
  return 0;
}

static int linear_sums(int count, sunrealtype a, N_Vector *x, sunrealtype b, N_Vector *y, N_Vector *z) {
  for (int j = 0; j < count; j++)
    linear_sum(a, x[j], b, y[j], z[j]);
  return 0;
}

N_Vector rt_vector_new(long n, SUNContext context) {
  N_Vector v = N_VNew_Serial(n, context);
  if (!v) return NULL;
  v->ops->nvlinearsum = linear_sum;
  v->ops->nvconst = set;
  v->ops->nvscale = scale;
  v->ops->nvabs = absolute;
  v->ops->nvinv = invert;
  v->ops->nvwrmsnorm = norm;
  v->ops->nvwrmsnormmask = masked_norm;
  v->ops->nvlinearcombination = combine;
  v->ops->nvscalevectorarray = scale_all;
  v->ops->nvlinearsumvectorarray = linear_sums;
  set(0, v);
  return v;
}
