/* The model's functions as the runtime calls them: inputs brought up to date, calls counted, results guarded. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "session.h"

static const double agreement = 1e-6; /* of the two forms: far above rounding, far below what a slip leaves */
static const double nearness = 1e-4; /* of a nominal value, or one in the time of the run: a slip leaves its own size */
enum { MOST_UNKNOWNS = 1000 };       /* of a dense factorisation: a second */

/* 0 if all n_x derivatives are finite; else 1, with the equation to blame, or the first state, in m->failure. */
int rt_check_finite(rt_session *s, const double *x) {
  double sum = 0;
  for (int i = 0; i < s->d->n_x; i++)
    sum += x[i] - x[i];
  if (sum == 0) return 0;
  if (rt_blame(s, MDL_DERIVATIVE, x, s->data.v)) return 1;
  int state = 0;
  while (isfinite(x[state]))
    state++;
  s->data.failure = (mdl_failure){
      .kind = MDL_FAILURE_NONFINITE, .equation = -1, .variable = rt_state_variable(s, state), .value = x[state]};
  return 1;
}

/* Explicit form: x' [n_x] and v [n_v] at (t, x). `v` holds start values of nonlinear blocks on entry. What relations
 * note counts where v is the session's own: others are points that are only looked at. */
int rt_rhs(rt_session *s, double t, const double *x, double *xdot, double *v) {
  if (s->d->n_u) rt_inputs_at(s, t);
  s->result->counters.rhs++;
  s->data.undetermined = s->data.unsettled = 0;
  s->data.orientation = v == s->data.v ? s->branches.orientation : s->branches.aside;
  int status = s->d->rhs(&s->data, t, x, xdot, v);
  if (v == s->data.v && !s->data.brief) s->unsettled = s->data.unsettled;
  return status;
}

/* x' alone: of v, it is enough to have what the next point starts from. */
int rt_derivatives(rt_session *s, double t, const double *x, double *xdot, double *v) {
  s->data.brief = 1;
  int status = rt_rhs(s, t, x, xdot, v);
  s->data.brief = 0;
  return status;
}

/* x', v and the guards at the present point; v wherever it is to be kept. At events other equations may hold: which way
 * their roots face is unknown until their Jacobians have been asked for. */
int rt_evaluate_into(rt_session *s, double *v) {
  mdl_data *m = &s->data;
  if (s->d->n_branches) memset(s->branches.orientation, 0, (size_t)s->d->n_equations * sizeof(double));
  int status = rt_rhs(s, s->t, m->x, m->xdot, v);
  if (!status) status = rt_check_finite(s, m->xdot);
  if (!status && s->d->n_rel) {
    s->result->counters.root_evaluations++;
    status = s->d->roots(m, s->t, m->x, m->xdot, v, s->g);
  }
  s->unsettled = m->unsettled;
  return status;
}

/* 0 where `place`, as mdl_data.unsettled, is none; else 1, with the relation in m->failure. */
int rt_check_settled(rt_session *s, int place) {
  if (place) s->data.failure = (mdl_failure){.kind = MDL_FAILURE_RELATION, .equation = place, .variable = -1};
  return place != 0;
}

int rt_evaluate(rt_session *s) {
  return rt_evaluate_into(s, s->data.v);
}

/* The point (y, y') of the residual form that belongs to the present x, x', v; z' is left at zero. */
void rt_residual_point(rt_session *s) {
  const mdl_descriptor *d = s->d;
  memcpy(s->y, s->data.x, (size_t)d->n_x * sizeof *s->y);
  memcpy(s->yp, s->data.xdot, (size_t)d->n_x * sizeof *s->yp);
  for (int k = 0; k < d->n_z; k++) {
    s->y[d->n_x + k] = s->data.v[d->z_index[k]];
    s->yp[d->n_x + k] = 0;
  }
}

/* The column of the Jacobian to unknown j again, as secants over the absolute tolerance of the unknown. */
static int secants(rt_session *s, double t, double *y, double *yp, double cj, int j, double *values, double *r) {
  const mdl_descriptor *d = s->d;
  double y_here = y[j], yp_here = yp[j], *moved = r + d->n_x + d->n_z;
  int status = d->residual(&s->data, t, y, yp, r);
  y[j] += s->atol[j];
  yp[j] += cj * s->atol[j];
  if (!status) status = d->residual(&s->data, t, y, yp, moved);
  for (int k = d->jac_colptr[j]; !status && k < d->jac_colptr[j + 1]; k++)
    values[k] = (moved[d->jac_rowidx[k]] - r[d->jac_rowidx[k]]) / (y[j] - y_here);
  y[j] = y_here;
  yp[j] = yp_here;
  return status;
}

