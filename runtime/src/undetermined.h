/* Unknowns that a mode leaves open, and what holds them in the Jacobian. */
#ifndef RT_UNDETERMINED_H
#define RT_UNDETERMINED_H

#include "session.h"

/* A term value * (change of the unknown `column`) in row `row` of the residual form's Jacobian. */
typedef struct rt_held {
  int row, column;
  double value;
} rt_held;

rt_status rt_follow_undetermined(rt_session *s);
rt_status rt_check_undetermined(rt_session *s);

#endif
