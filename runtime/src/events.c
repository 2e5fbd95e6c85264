/* Events: everything that changes at one instant, iterated until nothing changes any more. */
#include <math.h>
#include <string.h>

#include "clock.h"
#include "sensitivity.h"
#include "swings.h"
#include "transport.h"
#include "undetermined.h"

enum {
  MAX_PASSES = 100,
  MAX_SINGLE_PASSES = 200,
  MAX_SWEEPS = 40,
  MAX_ROUNDS = 1000, /* of what shrinks by 4 % a round: rounding is reached */
  PATIENCE = 4,
  SWEEPS_OF_A_CYCLE = 8,
  WATCHED_PASSES = 12,
  MAX_FUTILE_EVENTS = 100,
  CIRCLE = -2
};

/* A relation keeps its value while its guard is within the hysteresis: what is there may be noise, and a relation that
 * has just been located at its crossing must not fall back. Exactly zero is no noise, and not greater than zero. */
static bool update_relation(rt_session *s, int r, double hysteresis) {
  unsigned char *rel = &s->data.rel[r], now = *rel;
  double g = s->g[r];
  if (g > hysteresis) now = 1;
  if (g < -hysteresis || (g == 0 && !s->flip[r])) now = 0;
  bool changed = now != *rel;
  *rel = now;
  return changed;
}

/* `singly`: only the first of those that disagree, by however little: what is within the hysteresis may be what holds
 * the others up. Whether any relation changed. */
static bool update_relations(rt_session *s, bool singly) {
  bool changed = false;
  for (int r = 0; r < s->d->n_rel && !(singly && changed); r++)
    if (rt_is_state_relation(s, r)) changed |= update_relation(s, r, singly ? 0 : rt_hysteresis(s, r));
  return changed;
}

/* Relations that compare what an event sets, without deciding about it, as they are with what is set. */
static bool update_followers(rt_session *s) {
  bool changed = false;
  memcpy(s->rel_trial, s->data.rel, (size_t)s->d->n_rel);
  (void)s->d->time_relations(&s->data, s->t);
  for (int r = 0; r < s->d->n_rel; r++) {
    bool timed = s->d->relations[r].kind & MDL_OF_TIME, follows = s->d->relations[r].kind & MDL_FOLLOWER;
    if (timed && !follows) s->data.rel[r] = s->rel_trial[r];
    if (!timed && follows) update_relation(s, r, rt_hysteresis(s, r));
    changed |= s->data.rel[r] != s->rel_trial[r];
  }
  return changed;
}

static bool clear_ticks(rt_session *s) {
  bool any = false;
  for (int i = 0; i < s->d->n_sample; i++) {
    any |= s->data.tick[i];
    s->data.tick[i] = 0;
  }
  return any;
}

static bool same(const double *a, const double *b, int n) {
  return !memcmp(a, b, (size_t)n * sizeof *a);
}

/* One sweep of the discrete equations from the state and the when conditions on arrival, v being what they read of the
 * continuous variables (m->v is what these were on arrival); the state after it in x_swept. */
static int sweep(rt_session *s, const double *v) {
  mdl_data *m = &s->data;
  memcpy(m->when, s->when_before, (size_t)s->d->n_when);
  memcpy(s->x_swept, m->x, (size_t)s->d->n_x * sizeof *m->x);
  m->reinitialised = 0;
  m->unsettled = 0;
  int status = s->d->event(m, s->t, s->x_swept, m->xdot, v);
  return status ? status : rt_check_settled(s, m->unsettled);
}

/* Whether two sweeps set the same: rounding aside, by which a solution of nonlinear equations may differ from the one
 * before. A value is its only scale (what it was before may be far greater): a circle that tends to zero is refused. */
static bool alike(const double *a, const double *b, int n) {
  for (int i = 0; i < n; i++)
    if (!(fabs(a[i] - b[i]) <= 4 * DBL_EPSILON * fabs(a[i]))) return false;
  return true;
}

/* What events read may follow, through equations and relations, what they set: sweeps with all other relations as they
 * are, until the equations hold with what is set. 0 they do, -1 failed, CIRCLE they do not come to agree. */
