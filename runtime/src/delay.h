/* delay.c: what delay() looks back into. Nothing happens where a model has none. */
#ifndef RT_DELAY_H
#define RT_DELAY_H

#include "session.h"

typedef struct rt_delays rt_delays;

bool rt_delays_create(rt_session *s);
void rt_delays_free(rt_session *s);
rt_status rt_delays_begin(rt_session *s); /* of a run */
int rt_delays_start(rt_session *s);       /* the initial equations are solved */
void rt_delays_at(rt_session *s, double t);
void rt_delays_pass(rt_session *s, double t);
double rt_delays_limit(rt_session *s);
int rt_delays_due(rt_session *s);
rt_status rt_delays_leave(rt_session *s);
rt_status rt_delays_follow(rt_session *s);
void rt_delays_event(rt_session *s);

#endif
