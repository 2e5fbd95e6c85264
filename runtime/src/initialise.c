/* The start of a run: start values, parameters, initial equations, first events. */
#include <math.h>
#include <string.h>

#include "clock.h"
#include "delay.h"
#include "sensitivity.h"
#include "transport.h"

enum { MAX_ITERATIONS = 50, WATCHED_ITERATIONS = 8 };
static const double same = 1e-9; /* of a state: far above rounding, far below any tolerance */

static void clear(rt_session *s) {
  const mdl_descriptor *d = s->d;
  mdl_data *m = &s->data;
  memset(m->x, 0, (size_t)d->n_x * sizeof *m->x);
  memset(m->xdot, 0, (size_t)d->n_x * sizeof *m->xdot);
  memset(m->v, 0, (size_t)d->n_v * sizeof *m->v);
  memset(m->d, 0, (size_t)d->n_d * sizeof *m->d);
  memset(m->pre_d, 0, (size_t)d->n_d * sizeof *m->pre_d);
  memset(m->rel, 0, (size_t)d->n_rel);
  memset(m->tick, 0, (size_t)d->n_sample);
  memset(m->when, 0, (size_t)d->n_when);
  for (int i = 0; i < d->n_variables; i++)
    if (d->variables[i].storage == MDL_INPUT)
      m->u[d->variables[i].index] = d->variables[i].sign * d->variables[i].start;
  m->initial = 1;
  m->start_time = s->start;
  m->homotopy = 1;
  m->shift = 0;
  m->undetermined = s->undetermined = s->n_held = 0;
  m->unsettled = s->unsettled = 0;
  m->terminal = m->reinitialised = m->terminated = 0;
  m->failure = (mdl_failure){.equation = -1, .variable = -1};
  memset(s->flip, 0, (size_t)d->n_rel);
  memset(s->division_sign, 0, (size_t)d->n_divisions);
  for (int r = 0; r < d->n_rel; r++) {
    s->changed_at[0][r] = s->changed_at[1][r] = s->start;
    s->due_back[r] = s->last_due_back = -INFINITY;
  }
  memset(s->data.warned, 0, (size_t)d->n_asserts);
  memset(s->g_span, 0, (size_t)d->n_rel * sizeof *s->g_span);
  memset(s->g_travel, 0, (size_t)d->n_rel * sizeof *s->g_travel);
  s->t = s->t_previous = s->t_end = s->last_event = s->start;
  s->t_before = s->t_oldest = NAN;
  s->resume = s->in_pieces = false;
  s->dense.valid = false;
  s->steps_taken = s->pieces_taken = 0;
  s->futile_events = s->tiny_steps = s->pending = 0;
}

static rt_status set_parameters_and_starts(rt_session *s) {
  memcpy(s->data.p, s->p_run, (size_t)s->d->n_p * sizeof *s->p_run);
  if (s->d->parameters(&s->data) || rt_check_settled(s, s->data.unsettled))
    return rt_fail_model(s, s->start, "computing parameters");
  if (s->d->starts(&s->data)) return rt_fail_model(s, s->start, "computing start values");
  for (int k = 0; k < s->d->n_redundant; k++)
    s->declared[k] = s->data.v[s->d->redundant[k].index];
  rt_status status = rt_check_parameters(s);
  if (!status) status = rt_scale_parameters(s);
  return !status && s->sensitivities ? rt_tangent_start(s) : status;
}

/* At the start there is no history: a relation is exactly what its guard says. `patient`: where that goes in circles,
 * one whose guard is at zero stays what it is, as at an event: two brakes on one shaft that give way together, say, of
 * which each holds as long as the other does. */
static bool settle_relations(rt_session *s, bool patient) {
  bool changed = false;
  for (int r = 0; r < s->d->n_rel; r++) {
    if (!rt_is_state_relation(s, r) || isnan(s->g[r])) continue;
    if (patient && fabs(s->g[r]) <= rt_hysteresis(s, r)) continue;
    unsigned char now = s->g[r] > 0;
    changed |= now != s->data.rel[r];
    s->data.rel[r] = now;
  }
  return changed;
}

