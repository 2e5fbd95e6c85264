/* Values of variables by reference, read and set, and derivatives of some by others. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fmu.h"

/* Results that a curved guard is looked at for (runtime/src/looks.c), as many as a run without an interval has; none is
 * recorded: there is no grid point but the start. */
static const double looks = 500, never = 1e300;

static bool is_before_start(const fmu *f) {
  return f->mode == FMU_SETUP || f->mode == FMU_INITIALISATION;
}

/* Everything belongs to what is set now: the initial equations solved, xdot and v computed. */
bool fmu_refresh(fmu *f) {
  rt_session *s = f->session;
  if (is_before_start(f)) {
    if (f->begun) return true;
    s->result->rows = 0;
    s->recorder.interval = (s->stop - s->start) / looks;
    f->begun = f->fresh = fmu_done(f, rt_begin(s));
    s->recorder.interval = never;
    return f->begun;
  }
  if (f->fresh) return true;
  if (f->untuned && !fmu_retune(f)) return false;
  s->input_time = NAN;
  s->data.contraction = (mdl_contraction){0};
  f->fresh = !rt_evaluate(s);
  if (f->fresh && f->mode == FMU_CONTINUOUS) fmu_follow(f);
  return f->fresh || fmu_done(f, rt_fail_model(s, s->t, "evaluating the model"));
}

/* What is computed belongs to other values than those set now. */
static void outdate(fmu *f) {
  f->fresh = false;
  if (is_before_start(f)) f->begun = false;
}

static const mdl_variable *row_of(const fmu *f, unsigned reference) {
  const mdl_descriptor *d = f->model.descriptor;
  return reference >= 1 && reference <= (unsigned)d->n_variables ? &d->variables[reference - 1] : NULL;
}

typedef struct {
  mdl_storage storage;
  int index;
  double sign;
} place;

/* Where a variable's number is: of a row, of a state's derivative, or of a state that no row stands for. False for all
 * else, event indicators among them. */
static bool place_of(const fmu *f, unsigned reference, place *found) {
  const mdl_descriptor *d = f->model.descriptor;
  const mdl_variable *v = row_of(f, reference);
  unsigned derivatives = 1 + (unsigned)d->n_variables, n = (unsigned)d->n_x;
  unsigned states = derivatives + n + (unsigned)f->n_indicators;
  if (v)
    *found = (place){v->storage, v->index, v->sign};
  else if (reference >= derivatives && reference < derivatives + n)
    *found = (place){MDL_DERIVATIVE, (int)(reference - derivatives), 1};
  else if (reference >= states && reference < states + n)
    *found = (place){MDL_STATE, (int)(reference - states), 1};
  else
    return false;
  return true;
}

static bool get_indicator(fmu *f, unsigned reference, double *value) {
  const mdl_descriptor *d = f->model.descriptor;
  unsigned first = 1 + (unsigned)d->n_variables + (unsigned)d->n_x;
  if (reference < first || reference >= first + (unsigned)f->n_indicators)
    return fmu_refuse(f, "there is no variable with the value reference %u", reference);
  int r = f->indicator[reference - first];
  double margin = rt_margin(f->session, r, f->session->g[r]);
  *value = f->session->data.rel[r] ? margin : -margin;
  return true;
}

/* Constants and parameters are there before anything is solved. */
static bool get_parameter(fmu *f, const mdl_variable *v, double *value) {
  rt_session *s = f->session;
  if (v->settable) {
    *value = v->sign * s->p_run[v->index];
    return true;
  }
  if (!fmu_refresh(f)) return false;
  *value = v->sign * s->data.p[v->index];
  return true;
}

static bool get(fmu *f, unsigned reference, double *value) {
  const mdl_data *m = &f->session->data;
  const mdl_variable *v = row_of(f, reference);
  if (reference == 0) {
    *value = f->session->t;
    return true;
  }
  if (v && v->storage == MDL_PARAMETER) return get_parameter(f, v, value);
  if (v && v->storage == MDL_INPUT) {
    *value = v->sign * f->input[v->index];
    return true;
  }
  if (!fmu_refresh(f)) return false;
  const double *const arrays[] = {[MDL_STATE] = m->x,     [MDL_ALGEBRAIC] = m->v, [MDL_DISCRETE] = m->d,
                                  [MDL_PARAMETER] = m->p, [MDL_INPUT] = m->u,     [MDL_DERIVATIVE] = m->xdot};
  place at;
  if (!place_of(f, reference, &at)) return get_indicator(f, reference, value);
  *value = at.sign * arrays[at.storage][at.index];
  return true;
}

