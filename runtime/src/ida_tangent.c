/* Forward sensitivities by IDAS: after each step of the run a staggered corrector solves for all columns with the run's
 * own Jacobian (W. F. Feehery, J. E. Tolsma, P. I. Barton, Appl. Numer. Math. 25 (1997) 41-54). The residual of the
 * columns F_y s + F_y' s' + F_p comes from the model, all at once. Each column is in the error test on its own scale.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "ida.h"
#include "vector.h"

static const double NOT_TESTED = 1e100; /* absolute tolerance of a column that has no size yet */

/* Vectors of the columns -> rows of a bundle, and back. */
static void to_rows(const rt_ida *m, int n, int columns, N_Vector *vectors, double *rows) {
  for (int k = 0; k < m->columns; k++) {
    const double *v = N_VGetArrayPointer(vectors[k]);
    for (int i = 0; i < n; i++)
      rows[i * columns + k] = v[i];
  }
}

static void from_rows(const rt_ida *m, int n, int columns, const double *rows, N_Vector *vectors, int first) {
  for (int k = 0; k < m->columns; k++) {
    double *v = N_VGetArrayPointer(vectors[k]) + first;
    for (int i = 0; i < n; i++)
      v[i] = rows[i * columns + k];
  }
}

static int residual(int count, sunrealtype t, N_Vector y, N_Vector yp, N_Vector r, N_Vector *ys, N_Vector *yps,
                    N_Vector *rs, void *user, N_Vector t1, N_Vector t2, N_Vector t3) {
  (void)count, (void)r, (void)t1, (void)t2, (void)t3;
  rt_session *s = user;
  rt_ida *m = s->memory;
  rt_sensitivities *f = s->sensitivities;
  const mdl_descriptor *d = s->d;
  int n = d->n_x + d->n_z;
  rt_inputs_at(s, t);
  to_rows(m, n, f->columns, ys, m->rows_y);
  to_rows(m, d->n_x, f->columns, yps, m->rows_yp);
  int status = d->tangents->residual(&s->data, t, N_VGetArrayPointer(y), N_VGetArrayPointer(yp), &f->inside,
                                     (mdl_lanes *)m->rows_y, (mdl_lanes *)m->rows_yp, (mdl_lanes *)m->rows_r);
  from_rows(m, n, f->columns, m->rows_r, rs, 0);
  s->result->counters.tangents++;
  return status;
}

void rt_ida_tangent_free(rt_ida *m) {
  if (m->ida && m->tangent_y) IDASensFree(m->ida);
  N_Vector **groups[] = {&m->tangent_y, &m->tangent_yp, &m->tangent_atol};
  for (size_t g = 0; g < sizeof groups / sizeof *groups; g++) {
    for (int k = 0; *groups[g] && k < m->columns; k++)
      if ((*groups[g])[k]) N_VDestroy((*groups[g])[k]);
    free(*groups[g]);
    *groups[g] = NULL;
  }
  free(m->rows_y);
  m->rows_y = NULL;
  m->columns = 0;
}

static bool allocate(rt_session *s, rt_ida *m) {
  size_t n = (size_t)(s->d->n_x + s->d->n_z), columns = (size_t)s->sensitivities->columns;
  m->columns = s->sensitivities->n;
  m->rows_y = calloc(3 * n * columns + 1, sizeof *m->rows_y);
  if (!m->rows_y) return false;
  m->rows_yp = m->rows_y + n * columns;
  m->rows_r = m->rows_yp + n * columns;
  N_Vector **groups[] = {&m->tangent_y, &m->tangent_yp, &m->tangent_atol};
  for (size_t g = 0; g < sizeof groups / sizeof *groups; g++) {
    *groups[g] = calloc((size_t)m->columns, sizeof(N_Vector));
    for (int k = 0; *groups[g] && k < m->columns; k++)
      if (!((*groups[g])[k] = rt_vector_new((long)n, m->context))) return false;
    if (!*groups[g]) return false;
  }
  return true;
}

bool rt_ida_sensitivities(rt_session *s, void *memory) {
  rt_ida *m = memory;
  rt_ida_tangent_free(m);
  if (!s->sensitivities) return true;
  if (allocate(s, m) && IDASensInit(m->ida, m->columns, IDA_STAGGERED, residual, m->tangent_y, m->tangent_yp) == 0 &&
      IDASensSVtolerances(m->ida, s->options.rtol, m->tangent_atol) == 0 && IDASetSensErrCon(m->ida, true) == 0)
    return true;
  rt_ida_tangent_free(m);
  return false;
}

