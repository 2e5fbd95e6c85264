/* Recording: rows of the chosen variables on the output grid and at events. */
#include <math.h>
#include <string.h>

#include "sensitivity.h"

static bool on_grid(const rt_recorder *r) {
  return r->n_grid > 0 || r->interval > 0;
}

/* Time of grid point `i`; infinite after the last. Where the interval does not divide the run, the stop time is one,
 * too: a run's last row is its end. */
static double grid_time(const rt_session *s, long i) {
  const rt_recorder *r = &s->recorder;
  if (r->n_grid > 0) return i < r->n_grid ? r->grid[i] : INFINITY;
  double t = s->start + (double)i * r->interval, left = s->stop - t;
  if (left >= -s->clock.tolerance) return t;
  return left + r->interval > s->clock.tolerance ? s->stop : INFINITY;
}

void rt_record_begin(rt_session *s) {
  s->recorder.next = 0;
  while (on_grid(&s->recorder) && grid_time(s, s->recorder.next) < s->start - s->clock.tolerance)
    s->recorder.next++;
}

static rt_status reserve(rt_session *s, size_t rows) {
  if (s->result->rows + rows <= s->result->capacity) return RT_OK;
  if ((double)(s->result->rows + rows) * (s->recorder.n + 2) > RT_MOST_VALUES)
    return rt_fail(s, RT_MEMORY, s->t, -1, NULL, "more than %.0g values are recorded up to time %.9g s", RT_MOST_VALUES,
                   s->t);
  if (rt_result_reserve(s->result, s->result->rows + rows)) return RT_OK;
  return rt_fail(s, RT_MEMORY, s->t, -1, NULL, "out of memory for results");
}

/* The derivatives of the row's outputs, one column of the result for each output and parameter. */
static void write_tangents(rt_session *s, size_t row, const mdl_tangent *at) {
  const rt_sensitivities *f = s->sensitivities;
  mdl_lanes *const storage[] = {[MDL_STATE] = at->x,     [MDL_ALGEBRAIC] = at->v, [MDL_DISCRETE] = at->d,
                                [MDL_PARAMETER] = at->p, [MDL_INPUT] = NULL,      [MDL_DERIVATIVE] = at->xdot};
  double **column = s->result->columns + s->recorder.n;
  for (int j = 0; j < s->recorder.n; j++) {
    const rt_output *o = &s->recorder.outputs[j];
    const double *tangents = o->storage == MDL_INPUT ? NULL : rt_rows(storage[o->storage]) + o->index * f->columns;
    for (int k = 0; k < f->n; k++)
      (*column++)[row] = f->lost ? NAN : tangents ? o->sign * tangents[k] : 0;
  }
}

/* A row from the complete point (t, x, xdot, v), with its tangents where there are any. */
static rt_status write_row(rt_session *s, double t, const double *x, const double *xdot, const double *v,
                           const mdl_tangent *tangents, unsigned char event) {
  const mdl_data *m = &s->data;
  const double *storage[] = {[MDL_STATE] = x,        [MDL_ALGEBRAIC] = v, [MDL_DISCRETE] = m->d,
                             [MDL_PARAMETER] = m->p, [MDL_INPUT] = m->u,  [MDL_DERIVATIVE] = xdot};
  rt_status status = reserve(s, 1);
  if (status) return status;
  rt_result *result = s->result;
  result->time[result->rows] = t;
  result->event[result->rows] = event;
  for (int j = 0; j < s->recorder.n; j++) {
    const rt_output *o = &s->recorder.outputs[j];
    result->columns[j][result->rows] = o->sign * storage[o->storage][o->index];
  }
  if (tangents) write_tangents(s, result->rows, tangents);
  result->rows++;
  return RT_OK;
}

/* A row at the session's point. */
static rt_status write_present(rt_session *s, double t, unsigned char event) {
  const mdl_data *m = &s->data;
  rt_sensitivities *f = s->sensitivities;
  if (f && s->recorder.needs_rhs && !f->complete && rt_tangent_evaluate(s)) return s->failure.status;
  return write_row(s, t, m->x, m->xdot, m->v, f ? &f->at : NULL, event);
}

static rt_status tangents_inside(rt_session *s, double t, const mdl_tangent **tangents) {
  const rt_recorder *r = &s->recorder;
  *tangents = NULL;
  if (!s->sensitivities) return RT_OK;
  *tangents = &s->sensitivities->inside;
  rt_tangent_inside(s, t);
  if (!r->needs_rhs || !rt_tangent_inside_point(s, t, r->x, r->xdot, r->v)) return RT_OK;
  return rt_fail_model(s, t, "differentiating outputs");
}

/* A row inside the last step. States come from its polynomial; what else is wanted is computed from them by the
 * explicit form, from the row before on: of several solutions of a nonlinear block, the one that time leads to. */
static rt_status write_interpolated(rt_session *s, double t) {
  rt_recorder *r = &s->recorder;
  rt_dense_point(s, t, r->x);
  if (r->needs_rhs) {
    bool found = !rt_rhs(s, t, r->x, r->xdot, r->v);
    rt_status status = rt_branch_row(s, t, r->xdot, r->v, found);
    if (!status) status = rt_check_values(s, t, r->x, r->xdot, r->v);
    if (!status && !s->options.unchecked && rt_check_settled(s, s->data.unsettled))
      status = rt_fail_model(s, t, "computing variables");
    if (status) return status;
  } else {
    rt_inputs_at(s, t);
  }
  const mdl_tangent *tangents;
  rt_status status = tangents_inside(s, t, &tangents);
  return status ? status : write_row(s, t, r->x, r->xdot, r->v, tangents, 0);
}

