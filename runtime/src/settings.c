/* What a caller sets before a run: parameters, initial values, inputs, what is recorded and when. */
#include <math.h>
#include <stdlib.h>

#include "session.h"

const rt_failure *rt_session_failure(const rt_session *s) {
  return &s->failure;
}

static rt_status refuse(rt_session *s, const char *what) {
  return rt_fail(s, RT_ARGUMENT, 0, -1, NULL, "%s", what);
}

static const mdl_variable *variable(const rt_session *s, int row) {
  return row >= 0 && row < s->d->n_variables ? &s->d->variables[row] : NULL;
}

void rt_session_declared(rt_session *s) {
  for (int i = 0; i < s->d->n_p; i++)
    s->p_run[i] = s->d->p_start[i];
}

/* A value that v does not take: of a Real, one that is not finite. */
static rt_status refuse_type(rt_session *s, int row, double t, const char *what, double value) {
  const mdl_variable *v = &s->d->variables[row];
  const char *type = v->type == MDL_BOOLEAN   ? "Boolean (0 or 1)"
                     : v->type == MDL_INTEGER ? "of whole numbers below 2^53"
                                              : "a Real, which is finite";
  return rt_fail(s, RT_ARGUMENT, t, row, NULL, "%s %s cannot be %.17g: it is %s", what, v->name, value, type);
}

rt_status rt_session_parameters(rt_session *s, int n, const int *variables, const double *values) {
  rt_session_declared(s);
  for (int i = 0; i < n; i++) {
    const mdl_variable *v = variable(s, variables[i]);
    if (!v || v->storage != MDL_PARAMETER || !v->settable) return refuse(s, "not a parameter that may be set");
    if (!(values[i] >= v->min && values[i] <= v->max))
      return rt_fail_bound(s, 0, variables[i], values[i], v->min, v->max);
    if (!rt_has_type(v, values[i])) return refuse_type(s, variables[i], 0, "parameter", values[i]);
    s->p_run[v->index] = v->sign * values[i];
  }
  return RT_OK;
}

rt_status rt_session_initial(rt_session *s, int n, const int *variables, const double *values) {
  s->n_initial = 0;
  for (int i = 0; i < n; i++) {
    const mdl_variable *v = variable(s, variables[i]);
    if (!v || v->storage != MDL_STATE || i >= s->d->n_x)
      return refuse(s, "not a state: its initial value cannot be set");
    s->initial_index[i] = v->index;
    s->initial_value[i] = v->sign * values[i];
    s->n_initial = i + 1;
  }
  return RT_OK;
}

rt_status rt_session_input(rt_session *s, int row, int n, const double *time, const double *values,
                           rt_interpolation interpolation) {
  const mdl_variable *v = variable(s, row);
  if (!v || v->storage != MDL_INPUT || v->sign != 1) return refuse(s, "not an input of the model");
  for (int k = 0; k < n; k++) {
    if (k && !(time[k] > time[k - 1]))
      return rt_fail(s, RT_ARGUMENT, time[k], row, NULL, "samples of input %s: time does not increase at %.9g s",
                     v->name, time[k]);
    if (!isfinite(time[k]) || !isfinite(values[k]))
      return rt_fail(s, RT_ARGUMENT, time[k], row, NULL, "samples of input %s: not a finite number at %.9g s", v->name,
                     time[k]);
    if (!rt_has_type(v, values[k])) return refuse_type(s, row, time[k], "input", values[k]);
  }
  s->inputs[v->index] = (rt_input){.time = time, .values = values, .n = n, .interpolation = interpolation};
  return RT_OK;
}

rt_status rt_session_outputs(rt_session *s, int n, const int *variables) {
  rt_output *outputs = calloc((size_t)n + 1, sizeof *outputs);
  if (!outputs) return rt_fail(s, RT_MEMORY, 0, -1, NULL, "out of memory");
  free(s->recorder.outputs);
  s->recorder.outputs = outputs;
  s->recorder.n = 0;
  s->recorder.needs_rhs = s->recorder.needs_point = false;
  for (int i = 0; i < n; i++) {
    const mdl_variable *v = variable(s, variables[i]);
    if (!v) return refuse(s, "no such variable to record");
    outputs[i] = (rt_output){.storage = v->storage, .index = v->index, .sign = v->sign};
    s->recorder.needs_rhs |= v->storage == MDL_ALGEBRAIC || v->storage == MDL_DERIVATIVE;
    s->recorder.needs_point |= s->recorder.needs_rhs || v->storage == MDL_INPUT;
    s->recorder.n = i + 1;
  }
  return RT_OK;
}

void rt_session_tolerances(const rt_session *s, double *rtol, double *atol) {
  *rtol = s->options.rtol;
  *atol = s->options.atol;
}

rt_status rt_session_grid(rt_session *s, int n, const double *times, double interval) {
  for (int i = 0; i < n; i++)
    if (!(i ? times[i] >= times[i - 1] : isfinite(times[i]))) return refuse(s, "output times must not decrease");
  if (!(interval >= 0) || isinf(interval))
    return refuse(s, "the output interval must not be negative, infinite or NaN");
  s->recorder.grid = times;
  s->recorder.n_grid = n;
  s->recorder.interval = interval;
  return RT_OK;
}
