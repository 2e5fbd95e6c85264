/* Steps that leave the branch of a nonlinear block on which they began (fold.c): a solution of another one was nearer
 * to what a method predicted, or to where a stage began. What has been integrated then is of neither. */
#include <math.h>
#include <string.h>

#include "session.h"

/* Below this, in smallest steps, a step is taken as it is: a quarter of it, which a method would try next, is too short
 * for it. There unknowns jump. */
static const double shortest = 8;

/* Whether a relation has changed by the end of a step: what is solved behind its crossing counts for nothing. */
static bool crosses(rt_session *s, double end) {
  const rt_branches *b = &s->branches;
  if (!s->d->n_rel) return false;
  mdl_failure told = s->data.failure;
  if (rt_branch_look(s, end) || s->d->roots(&s->data, end, s->x_trial, b->xdot_tried, b->v_tried, s->g_trial)) {
    s->data.failure = told;
    return false;
  }
  for (int r = 0; r < s->d->n_rel; r++) {
    double past = s->data.rel[r] ? -s->g_trial[r] : s->g_trial[r];
    if (rt_is_state_relation(s, r) && past > rt_hysteresis(s, r)) return true;
  }
  return false;
}

/* As rt_branch_reach; where the branch ends before, nothing has happened. */
bool rt_branch_is_reached(rt_session *s, double end) {
  mdl_data *m = &s->data;
  size_t states = (size_t)s->d->n_x * sizeof *m->x, values = (size_t)s->d->n_v * sizeof *m->v;
  rt_failure before = s->failure;
  mdl_failure told = m->failure;
  double t = s->t;
  memcpy(s->x_end, m->x, states);
  memcpy(s->xdot_end, m->xdot, states);
  memcpy(s->v_end, m->v, values);
  bool reached = !rt_branch_reach(s, end);
  if (!s->branches.ended) return reached;
  memcpy(m->x, s->x_end, states);
  memcpy(m->xdot, s->xdot_end, states);
  memcpy(m->v, s->v_end, values);
  s->t = t;
  s->failure = before;
  m->failure = told;
  s->branches.ended = false;
  return false;
}

/* Whether the branch turns on its way from the last point of the run to what has been reached. */
static bool turns(const rt_session *s) {
  const rt_branches *b = &s->branches;
  return memcmp(b->facing_reached, b->facing, (size_t)s->d->n_equations * sizeof(double)) != 0;
}

/* Whether a step to `end` (x, x' there) strays: over it the derivatives on another branch move a state by more than its
 * tolerance; or one was met on the way (`turned`), though the branch has not turned itself; or it is too long to follow
 * the branch. Where that ends, so does the run, with *status; without a status the step is too long. */
bool rt_branch_strays(rt_session *s, double end, const double *x, const double *xdot, bool turned, rt_status *status) {
  if (!s->d->n_branches || crosses(s, end)) return false;
  rt_status reached = status ? rt_branch_reach(s, end) : RT_OK;
  bool lost = status ? reached != RT_OK : !rt_branch_is_reached(s, end);
  if (status && s->branches.ended) {
    *status = reached;
    return false;
  }
  if (!(end - s->t > shortest * rt_smallest_step(s))) return false;
  if (lost || (turned && !turns(s))) return true;
  for (int i = 0; i < s->d->n_x; i++) {
    double moved = fabs(xdot[i] - s->branches.xdot_reached[i]) * (end - s->t);
    if (moved > s->options.rtol * fabs(x[i]) + s->atol[i]) return true;
  }
  return false;
}

/* A step has been given up: from where it began. */
void rt_branch_retreat(rt_session *s) {
  rt_branches *b = &s->branches;
  if (!s->d->n_branches) return;
  memcpy(b->orientation, b->facing, (size_t)s->d->n_equations * sizeof *b->facing);
  s->data.contraction = (mdl_contraction){0};
}
