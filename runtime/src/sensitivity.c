/* Forward sensitivities: what is asked for, their memory, their start, and their values at a point.
 *
 * What a column is: p of its parameter is 1 (or x of its state, at the start), everything else follows by the model's
 * own derivatives. Parameters are refused that nothing depends on smoothly. */
#include "sensitivity.h"

#include <stdlib.h>
#include <string.h>

static size_t bundle_size(const mdl_descriptor *d, int columns, bool whole) {
  size_t rows = 2 * (size_t)d->n_x + (size_t)d->n_v;
  if (whole) rows += 1 + (size_t)d->n_p + (size_t)d->n_u + 2 * (size_t)d->n_d + (size_t)d->n_x;
  return rows * (size_t)columns;
}

static double *take(double **next, size_t count) {
  double *slice = *next;
  *next += count;
  return slice;
}

/* Rows of a bundle; without `shared` all of them, else those that differ from point to point, the rest being shared's.
 */
static void slice_bundle(const mdl_descriptor *d, mdl_tangent *b, int columns, const mdl_tangent *shared,
                         double **next) {
  size_t n = (size_t)columns;
  if (shared)
    *b = *shared;
  else
    b->lanes = columns / MDL_LANES;
  b->x = (mdl_lanes *)take(next, n * (size_t)d->n_x);
  b->xdot = (mdl_lanes *)take(next, n * (size_t)d->n_x);
  b->v = (mdl_lanes *)take(next, n * (size_t)d->n_v);
  if (shared) return;
  b->t = (mdl_lanes *)take(next, n);
  b->p = (mdl_lanes *)take(next, n * (size_t)d->n_p);
  b->u = (mdl_lanes *)take(next, n * (size_t)d->n_u);
  b->d = (mdl_lanes *)take(next, n * (size_t)d->n_d);
  b->pre_d = (mdl_lanes *)take(next, n * (size_t)d->n_d);
  b->x_after = (mdl_lanes *)take(next, n * (size_t)d->n_x);
}

static bool allocate(const mdl_descriptor *d, rt_sensitivities *f) {
  size_t n = (size_t)f->columns, n_x = (size_t)d->n_x, n_rel = (size_t)d->n_rel, n_sample = (size_t)d->n_sample;
  size_t size = bundle_size(d, f->columns, true) + bundle_size(d, f->columns, false) + bundle_size(d, MDL_LANES, true) +
                n * (6 + n_x + n_rel + 2 * n_sample + (RT_DENSE_DEGREE + 1) * n_x) + n_rel * (1 + MDL_LANES) +
                (size_t)d->n_u + 1;
  double *next = f->numbers = calloc(size, sizeof *next);
  if (!next) return false;
  slice_bundle(d, &f->at, f->columns, NULL, &next);
  slice_bundle(d, &f->inside, f->columns, &f->at, &next);
  slice_bundle(d, &f->probe, MDL_LANES, NULL, &next);
  f->scale = take(&next, n);
  f->weight = take(&next, n);
  f->event_time = take(&next, n);
  f->event_time_before = take(&next, n);
  f->margin = take(&next, n);
  f->tick = take(&next, n);
  f->x_before = take(&next, n * n_x);
  f->guards = take(&next, n * n_rel);
  f->first = take(&next, n * n_sample);
  f->interval = take(&next, n * n_sample);
  f->dense.c = take(&next, n * n_x * (RT_DENSE_DEGREE + 1));
  f->slopes = take(&next, n_rel);
  f->probed = take(&next, n_rel * MDL_LANES);
  f->input_slope = take(&next, (size_t)d->n_u);
  return true;
}

void rt_sensitivities_free(rt_session *s) {
  rt_sensitivities *f = s->sensitivities;
  if (!f) return;
  free(f->variables);
  free(f->numbers);
  free(f);
  s->sensitivities = NULL;
}

/* Why the variable in this row cannot be a column, or NULL. */
static const char *unfit(const mdl_descriptor *d, int row) {
  if (row < 0 || row >= d->n_variables) return "no such variable";
  const mdl_variable *v = &d->variables[row];
  if (v->storage == MDL_STATE) return NULL;
  if (v->storage != MDL_PARAMETER) return "neither a parameter nor a state, whose initial value it would be";
  if (v->type != MDL_REAL) return "not Real: nothing changes smoothly with it";
  if (!v->settable) return "not a parameter of its own: structural, final, or given by other parameters";
  if (!d->tangents->differentiable[v->index])
    return "only in conditions and discrete equations: nothing changes smoothly with it";
  return NULL;
}

