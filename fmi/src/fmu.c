/* The life of an instance: memory, initialisation, the end. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fmu.h"

static bool new_session(fmu *f) {
  char message[300];
  rt_options options = {.solver = fmu_configuration.solver, .rtol = fmu_configuration.rtol, .locate_events = 1};
  rt_session *s = f->session = rt_session_new(&f->model, &options, message, sizeof message);
  if (!s) return fmu_refuse(f, "%s", message);
  s->result = rt_result_new(0, 0, s->d->n_p, 4);
  if (!s->result) return fmu_refuse(f, "out of memory");
  f->last_stop = INFINITY;
  f->warnings_said = 0;
  s->start = fmu_configuration.start_time;
  s->stop = fmu_configuration.stop_time;
  s->t = s->start;
  for (int i = 0; i < fmu_configuration.n_parameters; i++)
    s->p_run[fmu_configuration.parameter[i]] = fmu_configuration.value[i];
  return true;
}

/* Each input is one sample, which holds always: what the importer has set last. */
static void drive(fmu *f) {
  static const double always = 0;
  const mdl_descriptor *d = f->session->d;
  for (int i = 0; i < d->n_variables; i++)
    if (d->variables[i].storage == MDL_INPUT)
      f->input[d->variables[i].index] = d->variables[i].sign * d->variables[i].start;
  for (int i = 0; i < d->n_u; i++)
    f->session->inputs[i] = (rt_input){.time = &always, .values = f->input + i, .n = 1, .interpolation = RT_HOLD};
}

static bool begin_life(fmu *f) {
  if (!new_session(f)) return false;
  drive(f);
  f->mode = FMU_SETUP;
  f->begun = f->fresh = f->retuned = f->untuned = f->driven = false;
  return true;
}

static void end_session(fmu *f) {
  if (!f->session) return;
  rt_result_free(f->session->result);
  rt_session_free(f->session);
  f->session = NULL;
}

static double *take(double **next, int n) {
  double *slice = *next;
  *next += (size_t)n * MDL_LANES;
  return slice;
}

static bool allocate(fmu *f) {
  const mdl_descriptor *d = f->model.descriptor;
  size_t rows = 1 + (size_t)d->n_p + (size_t)d->n_u + 3 * (size_t)d->n_x + (size_t)d->n_v + 2 * (size_t)d->n_d;
  f->input = calloc((size_t)d->n_u + 1, sizeof *f->input);
  f->indicator = calloc((size_t)d->n_rel + 1, sizeof *f->indicator);
  double *next = f->tangent_rows = calloc(rows * MDL_LANES, sizeof *next);
  if (!f->input || !f->indicator || !next) return false;
  f->tangent.lanes = 1;
  struct {
    mdl_lanes **place;
    int n;
  } parts[] = {{&f->tangent.t, 1},      {&f->tangent.p, d->n_p},     {&f->tangent.u, d->n_u},
               {&f->tangent.x, d->n_x}, {&f->tangent.v, d->n_v},     {&f->tangent.xdot, d->n_x},
               {&f->tangent.d, d->n_d}, {&f->tangent.pre_d, d->n_d}, {&f->tangent.x_after, d->n_x}};
  for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
    *parts[i].place = (mdl_lanes *)take(&next, parts[i].n);
  for (int r = 0; r < d->n_rel; r++)
    if (!(d->relations[r].kind & MDL_OF_TIME)) f->indicator[f->n_indicators++] = r;
  return true;
}

bool fmu_create(fmu *f, const char *name, const char *token) {
  if (!name || !*name) return fmu_refuse(f, "an instance needs a name");
  if (!token || strcmp(token, fmu_configuration.token) != 0)
    return fmu_refuse(f, "this binary belongs to another model description: its token is %s, not %s",
                      fmu_configuration.token, token ? token : "none");
  f->model.descriptor = mdl_descriptor_get();
  if (f->model.descriptor->n_delay && !f->co_simulation)
    return fmu_refuse(f, "delay() looks back into steps of its own: co-simulation only");
  f->name = malloc(strlen(name) + 1);
  if (!f->name || !allocate(f)) return fmu_refuse(f, "out of memory");
  strcpy(f->name, name);
  return begin_life(f);
}

void fmu_destroy(fmu *f) {
  if (!f) return;
  end_session(f);
  free(f->input);
  free(f->indicator);
  free(f->tangent_rows);
  free(f->name);
  free(f);
}

bool fmu_reset(fmu *f) {
  end_session(f);
  return begin_life(f);
}

/* `stop` NAN: not known, `tolerance` 0: the model's own. */
bool fmu_enter_initialisation(fmu *f, double start, double stop, double tolerance) {
  rt_session *s = f->session;
  if (f->mode != FMU_SETUP) return fmu_refuse(f, "initialisation begins once, after instantiation or reset");
  double span = fmu_configuration.stop_time - fmu_configuration.start_time;
  s->start = s->t = start;
  f->last_stop = isnan(stop) ? INFINITY : stop;
  s->stop = isnan(stop) || !(stop > start) ? start + (span > 0 ? span : 1) : stop;
  if (tolerance > 0) {
    s->options.rtol = tolerance;
    s->options.atol = 0.01 * tolerance;
  }
  f->mode = FMU_INITIALISATION;
  return true;
}

bool fmu_exit_initialisation(fmu *f) {
  if (f->mode != FMU_INITIALISATION) return fmu_refuse(f, "initialisation has not begun");
  if (!fmu_refresh(f)) return false;
  f->mode = f->co_simulation && !f->event_mode ? FMU_STEP : FMU_EVENT;
  f->retuned = f->untuned = f->driven = false;
  return true;
}

/* The last event of a run, with terminal() true. */
bool fmu_terminate(fmu *f) {
  if (f->mode == FMU_SETUP || f->mode == FMU_INITIALISATION || f->mode == FMU_DONE)
    return fmu_refuse(f, "nothing is running that could be terminated");
  f->mode = FMU_DONE;
  f->session->data.terminal = 1;
  f->fresh = false;
  return fmu_done(f, rt_iterate_event(f->session));
}
