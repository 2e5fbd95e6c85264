/* Sessions: memory for one model and one solver, and what the caller sets before a run. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "delay.h"
#include "sensitivity.h"
#include "transport.h"
#include "undetermined.h"

/* With RT_OWN_METHODS the runtime is ours alone, without SUNDIALS: what an FMU carries as source. */
static const rt_method *const methods[] = {
#ifndef RT_OWN_METHODS
    &rt_method_ida,
#endif
    &rt_method_dopri5, &rt_method_rodas4, &rt_method_rk4, &rt_method_euler};
enum { N_METHODS = sizeof methods / sizeof *methods };

static const rt_method *find_method(const char *name) {
  for (int i = 0; i < N_METHODS; i++)
    if (strcmp(methods[i]->name, name) == 0) return methods[i];
  return NULL;
}

#define COUNT(array) (sizeof(array) / sizeof *(array))

typedef struct {
  double **const *places;
  size_t count;
  int n;
} group;

/* Hand out slices of one block, so that there is one thing to check and one to free. */
static bool allocate_numbers(rt_session *s) {
  const mdl_descriptor *d = s->d;
  mdl_data *m = &s->data;
  rt_recorder *r = &s->recorder;
  double **parameters[] = {&m->p, &s->p_run}, **inputs[] = {&m->u},
         **discrete[] = {&m->d, &m->pre_d, &s->d_swept, &s->d_before, &s->d_after};
  double **unknowns[] = {&s->range, &s->outgrown, &s->atol, &s->y, &s->yp},
         **samples[] = {&s->clock.first, &s->clock.interval};
  double **algebraic[] = {&m->v, &s->v_trial, &s->v_before, &s->v_end, &r->v}, **dense[] = {&s->dense.c};
  double **states[] = {&m->x,           &m->xdot,  &s->initial_value, &s->x_trial, &s->xdot_trial, &s->x_before,
                       &s->xdot_before, &s->x_end, &s->xdot_end,      &r->x,       &r->xdot,       &s->x_swept};
  double **sizes[] = {&s->nominal}, **division[] = {&s->division};
  double **guards[] = {&s->g,      &s->g_previous, &s->g_low,         &s->g_trial,       &s->g_before,
                       &s->g_span, &s->g_travel,   &s->changed_at[0], &s->changed_at[1], &s->due_back};
  double **turns[] = {&s->phase, &s->phase_start};
  const group groups[] = {{parameters, COUNT(parameters), d->n_p},
                          {inputs, COUNT(inputs), d->n_u},
                          {discrete, COUNT(discrete), d->n_d},
                          {unknowns, COUNT(unknowns), d->n_x + d->n_z},
                          {samples, COUNT(samples), d->n_sample},
                          {algebraic, COUNT(algebraic), d->n_v},
                          {dense, COUNT(dense), (RT_DENSE_DEGREE + 1) * d->n_x},
                          {states, COUNT(states), d->n_x},
                          {sizes, COUNT(sizes), d->n_x + d->n_z + d->n_rel},
                          {division, COUNT(division), 2 * d->n_divisions},
                          {guards, COUNT(guards), d->n_rel},
                          {turns, COUNT(turns), d->n_phases}};
  s->n_numbers = 1;
  for (size_t i = 0; i < COUNT(groups); i++)
    s->n_numbers += groups[i].count * (size_t)groups[i].n;
  double *next = s->numbers = calloc(s->n_numbers, sizeof *next);
  for (size_t i = 0; next && i < COUNT(groups); i++)
    for (size_t j = 0; j < groups[i].count; j++, next += groups[i].n)
      *groups[i].places[j] = next;
  s->g_nominal = s->nominal + d->n_x + d->n_z;
  return s->numbers != NULL;
}

static bool allocate_flags(rt_session *s) {
  const mdl_descriptor *d = s->d;
  mdl_data *m = &s->data;
  unsigned char **relations[] = {&m->rel, &s->flip, &s->rel_before, &s->rel_trial, &s->rel_swept};
  s->n_flags = COUNT(relations) * (size_t)d->n_rel + (size_t)(d->n_sample + 2 * d->n_when + d->n_divisions) + 1;
  unsigned char *next = s->flags = calloc(s->n_flags, 1);
  if (!next) return false;
  for (size_t i = 0; i < COUNT(relations); i++, next += d->n_rel)
    *relations[i] = next;
  m->tick = next;
  m->when = next + d->n_sample;
  s->when_before = m->when + d->n_when;
  s->division_sign = (signed char *)s->when_before + d->n_when;
  return true;
}

