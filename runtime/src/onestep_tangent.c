/* The variational equations of an explicit one-step method: the same scheme applied to s' = f_x s + f_p, all columns at
 * once, at the points that the stages of the run itself have been at. So a step's tangents are exactly the derivative
 * of what the step computes. They come after the run's own error test, and may reject the step too. */
#include <stdlib.h>
#include <string.h>

#include "onestep.h"
#include "sensitivity.h"

enum { STAGES = 7 }; /* of every scheme that has coefficients here */

void rt_onestep_tangent_free(rt_onestep *o) {
  if (!o->tangent) return;
  free(o->tangent->x0);
  free(o->tangent);
  free(o->stage_x);
  o->tangent = NULL;
}

bool rt_onestep_sensitivities(rt_session *s, void *memory) {
  rt_onestep *o = memory;
  rt_onestep_tangent_free(o);
  if (!s->sensitivities) return true;
  size_t stages = (size_t)o->scheme->stages, n = (size_t)(s->d->n_x * s->sensitivities->columns);
  rt_onestep *t = o->tangent = calloc(1, sizeof *t);
  double *block = calloc((3 + stages) * n + 1, sizeof *block);
  o->stage_x = calloc(stages * (size_t)(s->d->n_x + s->d->n_v) + 1, sizeof *o->stage_x);
  if (!t || !block || !o->stage_x) {
    free(block);
    free(t);
    free(o->stage_x);
    o->tangent = NULL;
    return false;
  }
  o->stage_v = o->stage_x + stages * (size_t)s->d->n_x;
  *t = (rt_onestep){.scheme = o->scheme, .x0 = block, .x1 = block + n, .error = block + 2 * n, .k = block + 3 * n};
  t->f0 = t->k;
  t->f1 = t->k + (stages - 1) * n;
  return true;
}

/* y = x + h sum_j a_j k_j over `count` stages. Inline, so that a known count unrolls. */
static inline void add_up(int n, double *restrict y, const double *restrict x, const double *restrict k, double h,
                          int count, const double *a) {
  for (int i = 0; i < n; i++) {
    double sum = x[i];
    for (int j = 0; j < count; j++)
      sum += h * a[j] * k[j * n + i];
    y[i] = sum;
  }
}

MDL_WIDE static void stage_sum(int n, rt_onestep *t, double h, int count, const double *a) {
  switch (count) {
  case 1:
    add_up(n, t->x1, t->x0, t->k, h, 1, a);
    break;
  case 2:
    add_up(n, t->x1, t->x0, t->k, h, 2, a);
    break;
  case 3:
    add_up(n, t->x1, t->x0, t->k, h, 3, a);
    break;
  case 4:
    add_up(n, t->x1, t->x0, t->k, h, 4, a);
    break;
  case 5:
    add_up(n, t->x1, t->x0, t->k, h, 5, a);
    break;
  default:
    add_up(n, t->x1, t->x0, t->k, h, count, a);
  }
}

/* The error of a step of all seven stages. */
MDL_WIDE static void error_of(int n, rt_onestep *t, double h, const double *weights) {
  const double *restrict k = t->k;
  double *restrict error = t->error;
  for (int i = 0; i < n; i++) {
    double sum = 0;
    for (int j = 0; j < STAGES; j++)
      sum += weights[j] * k[j * n + i];
    error[i] = h * sum;
  }
}

/* 1 / scale of four columns. One whose parameter has no known size is measured by itself: by its largest entry, each
 * over the nominal value of its state. */
static void weights(const rt_session *s, const rt_onestep *t, int first, double *weight) {
  const rt_sensitivities *f = s->sensitivities;
  for (int k = 0; k < MDL_LANES; k++) {
    weight[k] = f->weight[first + k];
    if (!isinf(weight[k])) continue;
    weight[k] = 0;
    for (int i = 0; i < s->d->n_x; i++)
      weight[k] = rt_max(weight[k], fabs(t->x1[i * f->columns + first + k]) / s->nominal[i]);
  }
}

