/* The hybrid loop: step, look for events, record, let events happen, go on. */
#include <math.h>
#include <string.h>
#include <time.h>

#include "clock.h"
#include "delay.h"
#include "looks.h"
#include "sensitivity.h"
#include "swings.h"
#include "transport.h"
#include "undetermined.h"

enum { MAX_TINY_STEPS = 100, STEPS_BETWEEN_LOOKS = 64, PIECES_OF_A_STEP = 6 };
static const double look_every = 0.1; /* s of wall time: has the caller lost interest? */

rt_status rt_check_asserts(rt_session *s) {
  mdl_data *m = &s->data;
  if (!s->d->check) return RT_OK;
  m->unsettled = 0;
  if (s->d->check(m, s->t, m->x, m->xdot, m->v) || rt_check_settled(s, m->unsettled))
    return rt_fail_model(s, s->t, "checking");
  rt_tell_warnings(s);
  return RT_OK;
}

/* Settings that would keep a run from ever getting anywhere. */
static rt_status check_settings(rt_session *s) {
  double span = s->stop - s->start, step = s->options.step, interval = s->recorder.interval;
  if (step > 0 && (step < 16 * rt_time_resolution(s) || span / step > RT_MOST_STEPS))
    return rt_fail(s, RT_ARGUMENT, s->start, -1, NULL, "a step of %.9g s does not get through %.9g s", step, span);
  if (span > 0 && rt_time_resolution(s) > s->options.rtol * span)
    return rt_fail(s, RT_ARGUMENT, s->start, -1, NULL,
                   "time is rounded to %.3g s at %.9g s, which is more than the tolerance of a run of %.9g s",
                   rt_time_resolution(s), s->start, span);
  if (s->recorder.n_grid == 0 && interval > 0 && (span / interval) * (s->recorder.n + 2) > RT_MOST_VALUES)
    return rt_fail(s, RT_ARGUMENT, s->start, -1, NULL,
                   "an output interval of %.9g s makes %.3g rows of %d variables: more than %.0g values", interval,
                   span / interval, s->recorder.n, RT_MOST_VALUES);
  return RT_OK;
}

/* Now and then: is there progress, and does the caller want to go on? */
static rt_status look_up(rt_session *s) {
  if (s->patient.looks++ % STEPS_BETWEEN_LOOKS) return RT_OK;
  double now = rt_clock_of(CLOCK_MONOTONIC);
  if (now - s->patient.looked_at < look_every) return RT_OK;
  s->patient.looked_at = now;
  rt_status status = rt_check_patience(s);
  if (status || !s->interrupted || !s->interrupted(s->t)) return status;
  return rt_fail(s, RT_INTERRUPTED, s->t, -1, NULL, "interrupted at time %.9g s", s->t);
}

void rt_session_watch(rt_session *s, int (*interrupted)(double time)) {
  s->interrupted = interrupted;
}

/* From nothing to the first point after the events at the start. */
rt_status rt_begin(rt_session *s) {
  if (!(s->stop > s->start) || !isfinite(s->start) || !isfinite(s->stop))
    return rt_fail(s, RT_ARGUMENT, s->start, -1, NULL, "stop time %.9g s is not later than start time %.9g s", s->stop,
                   s->start);
  double span = s->stop - s->start; /* its steps must be numbers of full precision */
  if (!(span > DBL_MIN / DBL_EPSILON && isfinite(span)))
    return rt_fail(s, RT_ARGUMENT, s->start, -1, NULL, "a run of %.9g s is beyond what can be computed with", span);
  rt_status status = check_settings(s);
  if (!status) status = rt_initialise(s);
  if (status) return status;
  rt_scale_start(s);
  rt_looks_begin(s);
  rt_slopes_forget(s);
  if (!status && s->sensitivities) status = rt_tangent_begin(s);
  if (!status) status = rt_check_asserts(s);
  if (!status) status = rt_follow_undetermined(s);
  if (!status) status = rt_check_point(s, true);
  if (!status) status = s->method->begin(s, s->memory);
  rt_branch_start(s);
  rt_record_begin(s);
  return status ? status : rt_record_step(s);
}

/* Looks inside steps cost as well: one evaluation of the model, of which a step of dopri5 has six. */
static rt_status check_steps(rt_session *s) {
  long most = s->options.max_steps;
  if (most <= 0 || s->steps_taken + s->pieces_taken / PIECES_OF_A_STEP < most) return RT_OK;
  return rt_fail(s, RT_STEP_COLLAPSE, s->t, -1, NULL, "more than %ld steps%s up to time %.9g s", most,
                 s->pieces_taken > s->steps_taken ? ", looks inside them counted," : "", s->t);
}