static rt_status check(rt_session *s, int n, const int *variables) {
  if (n > 0 && !s->d->tangents)
    return rt_fail(s, RT_ARGUMENT, 0, -1, NULL, "%s was translated without derivatives: ask for sensitivities then",
                   s->d->name);
  if (n > 0 && !s->method->sensitivities)
    return rt_fail(s, RT_ARGUMENT, 0, -1, NULL, "solver %s has no sensitivities; dopri5 and ida have", s->method->name);
  for (int k = 0; k < n; k++) {
    const char *reason = unfit(s->d, variables[k]);
    if (reason)
      return rt_fail(s, RT_ARGUMENT, 0, variables[k], NULL, "no sensitivity with respect to %s: it is %s",
                     variables[k] >= 0 && variables[k] < s->d->n_variables ? s->d->variables[variables[k]].name : "?",
                     reason);
  }
  return RT_OK;
}

rt_status rt_session_sensitivities(rt_session *s, int n, const int *variables) {
  rt_status status = check(s, n, variables);
  if (status) return status;
  rt_sensitivities_free(s);
  if (n > 0) {
    rt_sensitivities *f = s->sensitivities = calloc(1, sizeof *f);
    if (!f) return rt_fail(s, RT_MEMORY, 0, -1, NULL, "out of memory");
    f->n = n;
    f->columns = (n + MDL_LANES - 1) / MDL_LANES * MDL_LANES;
    f->variables = calloc((size_t)n, sizeof *f->variables);
    if (!f->variables || !allocate(s->d, f)) {
      rt_sensitivities_free(s);
      return rt_fail(s, RT_MEMORY, 0, -1, NULL, "out of memory for sensitivities");
    }
    memcpy(f->variables, variables, (size_t)n * sizeof *variables);
  }
  if (!s->method->sensitivities || s->method->sensitivities(s, s->memory)) return RT_OK;
  rt_sensitivities_free(s);
  return rt_fail(s, RT_MEMORY, 0, -1, NULL, "solver %s: out of memory for sensitivities", s->method->name);
}

/* The size of a change of a parameter or initial value: what the model calls nominal, else its value, else its range.
 */
static double scale_of(const rt_session *s, const mdl_variable *v) {
  if (v->storage == MDL_STATE) return s->nominal[v->index];
  double value = s->data.p[v->index];
  if (v->nominal > 0) return v->nominal;
  if (value != 0 && isfinite(value)) return fabs(value);
  return isfinite(v->max - v->min) && v->max > v->min ? v->max - v->min : 0;
}

/* Everything zero but the columns' own parameters; dependent parameters, start values and clocks from them. */
rt_status rt_tangent_start(rt_session *s) {
  const mdl_descriptor *d = s->d;
  rt_sensitivities *f = s->sensitivities;
  memset(f->at.x, 0, bundle_size(d, f->columns, true) * sizeof(double));
  memset(f->event_time_before, 0, (size_t)f->columns * sizeof(double));
  f->lost = false;
  f->t_before =
      s->start; /* nothing moves that: a guard that is passed just after it is about to have been passed before */
  f->t_uncertain = 0;
  f->relation_before = -1;
  f->dense.valid = false;
  for (int k = 0; k < f->n; k++) {
    const mdl_variable *v = &d->variables[f->variables[k]];
    if (v->storage == MDL_PARAMETER) rt_rows(f->at.p)[v->index * f->columns + k] = v->sign;
    f->margin[k] = INFINITY;
  }
  if (d->tangents->parameters(&s->data, &f->at) || d->tangents->starts(&s->data, &f->at) ||
      d->tangents->samples(&s->data, &f->at, (mdl_lanes *)f->first, (mdl_lanes *)f->interval))
    return rt_fail_model(s, s->start, "differentiating start values");
  return RT_OK;
}

/* A state that the caller has set follows no parameter but, in its own column, itself. */
static void override_states(rt_session *s) {
  rt_sensitivities *f = s->sensitivities;
  for (int i = 0; i < s->n_initial; i++)
    memset(rt_rows(f->at.x) + s->initial_index[i] * f->columns, 0, (size_t)f->columns * sizeof(double));
  for (int k = 0; k < f->n; k++) {
    const mdl_variable *v = &s->d->variables[f->variables[k]];
    if (v->storage == MDL_STATE) rt_rows(f->at.x)[v->index * f->columns + k] = v->sign;
  }
}

/* The states that follow from what they begin with. */
static rt_status differentiate_initial_system(rt_session *s) {
  mdl_data *m = &s->data;
  rt_sensitivities *f = s->sensitivities;
  memset(f->at.x, 0, (size_t)(s->d->n_x * f->columns) * sizeof(double));
  if (s->d->tangents->starts(m, &f->at)) return rt_fail_model(s, s->t, "differentiating start values");
  override_states(s);
  if (s->d->tangents->initial_system(m, s->t, m->x, m->xdot, m->v, &f->at))
    return rt_fail_model(s, s->t, "differentiating the initial equations");
  return RT_OK;
}

