/* Does a run get anywhere? (patience.c) */
#ifndef RT_PATIENCE_H
#define RT_PATIENCE_H

#include <time.h>

#include "lacuna_runtime.h"

static const double RT_MOST_STEPS = 1e10; /* of a run, by a fixed size or at its last pace: weeks */

/* Where patience began: processor time, t, and the steps and passes of events by then. `looks` at it, now and then, the
 * last when the monotonic clock said `looked_at`. */
typedef struct {
  double from, t, looked_at;
  long steps, passes, looks;
} rt_patience;

double rt_clock_of(clockid_t clock);
void rt_start_patience(rt_session *s);
rt_status rt_check_patience(rt_session *s);

#endif