/* A branch that will not hold may have no value: then the guards that have one tell which does. */
static bool settles_without_values(rt_session *s) {
  mdl_data *m = &s->data;
  return s->data.failure.kind == MDL_FAILURE_NONFINITE && s->d->n_rel &&
         !s->d->roots(m, s->t, m->x, m->xdot, m->v, s->g) && settle_relations(s, false);
}

/* Start values of discrete variables that `when initial()` replaces are none that the equations need to have a solution
 * with: what it sets comes first then. It is set again with the solution, from the same values before the start. */
static bool sets_discrete_first(rt_session *s) {
  mdl_data *m = &s->data;
  const size_t d_size = (size_t)s->d->n_d * sizeof *m->d;
  mdl_failure failure = m->failure;
  memcpy(s->d_swept, m->d, d_size);
  memcpy(m->when, s->when_before, (size_t)s->d->n_when);
  memcpy(s->x_swept, m->x, (size_t)s->d->n_x * sizeof *m->x);
  bool moved = !s->d->event(m, s->t, s->x_swept, m->xdot, m->v) && memcmp(m->d, s->d_swept, d_size);
  memcpy(m->when, s->when_before, (size_t)s->d->n_when);
  m->failure = failure;
  return moved;
}

static rt_status fail_initialisation(rt_session *s) {
  rt_fail_model(s, s->t, "solving the initial equations");
  return s->failure.status = RT_INITIALISATION;
}

/* The initial system with this much of the actual expressions in homotopy(); where it fails, start values are as they
 * were. */
static int solve_on_path(rt_session *s, double path) {
  mdl_data *m = &s->data;
  const mdl_descriptor *d = s->d;
  memcpy(s->x_before, m->x, (size_t)d->n_x * sizeof *m->x);
  memcpy(s->xdot_before, m->xdot, (size_t)d->n_x * sizeof *m->xdot);
  memcpy(s->v_before, m->v, (size_t)d->n_v * sizeof *m->v);
  m->homotopy = path;
  m->undetermined = 0;
  int status = d->initial_system(m, s->t);
  m->homotopy = 1;
  if (!status) return 0;
  memcpy(m->x, s->x_before, (size_t)d->n_x * sizeof *m->x);
  memcpy(m->xdot, s->xdot_before, (size_t)d->n_x * sizeof *m->xdot);
  memcpy(m->v, s->v_before, (size_t)d->n_v * sizeof *m->v);
  return status;
}

/* Where the start values lead nowhere: the solution with the simplified expressions, followed to that with the actual
 * ones by steps that halve where it is lost and double where it is not. A failure is the first one. */
static int solve_initial_system(rt_session *s) {
  const double least = 1e-6;
  int status = solve_on_path(s, 1);
  if (!status) return 0;
  mdl_failure failure = s->data.failure;
  bool found = !solve_on_path(s, 0);
  for (double path = 0, stride = 0.5; found && path<1; found = stride> least) {
    double next = rt_min(1, path + stride);
    bool arrived = !solve_on_path(s, next);
    if (arrived) path = next;
    stride *= arrived ? 2 : 0.5;
  }
  if (!found) s->data.failure = failure;
  return found ? 0 : status;
}

/* Initial equations that leave unknowns open (one follows from the others) must not leave a state open: its value would
 * be anybody's choice. What is open is moved, and the states that follow are named. */
