/* Where IDA's Newton method gets no further: the equation to blame. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "ida.h"
#include "vector.h"

/* The row of the residual form that is off by most, measured in what a change of its unknowns by their sizes makes of
 * it; -1 where none is off, or nothing can be evaluated. */
static int worst_row(rt_session *s, rt_ida *m, double *r, double *size, double *off) {
  const mdl_descriptor *d = s->d;
  N_Vector y = NULL, yp = NULL;
  sunrealtype t = s->t, cj = 1;
  int n = d->n_x + d->n_z, worst = -1;
  if (IDAGetCurrentY(m->ida, &y) || IDAGetCurrentYp(m->ida, &yp) || IDAGetCurrentCj(m->ida, &cj)) return -1;
  double *at = N_VGetArrayPointer(y), *slope = N_VGetArrayPointer(yp);
  if (d->residual(&s->data, t, at, slope, r) || rt_jacobian(s, t, at, slope, cj, m->values)) return -1;
  memset(size, 0, (size_t)n * sizeof *size);
  for (int j = 0; j < n; j++)
    for (int k = d->jac_colptr[j]; k < d->jac_colptr[j + 1]; k++)
      size[d->jac_rowidx[k]] += fabs(m->values[k]) * s->nominal[j];
  *off = 0;
  for (int i = 0; i < n; i++) {
    double share = size[i] > 0 ? fabs(r[i]) / size[i] : 0;
    if (!(share > *off)) continue;
    *off = share;
    worst = d->residual_equation[i];
  }
  return worst;
}

rt_status rt_ida_fail_newton(rt_session *s, rt_ida *m, double h) {
  size_t n = (size_t)(s->d->n_x + s->d->n_z);
  double off = 0, *work = calloc(2 * n, sizeof *work);
  int equation = work ? worst_row(s, m, work, work + n, &off) : -1;
  free(work);
  if (equation < 0) return rt_fail_collapse(s, h, "Newton's method fails");
  rt_status status =
      rt_fail(s, RT_STEP_COLLAPSE, s->t, -1, &s->d->equations[equation],
              "solver ida makes no progress at time %.9g s: Newton's method fails (step %.3g s); of its equations this "
              "one is furthest from holding",
              s->t, h);
  if (s->d->equation_first) rt_append_equation(s, equation);
  return status;
}