static int by_reference(const void *wanted, const void *array) {
  unsigned a = *(const unsigned *)wanted, b = ((const fmu_array *)array)->reference;
  return (a > b) - (a < b);
}

static unsigned count(unsigned reference) {
  const fmu_config *c = &fmu_configuration;
  if (!c->n_arrays) return 1;
  const fmu_array *found = bsearch(&reference, c->array, (size_t)c->n_arrays, sizeof *c->array, by_reference);
  return found ? found->n : 1;
}

size_t fmu_count(size_t n, const unsigned *references) {
  size_t values = 0;
  for (size_t i = 0; i < n; i++)
    values += count(references[i]);
  return values;
}

/* Numbers with a fraction are of Reals alone, truth values of Booleans; FMI 2.0 has these as integers. */
static bool has_type(fmu *f, unsigned reference, fmu_type type) {
  const mdl_variable *v = row_of(f, reference);
  mdl_type own = v ? v->type : MDL_REAL;
  if ((own == MDL_REAL) == (type == FMU_DOUBLE) && (type != FMU_BOOL || own == MDL_BOOLEAN)) return true;
  return fmu_refuse(f, "%s is of another type", v ? v->name : "this variable");
}

bool fmu_get(fmu *f, size_t n, const unsigned *references, fmu_type type, void *values) {
  for (size_t i = 0, at = 0; i < n; i++) {
    if (!has_type(f, references[i], type)) return false;
    for (unsigned k = 0, last = count(references[i]); k < last; k++, at++) {
      double value = 0;
      if (!get(f, references[i] + k, &value)) return false;
      if (type == FMU_DOUBLE)
        ((double *)values)[at] = value;
      else if (type == FMU_INT)
        ((int *)values)[at] = (int)value;
      else
        ((bool *)values)[at] = value != 0;
    }
  }
  return true;
}

static int by_row(const void *a, const void *b) {
  return *(const int *)a - *(const int *)b;
}

/* A state's initial value replaces the one that it is declared with; what initial equations determine has none. */
static bool set_initial(fmu *f, const mdl_variable *v, double value) {
  const fmu_config *c = &fmu_configuration;
  rt_session *s = f->session;
  int row = (int)(v - s->d->variables);
  if (!c->n_starting || !bsearch(&row, c->starting, (size_t)c->n_starting, sizeof row, by_row))
    return fmu_refuse(f, "%s follows from the initial equations: it cannot be set", v->name);
  int k = 0;
  while (k < s->n_initial && s->initial_index[k] != v->index)
    k++;
  s->initial_index[k] = v->index;
  s->initial_value[k] = v->sign * value;
  if (k == s->n_initial) s->n_initial++;
  outdate(f);
  return true;
}

static bool set_parameter(fmu *f, const mdl_variable *v, double value) {
  rt_session *s = f->session;
  if (!v->settable) return fmu_refuse(f, "%s is not a parameter that may be set", v->name);
  if (!(value >= v->min && value <= v->max))
    return fmu_refuse(f, "parameter %s = %.9g is outside its bounds [%.9g, %.9g] %s", v->name, value, v->min, v->max,
                      v->unit);
  s->p_run[v->index] = v->sign * value;
  f->retuned = f->untuned = true;
  outdate(f);
  return true;
}

static bool set(fmu *f, unsigned reference, double value) {
  const mdl_variable *v = row_of(f, reference);
  if (!v) return fmu_refuse(f, "there is no variable with the value reference %u that may be set", reference);
  if (!isfinite(value)) return fmu_refuse(f, "%s: %g is not a finite number", v->name, value);
  if (v->storage == MDL_PARAMETER) {
    if (f->mode == FMU_CONTINUOUS) return fmu_refuse(f, "parameter %s is set in event mode only", v->name);
    return set_parameter(f, v, value);
  }
  if (v->storage == MDL_STATE && is_before_start(f)) return set_initial(f, v, value);
  if (v->storage != MDL_INPUT) return fmu_refuse(f, "%s is computed: it cannot be set", v->name);
  if (f->input[v->index] == v->sign * value) return true;
  f->input[v->index] = v->sign * value;
  f->session->input_time = NAN;
  f->driven = true;
  outdate(f);
  return true;
}