static rt_status check_open(rt_session *s) {
  mdl_data *m = &s->data;
  const mdl_descriptor *d = s->d;
  int equation = m->undetermined - 1;
  if (equation < 0) return RT_OK;
  char names[400] = "";
  memcpy(s->x_trial, m->x, (size_t)d->n_x * sizeof *m->x);
  memcpy(s->xdot_trial, m->xdot, (size_t)d->n_x * sizeof *m->xdot);
  memcpy(s->v_trial, m->v, (size_t)d->n_v * sizeof *m->v);
  m->shift = 1;
  int status = solve_on_path(s, 1);
  m->shift = 0;
  for (int i = 0; !status && i < d->n_x; i++) {
    int row = rt_state_variable(s, i);
    if (fabs(m->x[i] - s->x_trial[i]) > same * rt_max(fabs(s->x_trial[i]), s->nominal[i]) && row >= 0)
      rt_append_name(names, sizeof names, d->variables[row].name);
  }
  memcpy(m->x, s->x_trial, (size_t)d->n_x * sizeof *m->x);
  memcpy(m->xdot, s->xdot_trial, (size_t)d->n_x * sizeof *m->xdot);
  memcpy(m->v, s->v_trial, (size_t)d->n_v * sizeof *m->v);
  if (!names[0]) return RT_OK;
  return rt_fail(s, RT_INITIALISATION, s->t, -1, &d->equations[equation],
                 "the initial equations at time %.9g s follow from each other and leave these open: %s; give one of "
                 "them a start value with fixed = true in place of an initial equation",
                 s->t, names);
}

static void give_states(rt_session *s) {
  for (int k = 0; k < s->n_initial; k++)
    s->data.x[s->initial_index[k]] = s->initial_value[k];
}

/* Relations begin as the start values have them: abs(y) = 1 has two solutions, and says which of them is meant. */
static void begin_relations(rt_session *s) {
  mdl_data *m = &s->data;
  rt_inputs_at(s, s->t);
  if (s->d->n_rel && !s->d->roots(m, s->t, m->x, m->xdot, m->v, s->g)) (void)settle_relations(s, false);
  m->failure = (mdl_failure){.equation = -1, .variable = -1};
}

/* The largest of the variables in the equation of v[index], which it is rounded with. */
static double size_beside(const rt_session *s, int index) {
  const mdl_descriptor *d = s->d;
  double size = 0;
  for (int k = 0; k < d->n_computed; k++) {
    const mdl_computed *c = &d->computed[k];
    if (c->storage != MDL_ALGEBRAIC || c->index != index) continue;
    for (int j = d->equation_first[c->equation]; j < d->equation_first[c->equation + 1]; j++) {
      const mdl_variable *v = &d->variables[d->equation_variables[j]];
      if (v->storage == MDL_ALGEBRAIC) size = rt_max(size, fabs(s->data.v[v->index]));
      if (v->storage == MDL_STATE) size = rt_max(size, fabs(s->data.x[v->index]));
    }
  }
  return size;
}

/* Fixed start values that the other initial conditions determine are the same, where the caller gives no others. */
static rt_status check_redundant(rt_session *s) {
  const mdl_descriptor *d = s->d;
  for (int k = 0; k < d->n_redundant && !s->n_initial; k++) {
    int index = d->redundant[k].index, row = rt_find_row(s, MDL_ALGEBRAIC, index);
    double value = s->data.v[index], declared = s->declared[k];
    double size = rt_max(rt_max(fabs(declared), fabs(value)), size_beside(s, index));
    if (fabs(value - declared) <= s->options.rtol * size) continue;
    return rt_fail(s, RT_INITIALISATION, s->t, row, &d->equations[d->redundant[k].equation],
                   "%s has the fixed start value %.9g, but the other initial conditions give %.9g",
                   row < 0 ? "a variable" : d->variables[row].name, declared, value);
  }
  return RT_OK;
}

/* Initial equations, relations and discrete equations with initial() true, until they agree; pre(d) stays the start
 * value, which the first event leaves (8.6), or is what d comes to be (`steady`); *sets: that is another. States given
 * by the caller are what others follow from; they replace what initial equations say of them. */