/* dF/dy + cj dF/dy' with finite entries: a root at its end, sqrt(0), has none but the slope over what is resolved. */
int rt_jacobian(rt_session *s, double t, double *y, double *yp, double cj, double *values) {
  const mdl_descriptor *d = s->d;
  int status = d->jacobian(&s->data, t, y, yp, cj, values), n = d->n_x + d->n_z;
  if (status || rt_finite(d->jac_nnz, values)) return status;
  double *r = calloc(2 * (size_t)n, sizeof *r);
  if (!r) return -1;
  for (int j = 0; !status && j < n; j++)
    if (!rt_finite(d->jac_colptr[j + 1] - d->jac_colptr[j], values + d->jac_colptr[j]))
      status = secants(s, t, y, yp, cj, j, values, r);
  free(r);
  return status;
}

/* Whether z and x' that solve the residual form are, in units of their nominal values, as good as those of the explicit
 * form: of ill-conditioned equations (ideal switches of 1e-5 and 1e5 Ohm) a residual tells only what is left by
 * rounding. */
static bool near(rt_session *s, double *r, const double *fy, const double *fyp) {
  const mdl_descriptor *d = s->d;
  int n = d->n_x + d->n_z;
  if (n > MOST_UNKNOWNS) return false;
  double *a = calloc((size_t)n * (size_t)n, sizeof *a), rate = 1 / (s->stop - s->start);
  int *pivot = calloc((size_t)n, sizeof *pivot);
  for (int j = 0; a && pivot && j < n; j++)
    for (int k = d->jac_colptr[j]; k < d->jac_colptr[j + 1]; k++)
      a[j * n + d->jac_rowidx[k]] = (j < d->n_x ? (fyp[k] - fy[k]) * rate : fy[k]) * s->nominal[j];
  for (int i = 0; a && pivot && i < n; i++) {
    double largest = 0;
    for (int j = 0; j < n; j++)
      largest = rt_max(largest, fabs(a[j * n + i]));
    for (int j = 0; largest > 0 && j < n; j++)
      a[j * n + i] /= largest;
    if (largest > 0) r[i] /= largest;
  }
  bool found = a && pivot && !rt_lu_factor(n, a, pivot);
  if (found) rt_lu_solve(n, a, pivot, r);
  for (int j = 0; found && j < n; j++)
    found = fabs(r[j]) <= nearness;
  free(a);
  free(pivot);
  return found;
}

/* |F| against the size of what is added up in each row of F, estimated by sum_j |dF/dy_j y_j| + |dF/dy'_j y'_j|. */
static rt_status compare(rt_session *s, double *r, double *scale, double *smallest, double *fy, double *fyp) {
  const mdl_descriptor *d = s->d;
  mdl_data *m = &s->data;
  if (d->residual(m, s->t, s->y, s->yp, r) || d->jacobian(m, s->t, s->y, s->yp, 0, fy) ||
      d->jacobian(m, s->t, s->y, s->yp, 1, fyp))
    return rt_fail_model(s, s->t, "evaluating the residual form");
  int n = d->n_x + d->n_z, worst = -1;
  double rate = 1 / (s->stop - s->start);
  for (int i = 0; i < n; i++)
    scale[i] = smallest[i] = 0;
  for (int j = 0; j < n; j++)
    for (int k = d->jac_colptr[j]; k < d->jac_colptr[j + 1]; k++) {
      if (!isfinite(fy[k]) || !isfinite(fyp[k])) continue; /* the slope of a root at its end */
      scale[d->jac_rowidx[k]] += fabs(fy[k] * s->y[j]) + fabs((fyp[k] - fy[k]) * s->yp[j]);
      smallest[d->jac_rowidx[k]] += (fabs(fy[k]) + fabs(fyp[k] - fy[k]) * rate) * s->nominal[j];
    }
  for (int i = 0; i < n && worst < 0; i++)
    if (!(fabs(r[i]) <= agreement * scale[i] + 1e-9 * smallest[i] + DBL_MIN)) worst = i;
  if (worst < 0) return RT_OK;
  double off = r[worst];
  if (near(s, r, fy, fyp)) return RT_OK;
  return rt_fail(s, RT_INCONSISTENT, s->t, -1, &d->equations[d->residual_equation[worst]],
                 "the residual form of the model disagrees with its explicit form at time %.9g s (residual %.3g)", s->t,
                 off);
}

/* The two generated forms of the model must agree at the start: a guard against errors in the translation. */
rt_status rt_check_forms(rt_session *s) {
  size_t n = (size_t)(s->d->n_x + s->d->n_z), nnz = (size_t)s->d->jac_nnz;
  double *work = calloc(3 * n + 2 * nnz + 1, sizeof *work);
  if (!work) return rt_fail(s, RT_MEMORY, s->t, -1, NULL, "out of memory");
  rt_residual_point(s);
  rt_status status = compare(s, work, work + n, work + 2 * n, work + 3 * n, work + 3 * n + nnz);
  free(work);
  return status;
}
