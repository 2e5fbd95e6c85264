/* Branches of nonlinear blocks (fold.c). */
#ifndef RT_FOLD_H
#define RT_FOLD_H

#include <stdbool.h>

#include "lacuna_runtime.h"

typedef struct {
  double t;                            /* of the last point of the run whose values are known to be one branch, */
  double *v, *xdot, *x;                /* [n_v], [n_x] and these values; the states where a step began */
  double *v_reached, *xdot_reached;    /* those while it is followed, */
  double *v_tried, *xdot_tried, *size; /* and of a point that is tried; [n_branches] largest values so far */
  double reached;                      /* where those are that have been reached; */
  double *facing, *facing_reached;     /* [n_equations] sides (mdl_data.facing) at the one and the other; */
  double *orientation, *aside;         /* at the session's point, and at the last other point looked at */
  long pieces;                         /* that may still be looked at */
  bool ended;                          /* by a fold, at the session's present point */
} rt_branches;

void rt_branch_start(rt_session *s);
void rt_branch_begin(rt_session *s);
rt_status rt_branch_row(rt_session *s, double t, double *xdot, double *v, bool found);
bool rt_branch_take(rt_session *s);
rt_status rt_branch_reach(rt_session *s, double end);
int rt_branch_look(rt_session *s, double t);
rt_status rt_branch_follow(rt_session *s);

/* stray.c */
bool rt_branch_is_reached(rt_session *s, double end);
bool rt_branch_strays(rt_session *s, double end, const double *x, const double *xdot, bool turned, rt_status *status);
void rt_branch_retreat(rt_session *s);

#endif
