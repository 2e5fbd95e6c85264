/* Does a run get anywhere, or is it to be ended? */
#include <stdio.h>

#include "session.h"

static const double patience = 60;  /* s of computing that may bring less than */
static const double headway = 1e-6; /* of the run: at this pace it takes two years */

double rt_clock_of(clockid_t clock) {
  struct timespec now;
  clock_gettime(clock, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

void rt_start_patience(rt_session *s) {
  s->patient.from = rt_clock_of(CLOCK_THREAD_CPUTIME_ID);
  s->patient.t = s->t;
  s->patient.steps = s->steps_taken;
  s->patient.passes = s->result->counters.event_passes;
}

/* Processor time, so that a run that was stopped for a while is not blamed for it. Steps that get somewhere may still
 * be so small that the run does not end: a derivative that jumps from step to step with the sign of its state. */
rt_status rt_check_patience(rt_session *s) {
  const rt_patience *since = &s->patient;
  double span = s->stop - s->start, done = s->t - since->t;
  double limit = s->options.patience > 0 ? s->options.patience : patience;
  if (rt_clock_of(CLOCK_THREAD_CPUTIME_ID) - since->from <= limit) return RT_OK;
  long steps = s->steps_taken - since->steps, passes = s->result->counters.event_passes - since->passes;
  if (done >= headway * span && done * RT_MOST_STEPS >= span * (double)steps) {
    rt_start_patience(s);
    return RT_OK;
  }
  char why[120];
  snprintf(why, sizeof why, "%.3g s of computing brought %.3g s of %.9g s", limit, done, span);
  if (passes > steps / 2)
    return rt_fail(s, RT_STEP_COLLAPSE, s->t, -1, NULL, "no progress at time %.9g s: %s, with %ld events", s->t, why,
                   passes);
  return rt_fail_collapse(s, s->t - s->t_previous, why);
}
