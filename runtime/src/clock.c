/* Time events: sample() ticks, time relations, and the grid of a fixed step. */
#include <math.h>
#include <string.h>

#include "clock.h"

static double tick_time(const rt_clock *c, int i) {
  return c->first[i] + (double)c->next[i] * c->interval[i];
}

/* After the number of a tick has changed. */
void rt_clock_look(rt_session *s) {
  s->clock.next_tick = INFINITY;
  for (int i = 0; i < s->d->n_sample; i++)
    s->clock.next_tick = rt_min(s->clock.next_tick, tick_time(&s->clock, i));
}

rt_status rt_clock_begin(rt_session *s) {
  rt_clock *c = &s->clock;
  c->tolerance = rt_max(1e-13 * (s->stop - s->start), rt_time_resolution(s));
  c->step = 1;
  if (s->d->n_sample && s->d->samples(&s->data, c->first, c->interval))
    return rt_fail_model(s, s->start, "computing sample times");
  for (int i = 0; i < s->d->n_sample; i++) {
    if (!(c->interval[i] > 0))
      return rt_fail(s, RT_ARGUMENT, s->start, -1, NULL, "sample() number %d has interval %.9g s", i + 1,
                     c->interval[i]);
    if (c->interval[i] < 16 * rt_time_resolution(s))
      return rt_fail(s, RT_ARGUMENT, s->start, -1, NULL,
                     "sample() number %d has interval %.9g s, which is lost in the rounding of time (%.3g s here)",
                     i + 1, c->interval[i], rt_time_resolution(s));
    c->next[i] = (long)rt_max(0, ceil((s->start - c->tolerance - c->first[i]) / c->interval[i]));
  }
  rt_clock_look(s);
  if (s->d->time_relations(&s->data, s->start)) return rt_fail_model(s, s->start, "evaluating time relations");
  c->next_relation = s->d->next_time_event(&s->data, s->start);
  return RT_OK;
}

/* As rt_clock_limit, of fixed steps or with inputs. */
double rt_clock_limit_beside(rt_session *s) {
  double limit = s->stop;
  if (s->options.step > 0) {
    rt_clock *c = &s->clock;
    while (s->start + (double)c->step * s->options.step <= s->t + c->tolerance)
      c->step++;
    limit = rt_min(limit, s->start + (double)c->step * s->options.step);
    if (!s->options.locate_events) return limit;
  }
  limit = rt_min(limit, rt_clock_next(s));
  return s->d->n_u ? rt_min(limit, rt_inputs_next_break(s)) : limit;
}

static void log_time_relations(rt_session *s) {
  for (int r = 0; r < s->d->n_rel; r++)
    if (!rt_is_state_relation(s, r) && s->data.rel[r] != s->rel_before[r])
      rt_result_log(s->result, s->t, RT_EVENT_TIME, r, s->data.rel[r] ? 1 : -1, 1);
}

/* Time relations with the discrete variables as they are now, and when the next one switches. Whether any changed. What
 * these variables have made due within the tolerance happens at its own time: the event's equations read the time, and
 * would take the relation back. */
bool rt_clock_relations(rt_session *s) {
  const double last = s->t + s->clock.tolerance;
  double due = s->d->next_time_event(&s->data, s->t);
  for (; due > s->t && due <= last; due = s->d->next_time_event(&s->data, s->t))
    s->t = due;
  memcpy(s->rel_trial, s->data.rel, (size_t)s->d->n_rel);
  s->d->time_relations(&s->data, s->t);
  s->clock.next_relation = due;
  return memcmp(s->rel_trial, s->data.rel, (size_t)s->d->n_rel) != 0;
}

/* Switch the time relations and raise the ticks that are due. */
void rt_clock_tick(rt_session *s) {
  rt_clock *c = &s->clock;
  double now = s->t + c->tolerance;
  if (s->pending & RT_PENDING_TIME) {
    s->d->time_relations(&s->data, s->t);
    log_time_relations(s);
    c->next_relation = s->d->next_time_event(&s->data, s->t);
    s->result->counters.time_events++;
  }
  for (int i = 0; i < s->d->n_sample; i++) {
    if (tick_time(c, i) > now) continue;
    s->data.tick[i] = 1;
    rt_result_log(s->result, s->t, RT_EVENT_SAMPLE, i, 1, 1);
    s->result->counters.sample_events++;
    while (tick_time(c, i) <= now)
      c->next[i]++;
  }
  rt_clock_look(s);
}
