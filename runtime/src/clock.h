/* Instants known in advance (clock.c), as every step asks for them. */
#ifndef RT_CLOCK_H
#define RT_CLOCK_H

#include "session.h"

double rt_clock_limit_beside(rt_session *s);

/* The next tick or time relation. */
static inline double rt_clock_next(const rt_session *s) {
  return rt_min(s->clock.next_relation, s->clock.next_tick);
}

/* The next instant that the step may not pass: where something happens at a known time. */
static inline double rt_clock_limit(rt_session *s) {
  if (s->options.step > 0 || s->d->n_u) return rt_clock_limit_beside(s);
  return rt_min(s->stop, rt_clock_next(s));
}

/* What has become due at the present time, as RT_PENDING flags. */
static inline int rt_clock_due(rt_session *s) {
  double now = s->t + s->clock.tolerance;
  int pending = s->clock.next_relation <= now ? RT_PENDING_TIME : 0;
  if (s->clock.next_tick <= now) pending |= RT_PENDING_SAMPLE;
  return s->d->n_u ? pending | rt_inputs_due(s) : pending;
}

#endif
