/* Unknowns that a mode leaves open: two brakes hold one shaft, and only the sum of their torques follows.
 *
 * The model takes the solution next to zero (codegen/emit/functions/linear.py). That is an answer only where nothing
 * that is integrated depends on it, and where it lasts as long as the mode: 0/0 at one instant has a limit, which is
 * not that solution. Both are looked at here.
 *
 * The Jacobian of the residual form is singular there. A term that holds one open unknown, in one of the equations that
 * depend on the others, makes it regular: as the equations do not contradict each other, their solution is none but
 * that with no change of this unknown. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "undetermined.h"

static const double same = 1e-9;  /* of a derivative: far above rounding, far below any tolerance */
static const double zero = 1e-10; /* of rows and columns of size 1: what rounding may leave of a pivot */
enum { MOST_UNKNOWNS = 1000 };    /* of an elimination with full pivoting: a second */

static rt_status fail(rt_session *s, int equation, int variable, const char *why, const char *open) {
  const char *name = variable < 0 ? "" : s->d->variables[variable].name;
  return rt_fail(s, RT_SINGULAR, s->t, variable, &s->d->equations[equation],
                 "a block of linear equations has no unique solution at time %.9g s%s%s%s%s", s->t, why, name,
                 open[0] ? "; open are " : "", open);
}

/* The variables that differ between v_trial, where what is open has been moved, and v. */
static void name_open(const rt_session *s, char *names, size_t size) {
  for (int k = 0; k < s->d->n_variables; k++) {
    const mdl_variable *v = &s->d->variables[k];
    if (v->storage != MDL_ALGEBRAIC) continue;
    double here = s->data.v[v->index], moved = s->v_trial[v->index];
    if (fabs(moved - here) > same * rt_max(fabs(here), fabs(moved))) rt_append_name(names, size, v->name);
  }
}

/* Elimination of an n x n matrix, some of whose rows and columns have had their turn. */
typedef struct {
  int n, rank, *row, *column;
  double *a;
} elimination;

/* With full pivoting in `columns` columns that are next, as long as there are pivots above `least`. */
static void eliminate(elimination *e, int columns, double least) {
  int n = e->n, *row = e->row, *column = e->column, end = e->rank + columns;
  for (; e->rank < end; e->rank++) {
    int p = -1, q = -1;
    double best = least;
    for (int i = e->rank; i < n; i++)
      for (int j = e->rank; j < end; j++)
        if (fabs(e->a[row[i] * n + column[j]]) > best) best = fabs(e->a[row[i] * n + column[j]]), p = i, q = j;
    if (p < 0) break;
    int r = row[p], c = column[q];
    row[p] = row[e->rank], row[e->rank] = r;
    column[q] = column[e->rank], column[e->rank] = c;
    for (int i = e->rank + 1; i < n; i++) {
      double factor = e->a[row[i] * n + c] / e->a[r * n + c];
      for (int j = e->rank + 1; factor != 0 && j < n; j++)
        e->a[row[i] * n + column[j]] -= factor * e->a[r * n + column[j]];
    }
  }
}

/* Unknowns and equations that are left over: first the algebraic unknowns z, which alone are open and so tell how many,
 * then the states, whose pivots leave the equations to hold them in. */
static void choose(rt_session *s, double *a, int *row, int *column) {
  int n_x = s->d->n_x, n_z = s->d->n_z, n = n_x + n_z;
  elimination e = {n, 0, row, column, a};
  for (int k = 0; k < n; k++)
    row[k] = k, column[k] = (k + n_x) % n;
  eliminate(&e, n_z, zero);
  int open = n_z - e.rank;
  for (int k = 0; k < open; k++)
    s->held[k].column = column[e.rank + k];
  for (int k = 0; k < n_x; k++)
    column[e.rank + k] = k;
  eliminate(&e, n_x, 0);
  s->n_held = e.rank + open == n ? open : 0;
  for (int k = 0; k < s->n_held; k++)
    s->held[k].row = row[e.rank + k];
}

