/* transport.c: what spatialDistribution() carries. Nothing happens where a model has none. */
#ifndef RT_TRANSPORT_H
#define RT_TRANSPORT_H

#include "session.h"

bool rt_transports_create(rt_session *s);
void rt_transports_free(rt_session *s);
rt_status rt_transports_begin(rt_session *s);             /* of a run */
int rt_transports_start(rt_session *s);                   /* the initial equations are solved */
rt_status rt_transports_leave(rt_session *s, bool event); /* a step or an event begins: what the ends can reach */
rt_status rt_transports_follow(rt_session *s);
void rt_transports_event(rt_session *s);

#endif