bool fmu_set(fmu *f, size_t n, const unsigned *references, fmu_type type, const void *values) {
  for (size_t i = 0, at = 0; i < n; i++) {
    if (!has_type(f, references[i], type)) return false;
    for (unsigned k = 0, last = count(references[i]); k < last; k++, at++) {
      double value = type == FMU_DOUBLE ? ((const double *)values)[at]
                     : type == FMU_INT  ? ((const int *)values)[at]
                                        : ((const bool *)values)[at];
      if (!set(f, references[i] + k, value)) return false;
    }
  }
  return true;
}

static bool seed(fmu *f, unsigned reference, double value) {
  mdl_lanes *const arrays[] = {[MDL_STATE] = f->tangent.x,     [MDL_ALGEBRAIC] = NULL,     [MDL_DISCRETE] = NULL,
                               [MDL_PARAMETER] = f->tangent.p, [MDL_INPUT] = f->tangent.u, [MDL_DERIVATIVE] = NULL};
  const mdl_variable *v = row_of(f, reference);
  place at;
  if (!place_of(f, reference, &at) || !arrays[at.storage] || (at.storage == MDL_PARAMETER && !v->settable))
    return fmu_refuse(f, "no derivative with respect to %s: it is no state, input or parameter that may be set",
                      v ? v->name : "this variable");
  ((double *)arrays[at.storage])[at.index * MDL_LANES] += at.sign * value;
  return true;
}

static bool read_row(fmu *f, unsigned reference, double *result) {
  const mdl_tangent *b = &f->tangent;
  const mdl_lanes *const arrays[] = {[MDL_STATE] = b->x,     [MDL_ALGEBRAIC] = b->v, [MDL_DISCRETE] = b->d,
                                     [MDL_PARAMETER] = b->p, [MDL_INPUT] = b->u,     [MDL_DERIVATIVE] = b->xdot};
  place at;
  if (!place_of(f, reference, &at))
    return fmu_refuse(f, "no derivative of the variable with the value reference %u", reference);
  *result = at.sign * ((const double *)arrays[at.storage])[at.index * MDL_LANES];
  return true;
}

/* result = (d unknowns / d knowns) seed, at the present point with the relations as they are. */
bool fmu_directional(fmu *f, size_t n_unknowns, const unsigned *unknowns, size_t n_knowns, const unsigned *knowns,
                     const double *seed_values, double *result) {
  const mdl_descriptor *d = f->model.descriptor;
  rt_session *s = f->session;
  mdl_data *m = &s->data;
  size_t rows = 1 + (size_t)d->n_p + (size_t)d->n_u + 3 * (size_t)d->n_x + (size_t)d->n_v + 2 * (size_t)d->n_d;
  if (!d->tangents) return fmu_refuse(f, "this FMU was made without derivatives");
  if (f->mode == FMU_INITIALISATION && fmu_configuration.n_starting < d->n_x)
    return fmu_refuse(f, "derivatives do not follow the initial equations: there are some from event mode on");
  if (!fmu_refresh(f)) return false;
  memset(f->tangent_rows, 0, rows * MDL_LANES * sizeof(double));
  for (size_t i = 0; i < n_knowns; i++)
    for (unsigned k = 0, last = count(knowns[i]); k < last; k++)
      if (!seed(f, knowns[i] + k, *seed_values++)) return false;
  if (d->tangents->parameters(m, &f->tangent) || d->tangents->rhs(m, s->t, m->x, m->xdot, m->v, &f->tangent))
    return fmu_done(f, rt_fail_model(s, s->t, "differentiating the model"));
  for (size_t i = 0; i < n_unknowns; i++)
    for (unsigned k = 0, last = count(unknowns[i]); k < last; k++)
      if (!read_row(f, unknowns[i] + k, result++)) return false;
  return true;
}