/* Rows, then columns, of size 1 where they hold algebraic unknowns; sizes of rows before, in units of the unknowns. */
static void equilibrate(const rt_session *s, int n, double *a, double *size) {
  for (int i = 0; i < n; i++) {
    double algebraic = size[i] = 0;
    for (int j = 0; j < n; j++) {
      double entry = fabs(a[i * n + j] *= s->nominal[j]);
      size[i] = rt_max(size[i], entry);
      if (j >= s->d->n_x) algebraic = rt_max(algebraic, entry);
    }
    for (int j = 0; algebraic > 0 && j < n; j++)
      a[i * n + j] /= algebraic;
  }
  for (int j = 0; j < n; j++) {
    double largest = 0;
    for (int i = 0; i < n; i++)
      largest = rt_max(largest, fabs(a[i * n + j]));
    for (int i = 0; largest > 0 && i < n; i++)
      a[i * n + j] /= largest;
  }
}

static rt_status hold(rt_session *s, double *values, double *a, double *size, int *order) {
  const mdl_descriptor *d = s->d;
  int n = d->n_x + d->n_z;
  rt_residual_point(s);
  if (rt_jacobian(s, s->t, s->y, s->yp, 1 / (s->stop - s->start), values))
    return rt_fail_model(s, s->t, "evaluating the residual form");
  for (int j = 0; j < n; j++)
    for (int k = d->jac_colptr[j]; k < d->jac_colptr[j + 1]; k++)
      a[d->jac_rowidx[k] * n + j] = values[k];
  equilibrate(s, n, a, size);
  choose(s, a, order, order + n);
  for (int k = 0; k < s->n_held; k++) {
    double row = size[s->held[k].row];
    s->held[k].value = (row > 0 ? row : 1) / s->nominal[s->held[k].column];
  }
  return RT_OK;
}

static rt_status find_held(rt_session *s) {
  size_t n = (size_t)(s->d->n_x + s->d->n_z), nnz = (size_t)s->d->jac_nnz;
  if (!s->d->n_z || n > MOST_UNKNOWNS) return RT_OK;
  double *work = calloc(nnz + n * n + n, sizeof *work);
  int *order = calloc(2 * n, sizeof *order);
  rt_status status = work && order ? hold(s, work, work + nnz, work + nnz + n * n, order)
                                   : rt_fail(s, RT_MEMORY, s->t, -1, NULL, "out of memory");
  free(work);
  free(order);
  return status;
}

/* Said once in a run: the values that stand in the results are one choice of many. `v_trial` is a point of another. */
static void tell(rt_session *s, int equation) {
  char names[200] = "", said[500];
  name_open(s, names, sizeof names);
  if (s->result->told_open || !names[0]) return;
  s->result->told_open = true;
  const mdl_equation *e = &s->d->equations[equation];
  snprintf(said, sizeof said,
           "%s:%d: the equations leave open %s from time %.9g s on; the solution next to zero is taken", e->file,
           e->line, names, s->t);
  rt_result_warn(s->result, said);
}

/* At the start and after an event, with x' and v of the present mode: does it leave unknowns open, and may it? */
rt_status rt_follow_undetermined(rt_session *s) {
  mdl_data *m = &s->data;
  s->n_held = 0;
  s->undetermined = m->undetermined;
  if (!s->undetermined) return RT_OK;
  int equation = s->undetermined - 1;
  memcpy(s->v_trial, m->v, (size_t)s->d->n_v * sizeof *m->v);
  m->shift = 1;
  int status = rt_rhs(s, s->t, m->x, s->xdot_trial, s->v_trial);
  m->shift = 0;
  if (status) return rt_fail_model(s, s->t, "evaluating the explicit form");
  for (int i = 0; i < s->d->n_x; i++) {
    double rate = s->nominal[i] / (s->stop - s->start);
    if (fabs(s->xdot_trial[i] - m->xdot[i]) <= same * rt_max(fabs(m->xdot[i]), rate)) continue;
    char names[200] = "";
    name_open(s, names, sizeof names);
    return fail(s, equation, rt_state_variable(s, i), ", and what it leaves open decides the derivative of ", names);
  }
  tell(s, equation);
  return find_held(s);
}

/* At the end of a step in such a mode: does it still leave them open? */
rt_status rt_check_undetermined(rt_session *s) {
  mdl_data *m = &s->data;
  if (!s->undetermined) return RT_OK;
  memcpy(s->v_trial, m->v, (size_t)s->d->n_v * sizeof *m->v);
  if (rt_rhs(s, s->t, m->x, s->xdot_trial, s->v_trial)) return rt_fail_model(s, s->t, "evaluating the explicit form");
  if (m->undetermined) return RT_OK;
  return fail(s, s->undetermined - 1, -1, ": one that it had at the last event only has no value", "");
}