static int agree(rt_session *s) {
  mdl_data *m = &s->data;
  if (!(s->d->events_follow & MDL_ARRIVAL)) memcpy(s->v_agreed, m->v, (size_t)s->d->n_v * sizeof *m->v);
  for (int k = 0; k < MAX_ROUNDS; k++) {
    if (rt_evaluate_into(s, s->v_agreed)) return -1;
    if (update_followers(s)) continue; /* equations may follow them */
    memcpy(s->rel_swept, m->rel, (size_t)s->d->n_rel);
    memcpy(s->d_swept, m->d, (size_t)s->d->n_d * sizeof *m->d);
    if (sweep(s, s->v_agreed) || rt_jump_sweep(s, s->v_agreed, false)) return -1;
    if (alike(m->d, s->d_swept, s->d->n_d)) return 0;
  }
  return CIRCLE;
}

/* A mode that is tried because a relation held in the mode before may contradict itself, and its opposite too (friction
 * that comes to rest, judged by the path variable of sliding). Then the relations that disagree start again from false.
 */
static void start_again(rt_session *s) {
  for (int r = 0; r < s->d->n_rel; r++)
    if (s->data.rel[r] != s->rel_swept[r] && rt_is_state_relation(s, r)) s->data.rel[r] = 0;
}

/* One pass: point, relations, discrete equations, by up to so many sweeps with the values before the event (pre) as
 * they are, until they agree. One sweep is enough where modes depend on pre-values; more are made where events get
 * nowhere, and what does not settle one way is iterated the other way. 1 something changed, 0 nothing did, -1 failed,
 * CIRCLE what is set follows itself. */
static int pass(rt_session *s, int sweeps, bool singly) {
  mdl_data *m = &s->data;
  bool changed = false, settled = false;
  double *v = s->d->events_follow & MDL_ARRIVAL ? s->v_agreed : m->v;
  if (v != m->v) memcpy(v, m->v, (size_t)s->d->n_v * sizeof *v);
  memcpy(s->when_before, m->when, (size_t)s->d->n_when);
  for (int k = 0; k < sweeps && !settled; k++) {
    s->result->counters.event_passes++;
    if (rt_evaluate_into(s, v)) return -1;
    memcpy(s->rel_swept, m->rel, (size_t)s->d->n_rel);
    bool switched = update_relations(s, singly);
    switched |= rt_clock_relations(s);
    if (switched && k % SWEEPS_OF_A_CYCLE == SWEEPS_OF_A_CYCLE - 1) start_again(s);
    memcpy(s->d_swept, m->d, (size_t)s->d->n_d * sizeof *m->d);
    if (sweep(s, v) || rt_jump_sweep(s, v, k == 0)) return -1;
    settled = !switched && same(m->d, s->d_swept, s->d->n_d);
    changed |= switched;
    int status = settled || !(s->d->events_follow & MDL_FOLLOWS) ? 0 : agree(s);
    if (status) return status;
  }
  memcpy(m->x, s->x_swept, (size_t)s->d->n_x * sizeof *m->x);
  rt_jump_accept(s);
  if (v != m->v && rt_evaluate(s)) return -1; /* to the next pass it has been what it is with what is set */
  s->reinitialised |= m->reinitialised != 0;
  return changed || !settled || m->reinitialised || !same(m->d, m->pre_d, s->d->n_d);
}

/* Repeat passes at the present instant until relations, discrete variables and states agree. Ticks last until then.
 *
 * Ideal diodes and switches that depend on each other may chase each other round when all of them follow their guards
 * at once. Where neither way settles, one at a time does, always the first that disagrees: the modes of such a circuit
 * are a linear complementarity problem, and for the matrices of circuits with losses (P-matrices) that rule ends, as no
 * combination comes twice (K. Murty, Note on a Bard-type scheme for solving the complementarity problem, Opsearch 11
 * (1974) 123-130). */
