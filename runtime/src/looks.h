/* Looking at a step in pieces. */
#ifndef RT_LOOKS_H
#define RT_LOOKS_H

#include "session.h"

void rt_looks_begin(rt_session *s);
void rt_looks_start(rt_session *s);
void rt_looks_divide(rt_session *s);
void rt_keep_step_end(rt_session *s);
rt_status rt_look_on(rt_session *s);

#endif