static bool allocate_session(rt_session *s) {
  s->inputs = calloc((size_t)s->d->n_u + 1, sizeof *s->inputs);
  s->clock.next = calloc((size_t)s->d->n_sample + 1, sizeof *s->clock.next);
  s->initial_index = calloc((size_t)s->d->n_x + 1, sizeof *s->initial_index);
  s->held = calloc((size_t)(s->d->n_x + s->d->n_z) + 1, sizeof *s->held);
  return s->inputs && s->held && s->clock.next && s->initial_index && allocate_numbers(s) && allocate_flags(s) &&
         rt_delays_create(s) && rt_transports_create(s);
}

static void declared_parameters(rt_session *s) {
  for (int i = 0; i < s->d->n_p; i++)
    s->p_run[i] = s->d->p_start[i];
}

rt_session *rt_session_new(const rt_model *model, const rt_options *options, char *message, size_t size) {
  const rt_method *method = find_method(options->solver);
  if (!method) {
    snprintf(message, size, "unknown solver \"%s\"; there are ida, dopri5, rodas4, rk4, euler", options->solver);
    return NULL;
  }
  if (method->needs_step && !(options->step > 0)) {
    snprintf(message, size, "solver %s needs a step (s) greater than zero", method->name);
    return NULL;
  }
  if (options->rtol >= 1) {
    snprintf(message, size, "a relative tolerance of %.9g keeps no digit: give one below 1, such as 1e-6",
             options->rtol);
    return NULL;
  }
  rt_session *s = calloc(1, sizeof *s);
  if (!s) return NULL;
  s->model = model;
  s->d = model->descriptor;
  s->options = *options;
  /* a model without states has nothing to integrate: any method with step size control only walks along its events */
  s->method = s->d->n_x == 0 && method->multistep ? &rt_method_dopri5 : method;
  s->options.solver = s->method->name;
  bool done = allocate_session(s);
  if (done) {
    declared_parameters(s);
    if (!(s->options.rtol > 0)) s->options.rtol = s->d->tolerance > 0 ? s->d->tolerance : 1e-6;
    s->atol_given = s->options.atol > 0;
    if (!s->atol_given) s->options.atol = 0.01 * s->options.rtol;
    s->memory = s->method->create(s);
  }
  if (s->memory) return s;
  snprintf(message, size, "cannot set up solver %s: out of memory", method->name);
  rt_session_free(s);
  return NULL;
}

void rt_session_free(rt_session *s) {
  if (!s) return;
  rt_sensitivities_free(s);
  rt_delays_free(s);
  rt_transports_free(s);
  if (s->memory) s->method->destroy(s->memory);
  free(s->inputs);
  free(s->held);
  free(s->clock.next);
  free(s->initial_index);
  free(s->recorder.outputs);
  free(s->numbers);
  free(s->flags);
  free(s);
}

const rt_failure *rt_session_failure(const rt_session *s) {
  return &s->failure;
}

static rt_status refuse(rt_session *s, const char *what) {
  return rt_fail(s, RT_ARGUMENT, 0, -1, NULL, "%s", what);
}

static const mdl_variable *variable(const rt_session *s, int row) {
  return row >= 0 && row < s->d->n_variables ? &s->d->variables[row] : NULL;
}

rt_status rt_session_parameters(rt_session *s, int n, const int *variables, const double *values) {
  declared_parameters(s);
  for (int i = 0; i < n; i++) {
    const mdl_variable *v = variable(s, variables[i]);
    if (!v || v->storage != MDL_PARAMETER || !v->settable) return refuse(s, "not a parameter that may be set");
    if (!(values[i] >= v->min && values[i] <= v->max))
      return rt_fail_bound(s, 0, variables[i], values[i], v->min, v->max);
    if (!rt_has_type(v, values[i]))
      return rt_fail(s, RT_ARGUMENT, 0, variables[i], NULL, "parameter %s cannot be %.17g: it is %s", v->name,
                     values[i], v->type == MDL_BOOLEAN ? "Boolean (0 or 1)" : "of whole numbers up to 2^53");
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