rt_status rt_iterate_event(rt_session *s) {
  mdl_data *m = &s->data;
  char names[400] = "";
  s->reinitialised = false;
  memcpy(m->pre_d, m->d, (size_t)s->d->n_d * sizeof *m->d);
  const int most = MAX_PASSES + MAX_SINGLE_PASSES;
  int made = 0;
  for (int i = 0, first = 0; i < most; i++, made++) {
    bool nowhere = s->futile_events > PATIENCE, other_way = i >= MAX_PASSES / 2, singly = i >= MAX_PASSES;
    int changed = pass(s, nowhere != other_way && !singly ? MAX_SWEEPS : 1, singly);
    if (changed == CIRCLE) {
      rt_append_changed(s, names, sizeof names);
      return rt_fail(s, RT_EVENT_CYCLE, s->t, -1, NULL,
                     "what the event at time %.9g s sets follows itself through equations and does not settle in %d "
                     "rounds: %s; where the value from before the event is meant, write pre(...)",
                     s->t, MAX_ROUNDS, names);
    }
    if (changed < 0) return rt_fail_model(s, s->t, "iterating an event");
    if (!changed && !clear_ticks(s)) return RT_OK;
    if (i >= most - WATCHED_PASSES) rt_append_changed(s, names, sizeof names);
    memcpy(m->pre_d, m->d, (size_t)s->d->n_d * sizeof *m->d);
    int next = i < MAX_PASSES / 2 ? MAX_PASSES / 2 : MAX_PASSES; /* from which on passes are made in another way */
    if (changed && !singly && rt_event_circles(s, i + 1 - first)) i = next - 1;
    if (!changed || i == next - 1) first = i + 1; /* without ticks, or another way, passes lead elsewhere */
  }
  return rt_fail(s, RT_EVENT_CYCLE, s->t, -1, NULL,
                 "the event at time %.9g s does not settle in %d passes; these keep changing: %s", s->t, made,
                 names[0] ? names : "relations between continuous variables");
}

/* An event is futile if its guards have hardly moved since they last switched, or time has not. Many in a row are
 * chattering. A guard that the event itself sets apart (a counter's next threshold) comes back all the way. */
static rt_status check_chattering(rt_session *s, double since) {
  bool futile = s->pending == RT_PENDING_STATE;
  int flipped = 0;
  for (int r = 0; r < s->d->n_rel; r++) {
    if (!s->flip[r]) continue;
    flipped = r;
    if (s->g_travel[r] > 100 * rt_hysteresis(s, r) && since > s->clock.tolerance) futile = false;
    s->g_travel[r] = fabs(s->g[r]);
  }
  s->futile_events = futile ? s->futile_events + 1 : 0;
  if (s->futile_events <= MAX_FUTILE_EVENTS) return RT_OK;
  return rt_fail(s, RT_CHATTERING, s->t, -1, &s->d->relations[flipped].source,
                 "chattering: this relation switches to and fro at time %.9g s without getting anywhere (%d events)",
                 s->t, MAX_FUTILE_EVENTS);
}

static void switch_relations(rt_session *s) {
  for (int r = 0; r < s->d->n_rel; r++) {
    if (!s->flip[r]) continue;
    s->data.rel[r] = !s->data.rel[r];
    s->result->counters.state_events++;
    double size = s->g_nominal[r] > 0 ? s->g_nominal[r] : s->g_span[r], reach = size > 0 ? s->g_travel[r] / size : 0;
    rt_result_log(s->result, s->t, RT_EVENT_STATE, r, s->data.rel[r] ? 1 : -1, reach);
  }
}

static void remember(rt_session *s) {
  const mdl_descriptor *d = s->d;
  memcpy(s->x_before, s->data.x, (size_t)d->n_x * sizeof(double));
  memcpy(s->xdot_before, s->data.xdot, (size_t)d->n_x * sizeof(double));
  memcpy(s->v_before, s->data.v, (size_t)d->n_v * sizeof(double));
  memcpy(s->d_before, s->data.d, (size_t)d->n_d * sizeof(double));
  memcpy(s->rel_before, s->data.rel, (size_t)d->n_rel);
}

static bool differs(const rt_session *s, const double *x, const double *xdot, const double *v) {
  const mdl_descriptor *d = s->d;
  const mdl_data *m = &s->data;
  for (int k = 0; k < d->n_z; k++)
    if (m->v[d->z_index[k]] != v[d->z_index[k]]) return true;
  return memcmp(m->x, x, (size_t)d->n_x * sizeof *x) || memcmp(m->xdot, xdot, (size_t)d->n_x * sizeof *xdot);
}

/* Has the event changed what is integrated? It has not if x, x' and z are the same as before, to the last bit, both
 * here and with the new relations at the end of the step that the event cut short. Then that step stands. */