static rt_status step(rt_session *s) {
  s->steps_taken++;
  s->dense.valid = s->shaped = false;
  if (!s->tiny_steps)
    s->data.failure.kind = MDL_FAILURE_NONE; /* while steps vanish, what made them short is their cause */
  if (s->recorder.needs_rhs) memcpy(s->recorder.v, s->data.v, (size_t)s->d->n_v * sizeof *s->data.v);
  if (s->sensitivities) s->sensitivities->dense.valid = false;
  rt_looks_start(s);
  rt_status status = s->method->step(s, s->memory, rt_clock_limit(s));
  s->t_end = s->t;
  if (s->growing) rt_scale_grow(s);
  s->tiny_steps = s->t - s->t_previous < rt_smallest_step(s) ? s->tiny_steps + 1 : 0;
  if (s->tiny_steps > MAX_TINY_STEPS) return rt_fail_collapse(s, s->t - s->t_previous, "its steps vanish");
  if (!status) status = rt_check_undetermined(s);
  if (!status) rt_looks_divide(s);
  return status;
}

/* To the end of a step or of the first piece of one that is looked at in pieces, or of the next piece of the last. */
static rt_status move_on(rt_session *s) {
  s->t_previous = s->t;
  s->pending = 0;
  rt_status status = check_steps(s);
  if (status) return status;
  if (!s->resume) {
    if ((status = step(s)) || !s->in_pieces) return status;
  }
  s->resume = false;
  s->pieces_taken++;
  return rt_look_on(s);
}

/* A step or a piece of one, up to the next event: what happens there is in s->pending. */
rt_status rt_advance(rt_session *s) {
  rt_status status = look_up(s);
  if (!status) status = rt_delays_leave(s);
  if (!status) status = rt_transports_leave(s, false);
  if (!status) status = move_on(s);
  if (!status) status = rt_find_state_event(s);
  if (!status) status = rt_tangent_follow(s);
  if (!status) status = rt_branch_follow(s);
  if (status && s->branches.ended) (void)rt_record_step(s); /* up to there */
  if (!status) status = rt_delays_follow(s);
  if (!status) status = rt_transports_follow(s);
  if (!status) status = rt_check_asserts(s);
  if (!status) status = rt_check_point(s, false);
  if (status) return status;
  s->pending |= rt_clock_due(s);
  if (!s->pending) s->resume = s->t < s->t_end;
  if ((status = rt_record_step(s))) return status;
  rt_branch_begin(s);
  return RT_OK;
}

/* What is pending happens. */
rt_status rt_happen(rt_session *s) {
  if (!s->pending) return RT_OK;
  rt_status status = rt_event(s);
  rt_delays_event(s);
  rt_transports_event(s);
  if (!status) status = rt_check_asserts(s);
  if (s->pending != RT_PENDING_BRANCH) rt_branch_begin(s); /* else the equations are the same */
  s->pending = 0;
  return status ? status : rt_check_point(s, true);
}

static rt_status finish(rt_session *s, rt_status status) {
  s->method->count(s, s->memory);
  if (s->data.terminated) s->result->terminated = s->d->messages[s->data.terminated - 1];
  if (!status) {
    s->data.terminal = 1;
    memset(s->flip, 1, (size_t)s->d->n_rel); /* what has come to rest at zero, and crossed nothing, stays as it was */
    status = rt_iterate_event(s);
  }
  if (!status) status = rt_record_end(s);
  if (!status && s->result->lost)
    status = rt_fail(s, RT_MEMORY, s->t, -1, NULL, "out of memory: the log of events is not complete");
  memcpy(s->result->parameters, s->data.p, (size_t)s->d->n_p * sizeof *s->data.p);
  if (s->sensitivities)
    memcpy(s->result->margins, s->sensitivities->margin, (size_t)s->sensitivities->n * sizeof(double));
  s->result->failure = s->failure;
  return status;
}

static size_t expected_rows(const rt_session *s) {
  const rt_recorder *r = &s->recorder;
  if (r->n_grid > 0) return (size_t)r->n_grid + 2;
  double rows = r->interval > 0 ? (s->stop - s->start) / r->interval : 1000;
  return rows > 0 && rows < 1e8 ? (size_t)rows + 2 : 2;
}

rt_result *rt_session_run(rt_session *s, double start, double stop) {
  s->start = start;
  s->stop = stop;
  s->failure = (rt_failure){.status = RT_OK, .variable = -1};
  s->result = rt_result_new(s->recorder.n, s->sensitivities ? s->sensitivities->n : 0, s->d->n_p, expected_rows(s));
  if (!s->result) return NULL;
  rt_status status = rt_begin(s);
  s->patient.looked_at = rt_clock_of(CLOCK_MONOTONIC);
  rt_start_patience(s);
  while (!status && s->t + s->clock.tolerance < s->stop && !s->data.terminated)
    if (!(status = rt_advance(s))) status = rt_happen(s);
  if (!status && !s->data.terminated) s->t = s->stop; /* from an event that is one instant with the end */
  finish(s, status);
  return s->result;
}
