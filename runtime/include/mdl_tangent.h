/* Derivatives of a generated model, written on request (codegen: `sensitivities`): each function of mdl_abi.h once
 * more, as the derivative of its results in any number of directions at once.
 *
 * A bundle of directions has one row for each variable; entry k of a row is the derivative of that variable in
 * direction k. Rows are whole vectors of MDL_LANES directions, so that a row is `lanes` vectors long. Relations, ticks,
 * Booleans and Integers are frozen: what they select is differentiated, they are not.
 *
 * All functions take the complete point (t, x, xdot, v) that the function they differentiate has computed, with the
 * discretes, relations and parameters in `m` as they were then. They return 0, or as the functions of mdl_abi.h. */
#ifndef MDL_TANGENT_H
#define MDL_TANGENT_H

#include "mdl_abi.h"

#ifdef __cplusplus
extern "C" {
#endif

#define MDL_LANES 4
typedef double mdl_lanes __attribute__((vector_size(MDL_LANES * sizeof(double)), aligned(sizeof(double)), may_alias));

/* Functions that work on whole vectors: compiled twice on x86, so that a machine with vectors of four doubles uses
 * them. The results are the same to the last bit, as nothing is contracted. Not under the thread sanitizer, which is
 * not ready yet when the choice is made. */
#if defined(__x86_64__) && defined(__gnu_linux__) && !defined(__SANITIZE_THREAD__)
#define MDL_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define MDL_WIDE
#endif

typedef struct mdl_tangent {
  int lanes;
  mdl_lanes *t;                                /* [lanes] time */
  mdl_lanes *p, *u, *x, *xdot, *v, *d, *pre_d; /* [n_p * lanes] ... as in mdl_data */
  mdl_lanes *x_after;                          /* [n_x * lanes] of event(): the states as reinit leaves them */
} mdl_tangent;

typedef int (*mdl_point_tangent)(mdl_data *m, double t, const double *x, const double *xdot, const double *v,
                                 mdl_tangent *tangent);

struct mdl_tangents {
  /* [n_p] 0: a settable parameter that enters conditions and discrete equations alone; nothing depends on it smoothly
   */
  const unsigned char *differentiable;
  int rounds; /* 1: events round values that move (converters, encoders), so that what they keep has the derivative zero
               */

  /* p of the dependent parameters from p of the settable ones. */
  int (*parameters)(mdl_data *m, mdl_tangent *tangent);
  /* x, v, d and pre_d from p, of the start attributes. */
  int (*starts)(mdl_data *m, mdl_tangent *tangent);
  /* Rows of start [n_sample * lanes] and interval from p. */
  int (*samples)(mdl_data *m, mdl_tangent *tangent, mdl_lanes *start, mdl_lanes *interval);

  mdl_point_tangent initial_system; /* x from p, u, d */
  mdl_point_tangent rhs;            /* xdot and v from t, p, u, x, d */
  mdl_point_tangent derivatives;    /* only xdot from the same: what an integration method needs at each stage */

  /* Rows of F [(n_x + n_z) * lanes] from those of y [(n_x + n_z) * lanes], y' [n_x * lanes] and t, p, u, d. */
  int (*residual)(mdl_data *m, double t, const double *y, const double *yp, mdl_tangent *tangent,
                  const mdl_lanes *y_rows, const mdl_lanes *yp_rows, mdl_lanes *r);

  /* Rows of g [n_rel * lanes], of time relations too. */
  int (*roots)(mdl_data *m, double t, const double *x, const double *xdot, const double *v, mdl_tangent *tangent,
               mdl_lanes *g);

  /* event() itself once more, with d and x_after from t, p, u, x, xdot, v and pre_d. Needs m->when as it was before
   * event(); x_after holds x on entry. */
  int (*event)(mdl_data *m, double t, double *x, const double *xdot, const double *v, mdl_tangent *tangent);
};

#ifdef __cplusplus
}
#endif
#endif