/* The largest mean square, over the columns, of e_ik / (atol_i / scale_k + rtol max(|x0_ik|, |x1_ik|)). */
MDL_WIDE static double worst_column(const rt_session *s, const rt_onestep *t) {
  const rt_sensitivities *f = s->sensitivities;
  double worst = 0, weight[MDL_LANES];
  for (int first = 0; first < f->columns; first += MDL_LANES) {
    double sum[MDL_LANES] = {0};
    weights(s, t, first, weight);
    for (int i = 0; i < s->d->n_x; i++) {
      size_t row = (size_t)(i * f->columns + first);
      for (int k = 0; k < MDL_LANES; k++) {
        double size0 = fabs(t->x0[row + k]), size1 = fabs(t->x1[row + k]);
        double size = s->atol[i] * weight[k] + s->options.rtol * (size0 > size1 ? size0 : size1) + DBL_MIN;
        sum[k] += (t->error[row + k] / size) * (t->error[row + k] / size);
      }
    }
    for (int k = 0; k < MDL_LANES; k++)
      worst = sum[k] > worst ? sum[k] : worst;
  }
  return s->d->n_x ? worst / s->d->n_x : 0;
}

/* The point of stage j, at which the model is to be differentiated. */
void rt_onestep_keep_stage(rt_session *s, rt_onestep *o, int j) {
  memcpy(o->stage_x + j * s->d->n_x, o->x1, (size_t)s->d->n_x * sizeof *o->x1);
  memcpy(o->stage_v + j * s->d->n_v, s->data.v, (size_t)s->d->n_v * sizeof *s->data.v);
}

/* Tangents of the step that the run's own error test has accepted; `square` (NULL: no error test) becomes that of the
 * worst column where that is larger. */
int rt_onestep_tangent_step(rt_session *s, rt_onestep *o, double h, double *square) {
  rt_sensitivities *f = s->sensitivities;
  const rt_scheme *scheme = o->scheme;
  rt_onestep *t = o->tangent;
  if (f->lost) return 0;
  int n_x = s->d->n_x, n = n_x * f->columns, stages = scheme->stages;
  memcpy(t->x0, f->at.x, (size_t)n * sizeof(double));
  memcpy(t->f0, f->at.xdot, (size_t)n * sizeof(double));
  t->t0 = o->t0;
  t->h = h;
  mdl_tangent point = f->inside;
  for (int j = 1; j < stages; j++) {
    double time = o->t0 + scheme->nodes[j] * h;
    stage_sum(n, t, h, j, scheme->weights + j * (stages - 1));
    point.x = (mdl_lanes *)t->x1;
    point.xdot = (mdl_lanes *)(t->k + j * n);
    if (s->d->n_u) rt_inputs_at(s, time);
    int status = s->d->tangents->derivatives(&s->data, time, o->stage_x + j * n_x, o->k + j * n_x,
                                             o->stage_v + j * s->d->n_v, &point);
    if (status) return status;
    s->result->counters.tangents++;
  }
  if (!square) return 0;
  error_of(n, t, h, scheme->error_weights);
  double own = worst_column(s, t);
  if (own > *square) *square = own;
  return 0;
}

/* The step stands: its end is the session's point, and the last stage was there. */
void rt_onestep_tangent_accept(rt_session *s, rt_onestep *o) {
  rt_sensitivities *f = s->sensitivities;
  if (f->lost) return;
  size_t n = (size_t)(s->d->n_x * f->columns) * sizeof(double);
  memcpy(f->at.x, o->tangent->x1, n);
  memcpy(f->at.xdot, o->tangent->f1, n);
  f->complete = false;
  rt_tangent_check_finite(s);
}

void rt_onestep_dense_tangent(rt_session *s, void *memory, rt_dense *dense) {
  const rt_onestep *o = memory;
  dense->t0 = o->t0;
  dense->h = o->h;
  o->scheme->dense(s->d->n_x * s->sensitivities->columns, o->tangent, dense);
}