static rt_status solve_initial_equations(rt_session *s, bool steady, bool *sets) {
  mdl_data *m = &s->data;
  const size_t x_size = (size_t)s->d->n_x * sizeof *m->x;
  char names[400] = "";
  give_states(s);
  memcpy(s->x_start, m->x, x_size);
  memcpy(s->when_before, m->when, (size_t)s->d->n_when);
  begin_relations(s);
  for (int i = 0; i < MAX_ITERATIONS; i++) {
    memcpy(m->x, s->x_start, x_size);
    rt_inputs_at(s, s->t);
    if (solve_initial_system(s)) {
      if (sets_discrete_first(s)) continue;
      return fail_initialisation(s);
    }
    if (!s->n_initial && check_open(s)) return s->failure.status;
    if (rt_delays_start(s) || rt_transports_start(s)) return fail_initialisation(s);
    if (rt_tangent_initial(s, true)) return s->failure.status;
    give_states(s);
    if (rt_evaluate(s)) {
      mdl_failure failure = m->failure;
      if (settles_without_values(s)) continue;
      m->failure = failure;
      if (sets_discrete_first(s)) continue;
      return fail_initialisation(s);
    }
    if (rt_tangent_initial(s, false)) return s->failure.status;
    bool changed = settle_relations(s, i >= MAX_ITERATIONS / 2);
    memcpy(m->when, s->when_before, (size_t)s->d->n_when);
    memcpy(s->x_swept, m->x, (size_t)s->d->n_x * sizeof *m->x);
    memcpy(s->d_swept, m->d, (size_t)s->d->n_d * sizeof *m->d);
    m->unsettled = 0;
    if (s->d->event(m, s->t, m->x, m->xdot, m->v) || rt_check_settled(s, m->unsettled)) return fail_initialisation(s);
    if (rt_tangent_initial_event(s)) return s->failure.status;
    changed |= memcmp(m->d, s->d_swept, (size_t)s->d->n_d * sizeof *m->d) != 0;
    if (i >= MAX_ITERATIONS - WATCHED_ITERATIONS) rt_append_changed(s, names, sizeof names);
    *sets |= memcmp(m->pre_d, m->d, (size_t)s->d->n_d * sizeof *m->d) != 0;
    if (steady) memcpy(m->pre_d, m->d, (size_t)s->d->n_d * sizeof *m->d);
    if (!changed) return check_redundant(s);
  }
  return rt_fail(s, RT_INITIALISATION, s->t, -1, NULL,
                 "the initial equations do not settle at time %.9g s; these keep changing: %s", s->t,
                 names[0] ? names : "relations between continuous variables");
}

/* Events at the start: with initial() no longer true, then the ticks that fall on it. */
static rt_status first_events(rt_session *s) {
  s->data.initial = 0;
  rt_status status = rt_iterate_event(s);
  s->pending = status ? 0 : rt_clock_due(s) & RT_PENDING_SAMPLE;
  if (!s->pending) return status;
  rt_clock_tick(s);
  return rt_iterate_event(s);
}

static rt_status start(rt_session *s, bool steady, bool *sets) {
  clear(s);
  rt_status status = set_parameters_and_starts(s);
  if (!status) status = rt_clock_begin(s);
  if (status) return status;
  rt_inputs_reset(s);
  if ((status = rt_delays_begin(s)) || (status = rt_transports_begin(s))) return status;
  rt_inputs_begin(s, s->start);
  if ((status = solve_initial_equations(s, steady, sets))) return status;
  return first_events(s);
}

/* Where the start or its first event does not settle, from modes that were never meant (elements that stick though they
 * move, or both on one shaft), it begins where it would lead: at discrete values that are before it what they are after
 * it, where those are others. */
rt_status rt_initialise(rt_session *s) {
  rt_failure before = s->failure;
  bool sets = false;
  rt_status status = start(s, false, &sets);
  if (!sets || (status != RT_EVENT_CYCLE && status != RT_INITIALISATION)) return status;
  rt_failure told = s->failure;
  s->failure = before;
  if (start(s, true, &sets)) s->failure = told;
  return s->failure.status;
}