enum { MANY = 64 }; /* rows at once */

/* The polynomial of a state in rows of theta; inline, so that a known degree unrolls. */
static inline __attribute__((always_inline)) void write_state(int degree, const double *c, int n, double sign, int rows,
                                                              const double *theta, double *column) {
  double a[RT_DENSE_DEGREE + 1];
  for (int j = 0; j <= degree; j++)
    a[j] = c[j * n];
  for (int k = 0; k < rows; k++) {
    double sum = a[degree];
    for (int j = degree; j-- > 0;)
      sum = sum * theta[k] + a[j];
    column[k] = sign * sum;
  }
}

/* A column of rows inside the last step, where (t - t0) / h is theta[rows], of what is a state or constant there. */
static void write_column(const rt_session *s, const rt_output *o, int rows, const double *theta, double *column) {
  const rt_dense *dense = &s->dense;
  const double sign = o->sign, *c = dense->c + o->index;
  const int n = s->d->n_x;
  if (o->storage != MDL_STATE) {
    double value = sign * (o->storage == MDL_PARAMETER ? s->data.p : s->data.d)[o->index];
    for (int k = 0; k < rows; k++)
      column[k] = value;
  } else if (dense->degree == 4) { /* as that of dopri5 */
    write_state(4, c, n, sign, rows, theta, column);
  } else if (dense->degree == 5) { /* as IDA's mostly */
    write_state(5, c, n, sign, rows, theta, column);
  } else {
    write_state(dense->degree, c, n, sign, rows, theta, column);
  }
}

/* Rows from grid point *t on that are before `inside`, of a step in which nothing but states changes; *t is the first
 * grid point behind them. */
static rt_status write_states(rt_session *s, double inside, double *t) {
  rt_dense_prepare(s);
  rt_result *result = s->result;
  double theta[MANY];
  while (*t < inside) {
    rt_status status = reserve(s, 1);
    if (status) return status;
    const size_t first = result->rows, room = result->capacity - first;
    const int most = room < MANY ? (int)room : MANY;
    int rows = 0;
    for (; *t < inside && rows < most; *t = grid_time(s, ++s->recorder.next)) {
      theta[rows] = (*t - s->dense.t0) / s->dense.h;
      result->time[first + (size_t)rows++] = *t;
    }
    memset(result->event + first, 0, (size_t)rows);
    result->rows += (size_t)rows;
    for (int j = 0; j < s->recorder.n; j++)
      write_column(s, &s->recorder.outputs[j], rows, theta, result->columns[j] + first);
  }
  return RT_OK;
}

/* Grid points of the last step: those before its end, or with `closed` up to its end. */
static rt_status record_grid(rt_session *s, bool closed) {
  rt_recorder *r = &s->recorder;
  rt_status status = RT_OK;
  if (!on_grid(r)) return status;
  double inside = s->t - s->clock.tolerance, end = closed ? s->t + s->clock.tolerance : inside;
  double t = grid_time(s, r->next);
  if (t > end) return status;
  if (t < inside && !r->needs_point && !s->sensitivities) status = write_states(s, inside, &t);
  for (; !status && t <= end; t = grid_time(s, ++r->next)) {
    if (t < inside) {
      status = write_interpolated(s, t);
      continue;
    }
    rt_inputs_at(s, s->t);
    status = write_present(s, t, 0);
  }
  return status;
}

/* What the end of a step adds to the record. What happens at events adds its own rows. */
rt_status rt_record_step(rt_session *s) {
  if (on_grid(&s->recorder)) return record_grid(s, !s->pending);
  bool event_rows_follow = s->options.record_events && s->pending & ~RT_PENDING_INPUT;
  return event_rows_follow ? RT_OK : write_present(s, s->t, 0);
}

/* The last rows. What happened at the end stands in the row of the end, which the last step may have written; an end
 * that the model sets lies between two points of the grid and is a row of its own, unless the points were given. */
rt_status rt_record_end(rt_session *s) {
  rt_result *r = s->result;
  rt_status status = record_grid(s, true);
  if (status || !r->rows) return status;
  size_t last = r->rows - 1;
  if (r->time[last] < s->t - s->clock.tolerance) {
    if (!s->data.terminated || s->recorder.n_grid) return status;
    rt_inputs_at(s, s->t);
    return write_present(s, s->t, 0);
  }
  if (s->sensitivities || !s->d->n_d) return status;
  r->rows--;
  rt_inputs_at(s, s->t);
  return write_present(s, r->time[last], r->event[last]);
}

/* A row at an event, before or after it; after it, it stands for a grid point at the same instant too. */
rt_status rt_record_event_row(rt_session *s) {
  while (on_grid(&s->recorder) && grid_time(s, s->recorder.next) <= s->t + s->clock.tolerance)
    s->recorder.next++;
  rt_inputs_at(s, s->t);
  return write_present(s, s->t, 1);
}
