/* Forward sensitivities: derivatives of everything that a run computes with respect to some parameters and initial
 * values.
 *
 * The derivatives ("tangents") are rows of a bundle (mdl_tangent.h), one column for each parameter. `at` belongs to the
 * session's present point, as data does; a method integrates its rows of states, the model gives the others from them.
 */
#ifndef RT_SENSITIVITY_H
#define RT_SENSITIVITY_H

#include "mdl_tangent.h"
#include "session.h"

/* What is known of the event at hand. */
typedef struct {
  bool any, disagree, grazed; /* something moves its instant; two things do, differently; one only touched zero */
  double uncertain;           /* of the instant (s) */
  int relation, other;        /* the first that switched and one that disagrees, -1 if none */
} rt_instant;

struct rt_sensitivities {
  int n, columns;     /* asked for; rounded up to whole vectors */
  int *variables;     /* [n] rows of the variable table: parameters, and states for their initial values */
  double *numbers;    /* the block that all arrays of doubles are slices of */
  double *scale;      /* [columns] size of a change of each parameter; 0: not known, its column is measured by itself */
  double *weight;     /* [columns] 1 / scale; infinite where that is not known */
  mdl_tangent at;     /* at the session's t */
  mdl_tangent inside; /* at points inside a step; its p, u, d and t are those of `at` */
  mdl_tangent probe;  /* one vector of other directions, to measure the slopes of a guard */
  double *guards;     /* [n_rel * columns] of the guards at fixed time */
  double *slopes;     /* [n_rel] total derivatives of the guards by time before the event */
  double *probed;     /* [n_rel * MDL_LANES] */
  double *input_slope;                    /* [n_u] */
  double *first, *interval;               /* [n_sample * columns] of the sample clocks */
  double *event_time, *event_time_before; /* [columns] dt/dp of this event and the last one; t_before its time */
  double t_before, t_uncertain;           /* of the last event, and how well its time is known */
  int relation_before;                    /* that it switched, -1: none */
  double *tick;                           /* [columns] how the instant of a sample moves */
  double *margin;                         /* [n] smallest change of a parameter that swaps two events, to first order */
  rt_instant instant;
  double *x_before; /* [n_x * columns] states' tangents before the event */
  rt_dense dense;
  bool complete; /* v of `at`, and xdot, belong to its x */
  bool lost;     /* they do not exist from here on: an event was grazed, or they overflowed */
};

static inline double *rt_rows(mdl_lanes *rows) {
  return (double *)rows;
}

/* sensitivity.c */
void rt_sensitivities_free(rt_session *s);
rt_status rt_tangent_start(rt_session *s);
rt_status rt_tangent_initial(rt_session *s, bool solved);
rt_status rt_tangent_initial_event(rt_session *s);
rt_status rt_tangent_begin(rt_session *s);
rt_status rt_tangent_evaluate(rt_session *s);
rt_status rt_tangent_follow(rt_session *s);
void rt_tangent_inside(rt_session *s, double t);
int rt_tangent_inside_point(rt_session *s, double t, const double *x, const double *xdot, const double *v);
void rt_tangent_lose(rt_session *s, rt_flag_kind kind, int relation);
void rt_tangent_check_finite(rt_session *s);

/* jump.c */
rt_status rt_jump_measure(rt_session *s);
void rt_jump_begin(rt_session *s);
int rt_jump_sweep(rt_session *s, double *v, bool first);
void rt_jump_accept(rt_session *s);
rt_status rt_jump_end(rt_session *s);

#endif
