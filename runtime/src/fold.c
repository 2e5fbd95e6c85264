/* Algebraic unknowns that jump inside a step: the branch of a nonlinear block that they followed has ended (a fold).
 *
 * The run goes on, on another branch. Its sensitivities do not: the instant of the jump moves with the parameters, and
 * no guard tells how. A jump is told from a change that is only fast by halving the step around it: the half with the
 * larger change keeps all of a jump, while anything continuous shrinks until no tolerance sees it. */
#include <math.h>
#include <string.h>

#include "sensitivity.h"

enum { HALVINGS = 40 };            /* of a step: a root at its end has shrunk to a millionth by then */
static const double sudden = 10;   /* times the rate of the step before */
static const double visible = 100; /* tolerances: what IDA's algebraic unknowns may be off, and more */

/* Unknown k of the residual form moves by this, from v0 to v1. */
static double moved(const rt_session *s, int k, const double *v0, const double *v1) {
  return fabs(v1[s->d->z_index[k]] - v0[s->d->z_index[k]]);
}

/* Whether unknown k jumps between t_previous and t, by more than `least`. Leaves inputs inside the step. */
static bool jumps(rt_session *s, int k, double least) {
  rt_sensitivities *f = s->sensitivities;
  size_t size = (size_t)s->d->n_v * sizeof(double);
  double a = s->t_previous, b = s->t, end = s->data.v[s->d->z_index[k]];
  memcpy(f->v_low, f->v_previous, size);
  rt_dense_prepare(s);
  for (int i = 0; i < HALVINGS; i++) {
    double middle = 0.5 * (a + b);
    rt_dense_eval(&s->dense, s->d->n_x, middle, s->x_trial);
    memcpy(s->v_trial, f->v_low, size);
    if (rt_rhs(s, middle, s->x_trial, s->xdot_trial, s->v_trial)) return true;
    double there = s->v_trial[s->d->z_index[k]], before = moved(s, k, f->v_low, s->v_trial), behind = fabs(end - there);
    if (rt_max(before, behind) < least) return false;
    if (before > behind) {
      b = middle;
      end = there;
    } else {
      a = middle;
      memcpy(f->v_low, s->v_trial, size);
    }
  }
  return true;
}

/* After an event, or at the start: no step lies behind. */
void rt_fold_restart(rt_session *s) {
  rt_sensitivities *f = s->sensitivities;
  memcpy(f->v_previous, s->data.v, (size_t)s->d->n_v * sizeof(double));
  for (int k = 0; k < s->d->n_z; k++)
    f->rate[k] = NAN;
}

/* Whether an unknown jumps in the step from t_previous to t: sensitivities end there. */
bool rt_fold_follow(rt_session *s) {
  rt_sensitivities *f = s->sensitivities;
  double h = s->t - s->t_previous;
  bool jumped = false;
  for (int k = 0; k < s->d->n_z && !jumped && h > 0; k++) {
    if (s->d->z_branches && !s->d->z_branches[k]) continue;
    double change = moved(s, k, f->v_previous, s->data.v), size = fabs(s->data.v[s->d->z_index[k]]);
    double least = visible * (s->options.rtol * size + s->atol[s->d->n_x + k]);
    jumped = change > least && !(change < sudden * f->rate[k] * h) && jumps(s, k, least);
    f->rate[k] = change / h;
  }
  if (s->d->n_u) rt_inputs_at(s, s->t);
  memcpy(f->v_previous, s->data.v, (size_t)s->d->n_v * sizeof(double));
  return jumped;
}