/* During initialisation: the states, where the initial equations have just been `solved`; then what follows from them.
 */
rt_status rt_tangent_initial(rt_session *s, bool solved) {
  if (!s->sensitivities) return RT_OK;
  if (solved) return differentiate_initial_system(s);
  override_states(s);
  return rt_tangent_evaluate(s);
}

/* During initialisation, after event(): needs when_before, and the states before it in x_swept. */
rt_status rt_tangent_initial_event(rt_session *s) {
  mdl_data *m = &s->data;
  rt_sensitivities *f = s->sensitivities;
  if (!f) return RT_OK;
  size_t x_size = (size_t)(s->d->n_x * f->columns) * sizeof(double),
         d_size = (size_t)(s->d->n_d * f->columns) * sizeof(double);
  memcpy(m->when, s->when_before, (size_t)s->d->n_when);
  memcpy(f->at.x_after, f->at.x, x_size);
  int status = s->d->tangents->event(m, s->t, s->x_swept, m->xdot, m->v, &f->at);
  memcpy(f->at.x, f->at.x_after, x_size);
  memcpy(f->at.pre_d, f->at.d, d_size);
  return status ? rt_fail_model(s, s->t, "differentiating the first event") : RT_OK;
}

/* All events of the start have happened: what the columns are measured by, and the tangents to set out with. */
rt_status rt_tangent_begin(rt_session *s) {
  rt_sensitivities *f = s->sensitivities;
  for (int k = 0; k < f->n; k++)
    f->scale[k] = scale_of(s, &s->d->variables[f->variables[k]]);
  for (int k = 0; k < f->columns; k++)
    f->weight[k] = k >= f->n ? 1 : f->scale[k] > 0 ? 1 / f->scale[k] : INFINITY;
  if (s->d->tangents->rounds) rt_result_flag(s->result, s->start, RT_FLAG_ROUNDING, -1, -1);
  rt_status status = rt_tangent_evaluate(s);
  rt_tangent_check_finite(s);
  return status;
}

/* xdot and v of `at` from its x, at the session's point. */
rt_status rt_tangent_evaluate(rt_session *s) {
  mdl_data *m = &s->data;
  rt_sensitivities *f = s->sensitivities;
  if (f->lost) return RT_OK;
  f->complete = true;
  if (s->d->n_u) rt_inputs_at(s, s->t);
  if (s->d->tangents->rhs(m, s->t, m->x, m->xdot, m->v, &f->at))
    return rt_fail_model(s, s->t, "differentiating the model");
  s->result->counters.tangents++;
  return RT_OK;
}

/* The step was cut short by an event at t: its polynomial gives the states' tangents there. */
rt_status rt_tangent_follow(rt_session *s) {
  rt_sensitivities *f = s->sensitivities;
  if (!f || f->lost) return RT_OK;
  if ((s->t == s->t_end && !s->in_pieces)) return RT_OK;
  rt_tangent_inside(s, s->t);
  memcpy(f->at.x, f->inside.x, (size_t)(s->d->n_x * f->columns) * sizeof(double));
  f->complete = false;
  return RT_OK;
}

/* x of `inside` at a point of the last step. */
void rt_tangent_inside(rt_session *s, double t) {
  rt_sensitivities *f = s->sensitivities;
  if (f->lost) return;
  if (!f->dense.valid) s->method->dense_tangent(s, s->memory, &f->dense);
  f->dense.valid = true;
  rt_dense_eval(&f->dense, s->d->n_x * f->columns, t, rt_rows(f->inside.x));
}

/* xdot and v of `inside` from its x. */
int rt_tangent_inside_point(rt_session *s, double t, const double *x, const double *xdot, const double *v) {
  rt_sensitivities *f = s->sensitivities;
  if (f->lost) return 0;
  s->result->counters.tangents++;
  return s->d->tangents->rhs(&s->data, t, x, xdot, v, &f->inside);
}

/* From here on there are no sensitivities: they are not a number in every row, and a flag says why. */
void rt_tangent_lose(rt_session *s, rt_flag_kind kind, int relation) {
  rt_sensitivities *f = s->sensitivities;
  if (f->lost) return;
  f->lost = true;
  rt_result_flag(s->result, s->t, kind, relation, -1);
}

/* Overflow, or a derivative that does not exist (a root at zero) must not pass for a number. */
void rt_tangent_check_finite(rt_session *s) {
  rt_sensitivities *f = s->sensitivities;
  double sum = 0;
  const double *x = rt_rows(f->at.x), *xdot = rt_rows(f->at.xdot);
  for (int i = 0; i < s->d->n_x * f->columns; i++)
    sum += (x[i] - x[i]) + (xdot[i] - xdot[i]);
  if (sum != 0) rt_tangent_lose(s, RT_FLAG_NONFINITE, -1);
}