/* Absolute tolerances of the columns. One whose parameter has no known size is measured by itself, as it is now. */
static bool set_tolerances(rt_session *s, rt_ida *m) {
  const rt_sensitivities *f = s->sensitivities;
  const double *x = rt_rows(f->at.x);
  for (int k = 0; k < m->columns; k++) {
    double weight = f->weight[k], *atol = N_VGetArrayPointer(m->tangent_atol[k]);
    if (isinf(weight)) {
      weight = 0;
      for (int i = 0; i < s->d->n_x; i++)
        weight = rt_max(weight, fabs(x[i * f->columns + k]) / s->nominal[i]);
    }
    for (int i = 0; i < s->d->n_x + s->d->n_z; i++)
      atol[i] = weight > 0 ? s->atol[i] * weight : NOT_TESTED;
  }
  return IDASensSVtolerances(m->ida, s->options.rtol, m->tangent_atol) == IDA_SUCCESS;
}

/* From the tangents at the session's point; z' is left at zero, as z is not in the error test. */
rt_status rt_ida_tangent_restart(rt_session *s, rt_ida *m) {
  rt_sensitivities *f = s->sensitivities;
  if (!f || !m->columns) return RT_OK;
  if (f->lost) {
    IDASensToggleOff(m->ida);
    return RT_OK;
  }
  const mdl_descriptor *d = s->d;
  from_rows(m, d->n_x, f->columns, rt_rows(f->at.x), m->tangent_y, 0);
  from_rows(m, d->n_x, f->columns, rt_rows(f->at.xdot), m->tangent_yp, 0);
  for (int k = 0; k < d->n_z; k++) {
    from_rows(m, 1, f->columns, rt_rows(f->at.v) + d->z_index[k] * f->columns, m->tangent_y, d->n_x + k);
    for (int j = 0; j < m->columns; j++)
      N_VGetArrayPointer(m->tangent_yp[j])[d->n_x + k] = 0;
  }
  if (set_tolerances(s, m) && IDASensReInit(m->ida, IDA_STAGGERED, m->tangent_y, m->tangent_yp) == IDA_SUCCESS)
    return RT_OK;
  return rt_fail(s, RT_STEP_COLLAPSE, s->t, -1, NULL, "IDA refuses to restart sensitivities at time %.9g s", s->t);
}

/* The step is done: the states' tangents at its end, and what follows from them. */
rt_status rt_ida_tangent_step(rt_session *s, rt_ida *m) {
  rt_sensitivities *f = s->sensitivities;
  sunrealtype t;
  if (!f || f->lost) return RT_OK;
  if (IDAGetSens(m->ida, &t, m->tangent_y) != IDA_SUCCESS)
    return rt_fail(s, RT_STEP_COLLAPSE, s->t, -1, NULL, "IDA has no sensitivities at time %.9g s", s->t);
  to_rows(m, s->d->n_x, f->columns, m->tangent_y, rt_rows(f->at.x));
  f->complete = false;
  rt_tangent_check_finite(s);
  return RT_OK;
}

/* As dense() of the run: derivatives at the end of the step. One column at a time: IDAGetSensDky, for all of them,
 * refuses (up to SUNDIALS 7.5 at least) derivatives of the step's own order where the next step is to have a lower one.
 */
void rt_ida_dense_tangent(rt_session *s, void *memory, rt_dense *out) {
  rt_ida *m = memory;
  int columns = s->sensitivities->columns, n = s->d->n_x * columns;
  sunrealtype h = 1;
  IDAGetLastOrder(m->ida, &out->degree);
  IDAGetLastStep(m->ida, &h);
  IDAGetCurrentTime(m->ida, &out->t0);
  out->h = h;
  double factor = 1;
  for (int k = 0; k <= out->degree; k++) {
    for (int j = 0; j < m->columns; j++)
      IDAGetSensDky1(m->ida, out->t0, k, j, m->tangent_y[j]);
    to_rows(m, s->d->n_x, columns, m->tangent_y, out->c + k * n);
    for (int i = 0; i < n; i++)
      out->c[k * n + i] *= factor;
    factor *= h / (k + 1);
  }
}
