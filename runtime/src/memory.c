/* A session's memory, for one model and one solver: made, and given back. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "delay.h"
#include "sensitivity.h"
#include "swings.h"
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
  rt_branches *b = &s->branches;
  double **parameters[] = {&m->p, &s->p_run}, **inputs[] = {&m->u},
         **discrete[] = {&m->d, &m->pre_d, &s->d_swept, &s->d_before, &s->d_after, &s->d_seen};
  double **unknowns[] = {&s->range, &s->outgrown, &s->modest, &s->atol, &s->y, &s->yp},
         **samples[] = {&s->clock.first, &s->clock.interval};
  double **algebraic[] = {&m->v, &s->v_trial, &s->v_before,  &s->v_end,  &s->v_agreed,
                          &r->v, &b->v,       &b->v_reached, &b->v_tried},
         **dense[] = {&s->dense.c}, **shapes[] = {&s->shape, &s->rates, &s->swing};
  double **states[] = {&m->x,           &m->xdot,  &s->initial_value, &s->x_trial,    &s->xdot_trial, &s->x_before,
                       &s->xdot_before, &s->x_end, &s->xdot_end,      &r->x,          &r->xdot,       &s->x_swept,
                       &s->x_start,     &b->xdot,  &b->xdot_reached,  &b->xdot_tried, &b->x,          &s->x_seen};
  double **branches[] = {&b->size}, **sides[] = {&b->facing, &b->facing_reached, &b->orientation, &b->aside};
  double **sizes[] = {&s->nominal}, **division[] = {&s->division};
  double **guards[] = {&s->g,        &s->g_previous,    &s->g_low,         &s->g_trial, &s->g_before,
                       &s->g_oldest, &s->g_reach,       &s->bound,         &s->g_span,  &s->g_travel,
                       &s->g_floor,  &s->changed_at[0], &s->changed_at[1], &s->due_back};
  double **turns[] = {&s->phase, &s->phase_start}, **declared[] = {&s->declared};
  const group groups[] = {{parameters, COUNT(parameters), d->n_p},
                          {inputs, COUNT(inputs), d->n_u},
                          {discrete, COUNT(discrete), d->n_d},
                          {unknowns, COUNT(unknowns), d->n_x + d->n_z},
                          {samples, COUNT(samples), d->n_sample},
                          {algebraic, COUNT(algebraic), d->n_v},
                          {dense, COUNT(dense), (RT_DENSE_DEGREE + 1) * d->n_x},
                          {shapes, COUNT(shapes), (RT_DENSE_DEGREE + 1) * d->n_rel},
                          {states, COUNT(states), d->n_x},
                          {sizes, COUNT(sizes), d->n_x + d->n_z + d->n_rel + d->n_delay},
                          {division, COUNT(division), 2 * d->n_divisions},
                          {guards, COUNT(guards), d->n_rel},
                          {turns, COUNT(turns), d->n_phases},
                          {declared, COUNT(declared), d->n_redundant},
                          {branches, COUNT(branches), d->n_branches},
                          {sides, COUNT(sides), d->n_equations}};
  s->n_numbers = 1;
  for (size_t i = 0; i < COUNT(groups); i++)
    s->n_numbers += groups[i].count * (size_t)groups[i].n;
  double *next = s->numbers = calloc(s->n_numbers, sizeof *next);
  for (size_t i = 0; next && i < COUNT(groups); i++)
    for (size_t j = 0; j < groups[i].count; j++, next += groups[i].n)
      *groups[i].places[j] = next;
  m->orientation = b->orientation;
  m->facing = b->facing;
  s->g_nominal = s->nominal + d->n_x + d->n_z;
  s->delay_nominal = s->g_nominal + d->n_rel;
  return s->numbers != NULL;
}

static bool allocate_flags(rt_session *s) {
  const mdl_descriptor *d = s->d;
  mdl_data *m = &s->data;
  unsigned char **relations[] = {&m->rel, &s->flip, &s->rel_before, &s->rel_trial, &s->rel_swept, &s->rel_seen};
  s->n_flags =
      COUNT(relations) * (size_t)d->n_rel + (size_t)(d->n_sample + 3 * d->n_when + d->n_divisions + d->n_asserts) + 1;
  unsigned char *next = s->flags = calloc(s->n_flags, 1);
  if (!next) return false;
  for (size_t i = 0; i < COUNT(relations); i++, next += d->n_rel)
    *relations[i] = next;
  m->tick = next;
  m->when = next + d->n_sample;
  s->when_before = m->when + d->n_when;
  s->when_seen = s->when_before + d->n_when;
  m->warned = s->when_seen + d->n_when;
  s->division_sign = (signed char *)m->warned + d->n_asserts;
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
  if (options->rtol >= 1 || options->atol >= 1) {
    const bool relative = options->rtol >= 1;
    snprintf(message, size, "%s tolerance of %.9g keeps no digit: give one below 1, such as 1e-6",
             relative ? "a relative" : "an absolute (per nominal value)", relative ? options->rtol : options->atol);
    return NULL;
  }
  rt_session *s = calloc(1, sizeof *s);
  if (!s) return NULL;
  s->model = model;
  s->d = model->descriptor;
  s->options = *options;
  s->all_affine = rt_all_affine(s->d);
  /* a model without states has nothing to integrate: any method with step size control only walks along its events */
  s->method = s->d->n_x == 0 && method->multistep ? &rt_method_dopri5 : method;
  s->options.solver = s->method->name;
  bool done = allocate_session(s);
  if (done) {
    rt_session_declared(s);
    if (!(s->options.rtol > 0)) s->options.rtol = s->d->tolerance > 0 ? s->d->tolerance : 1e-6;
    s->atol_given = s->options.atol > 0;
    if (!s->atol_given) s->options.atol = 0.01 * s->options.rtol;
    s->memory = s->method->create(s);
    s->slopes = rt_slopes_new(s->d);
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
  rt_slopes_free(s->slopes);
  free(s->inputs);
  free(s->held);
  free(s->clock.next);
  free(s->initial_index);
  free(s->recorder.outputs);
  free(s->numbers);
  free(s->flags);
  free(s);
}
