/* Guards that are affine in the states, on the polynomial of a step. */
#ifndef RT_SWINGS_H
#define RT_SWINGS_H

#include "session.h"

#define RT_ROUNDING 1e-14 /* of a state's nominal value: no absolute tolerance is below it */

void rt_swing_shape(rt_session *s, const double *error);
/* reach.c */
struct rt_slopes *rt_slopes_new(const mdl_descriptor *d);
void rt_slopes_free(struct rt_slopes *slopes);
void rt_slopes_forget(rt_session *s);
bool rt_keep_away(rt_session *s, const double *error, double share);

bool rt_is_shaped(const rt_session *s, int r);
bool rt_all_affine(const mdl_descriptor *d);
double rt_swing_error(rt_session *s, double to, const double *error);
double rt_swing_roughness(rt_session *s, double to, const double *error);
double rt_swing_crossing(rt_session *s, int r, double to);
rt_status rt_swing_fail(rt_session *s, double to);
bool rt_look_along(rt_session *s, double to, const double *places, int count); /* defect.c */
int rt_find_swing(rt_session *s, double *inside);

#endif