static bool is_inconsequential(rt_session *s) {
  if (s->sensitivities) return false; /* they may have jumped where the run itself has not */
  if (s->pending & (RT_PENDING_KINK | RT_PENDING_BRANCH) || differs(s, s->x_before, s->xdot_before, s->v_before))
    return false;
  bool cut = s->t < s->t_end, switched = memcmp(s->data.rel, s->rel_before, (size_t)s->d->n_rel) != 0;
  if (!cut) return !switched;
  if (rt_clock_limit(s) < s->t_end) return false; /* the event has set a time event within that step */
  memcpy(s->v_trial, s->v_end, (size_t)s->d->n_v * sizeof *s->v_trial);
  if (rt_rhs(s, s->t_end, s->x_end, s->xdot_trial, s->v_trial)) return false;
  for (int k = 0; k < s->d->n_z; k++)
    if (s->v_trial[s->d->z_index[k]] != s->v_end[s->d->z_index[k]]) return false;
  s->resume = memcmp(s->xdot_trial, s->xdot_end, (size_t)s->d->n_x * sizeof(double)) == 0;
  if (s->resume) memcpy(s->v_end, s->v_trial, (size_t)s->d->n_v * sizeof *s->v_trial);
  return s->resume;
}

/* A guard at its zero may be past it in the mode before and short of it in the mode after, where the same rounding
 * weighs more (a diode that opens: the current left over, over its conductance). The relations fall back, and nothing
 * has happened; they switch when the guard has left the hysteresis. */
static bool has_fallen_back(const rt_session *s) {
  return s->pending == RT_PENDING_STATE && !s->reinitialised && !s->data.terminated &&
         same(s->data.d, s->d_before, s->d->n_d) && !memcmp(s->data.rel, s->rel_before, (size_t)s->d->n_rel);
}

/* A time relation that is due within the tolerance happens at its own time: what reads the time there, a table say, has
 * arrived too. A run stops there anyway; an importer's communication points may be rounded to just before it. */
static void arrive(rt_session *s) {
  s->t = rt_max(s->t, s->clock.next_relation);
}

/* What is pending at the present time happens: two rows in the result, and the method restarts where something changed.
 */
rt_status rt_event(rt_session *s) {
  if (s->pending & RT_PENDING_TIME) arrive(s);
  bool record = s->options.record_events && s->pending & ~RT_PENDING_INPUT;
  rt_status status = record ? rt_record_event_row(s) : RT_OK;
  if (status) return status;
  double since = s->t - s->last_event;
  s->last_event = s->t;
  s->shaped = false; /* with other relations, guards are made of the states in another way */
  rt_slopes_forget(s);
  if (s->d->events_follow & MDL_ARRIVAL && rt_evaluate(s)) return rt_fail_model(s, s->t, "arriving at an event");
  remember(s);
  if ((status = rt_jump_measure(s))) return status;
  size_t logged = s->result->n_events;
  long switched = s->result->counters.state_events;
  if (s->pending & RT_PENDING_JUMP) s->result->counters.input_jumps++;
  rt_inputs_begin(s, s->t);
  if ((status = rt_transports_leave(s, true))) return status;
  if (s->pending & RT_PENDING_STATE) switch_relations(s);
  if (s->pending & (RT_PENDING_TIME | RT_PENDING_SAMPLE)) rt_clock_tick(s);
  rt_jump_begin(s);
  if ((status = rt_iterate_event(s)) || (status = rt_check_lasting(s)) || (status = rt_jump_end(s)) ||
      (status = check_chattering(s, since)) || (status = rt_follow_undetermined(s)))
    return status;
  if (has_fallen_back(s)) {
    s->result->n_events = logged;
    s->result->counters.state_events = switched;
  }
  if (rt_follow_switches(s, since)) return rt_fail_model(s, s->t, "looking ahead from an event");
  memset(s->flip, 0, (size_t)s->d->n_rel);
  if (record && (status = rt_record_event_row(s))) return status;
  if (s->data.terminated) rt_result_log(s->result, s->t, RT_EVENT_TERMINATE, s->data.terminated - 1, 1, 1);
  if (is_inconsequential(s)) return RT_OK;
  s->result->counters.restarts++;
  s->t_before = s->t_oldest = NAN;
  return s->method->restart(s, s->memory);
}
