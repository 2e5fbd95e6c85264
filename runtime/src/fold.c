/* A run follows one solution of its nonlinear equations. Where that ends, at a fold, their Jacobian is singular; behind
 * it there is no solution or another one, to which Newton's method may jump.
 *
 * Where the steps of Newton's method, from one point of the run to the next, shrink as they do for a simple root, to a
 * root that faces the same way, it is on the same branch: the model notes it. Else the step is followed in halves, each
 * from the end of the one before, until that is so or nothing changes that a tolerance sees. What still jumps when time
 * hardly moves is a fold where the unknowns come near it as a root does, ever faster; no jump where it is smaller, the
 * shorter the way, as where a Jacobian vanishes but the solution goes on (q abs(q) = p at p = 0). All are ratios
 * without a scale. Where they come near it as a line does, the equations jump or have a corner, in noEvent or smooth:
 * an event, at which unknowns may jump (the trigger of Schmitt, made of a limited amplifier). */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "sensitivity.h"

/* Pieces that may be looked at: of one step, enough for a hundred places that are followed down to the rounding of
 * time; in the long run, as many evaluations for a step as the step itself takes of an explicit method. Where a
 * function is smooth nowhere, what is more is taken as it is: a run ends in a time that grows with its steps. */
enum { MOST_PIECES = 5000, PIECES_PER_STEP = 7 };
static const double least = 1e-8; /* of a size: what Newton's method may be off by, and more */
static const double longest = 0x1p20, first_way = 0x1p12, farther = 0x1p8; /* ways, in what time tells apart */
static const double slower = 0x1p2,
                    faster = 0x1p6; /* what a root of order 4 takes `farther` as, and less than a line */

static double *kept(const mdl_computed *c, double *v, double *xdot) {
  return (c->storage == MDL_DERIVATIVE ? xdot : v) + c->index;
}

static bool is_doubtful(const rt_session *s) {
  return s->data.contraction.ratio > MDL_CONTRACTS || s->data.contraction.turned;
}

/* Largest change in tolerances, of the unknowns of one block or of all (-1). */
static double changed(rt_session *s, int equation) {
  rt_branches *b = &s->branches;
  double most = 0, tolerance = rt_max(s->options.rtol, least);
  for (int k = 0; k < s->d->n_branches; k++) {
    const mdl_computed *c = &s->d->branches[k];
    if (equation >= 0 && c->equation != equation) continue;
    double from = *kept(c, b->v_reached, b->xdot_reached), to = *kept(c, b->v_tried, b->xdot_tried);
    double size = rt_max(b->size[k], rt_max(fabs(from), fabs(to)));
    if (size > 0) most = rt_max(most, fabs(to - from) / (tolerance * size));
  }
  return most;
}

static void copy(const rt_session *s, double *v, double *xdot, const double *v_from, const double *xdot_from) {
  memcpy(v, v_from, (size_t)s->d->n_v * sizeof *v);
  memcpy(xdot, xdot_from, (size_t)s->d->n_x * sizeof *xdot);
}

static void turn(const rt_session *s, double *side, const double *from) {
  memcpy(side, from, (size_t)s->d->n_equations * sizeof *side);
}

/* The branch goes on from here. */
static void set_out(rt_session *s, double t, double *v, double *xdot, const double *side) {
  rt_branches *b = &s->branches;
  b->t = t;
  turn(s, b->facing, side);
  b->reached = NAN;
  copy(s, b->v, b->xdot, v, xdot);
  for (int k = 0; k < s->d->n_branches; k++)
    b->size[k] = rt_max(b->size[k], fabs(*kept(&s->d->branches[k], v, xdot)));
  s->data.contraction = (mdl_contraction){0};
}

/* At the start of a run. */
void rt_branch_start(rt_session *s) {
  s->branches.pieces = MOST_PIECES;
  memset(s->branches.size, 0, (size_t)s->d->n_branches * sizeof(double));
  memset(s->branches.facing, 0, (size_t)s->d->n_equations * sizeof(double));
  rt_branch_begin(s);
}

/* After an event and at an accepted point. */
void rt_branch_begin(rt_session *s) {
  s->branches.ended = false;
  if (!s->d->n_branches) return;
  memcpy(s->branches.x, s->data.x, (size_t)s->d->n_x * sizeof(double));
  set_out(s, s->t, s->data.v, s->data.xdot, s->branches.orientation);
}

/* The point (t, x_trial) from the values reached, in v_tried; 0 found. `only`: 0, or 1 + the block to watch. */
static int look_here(rt_session *s, double t, int only) {
  rt_branches *b = &s->branches;
  copy(s, b->v_tried, b->xdot_tried, b->v_reached, b->xdot_reached);
  turn(s, b->aside, b->facing_reached);
  s->data.contraction = (mdl_contraction){.only = only};
  return rt_rhs(s, t, s->x_trial, b->xdot_tried, b->v_tried);
}

static int look(rt_session *s, double t, int only) {
  rt_dense_point(s, t, s->x_trial);
  return look_here(s, t, only);
}

static double change_to(rt_session *s, double t, int equation) {
  return look(s, t, 1 + equation) ? INFINITY : changed(s, equation);
}

/* Whether the unknowns of a block jump from `from` to `to`, which time hardly tells apart: by as much as they do over a
 * longer way, as far as the step goes. */
static bool jumps(rt_session *s, double from, double to, int equation) {
  double way = to - from, longer = rt_max(0x1p4 * way, rt_min(longest * way, s->t - from));
  return !(change_to(s, to, equation) <= 0.5 * change_to(s, from + longer, equation));
}

/* The change back to what was a short way before `from`, perhaps before the last step, which may be shorter still. */
static double change_back(rt_session *s, double from, double way, int equation) {
  rt_dense_point(s, from, s->x_trial);
  for (int i = 0; i < s->d->n_x; i++)
    s->x_trial[i] -= way * s->branches.xdot_reached[i];
  return look_here(s, from - way, 1 + equation) ? INFINITY : changed(s, equation);
}

/* Along three ways: what rounding leaves of a line over a short way is hardly less over the next. */
static bool comes_as_a_root(rt_session *s, double from, double way, int equation) {
  double last = change_back(s, from, way *= first_way, equation);
  for (int k = 0; k < 2; k++) {
    double next = change_back(s, from, way *= farther, equation);
    if (!(next > slower * last && next < faster * last)) return false;
    last = next;
  }
  return true;
}

/* The run ends with the last point of the branch, which is what the session is left at. */
static rt_status fail(rt_session *s, double t, int equation) {
  rt_branches *b = &s->branches;
  char names[200] = "";
  int first = -1;
  for (int k = 0; k < s->d->n_branches; k++) {
    const mdl_computed *c = &s->d->branches[k];
    bool derivative = c->storage == MDL_DERIVATIVE;
    int row = c->equation != equation ? -1 : rt_find_row(s, derivative ? MDL_STATE : c->storage, c->index);
    if (row < 0) continue;
    if (first < 0) first = row;
    char name[100];
    snprintf(name, sizeof name, derivative ? "der(%s)" : "%s", s->d->variables[row].name);
    rt_append_name(names, sizeof names, name);
  }
  if (t > s->t_previous) rt_dense_point(s, t, s->data.x);
  copy(s, s->data.v, s->data.xdot, b->v_reached, b->xdot_reached);
  s->t = t;
  s->pending = 0;
  b->ended = true;
  return rt_fail(s, RT_SINGULAR, t, first, &s->d->equations[equation],
                 "the solution on this branch ends at time %.9g s, where the Jacobian of the block of %s is singular",
                 t, names);
}

/* Whether another root, which faces the other way, comes to where the block turns as the branch does, on its other
 * side: from there Newton's method finds it where the branch was last known. Two that meet are two ways to go on, and
 * one of them is what has been found behind. A root that turns by itself, as that of m (h - h0) = 0 with the sign of m,
 * has none beside it. */
static bool meets_another(rt_session *s, int equation) {
  rt_branches *b = &s->branches;
  rt_dense_point(s, b->t, s->x_trial);
  copy(s, b->v_tried, b->xdot_tried, b->v, b->xdot);
  for (int k = 0; k < s->d->n_branches; k++) {
    const mdl_computed *c = &s->d->branches[k];
    double here = *kept(c, b->v_reached, b->xdot_reached), *other = kept(c, b->v_tried, b->xdot_tried);
    if (c->equation == equation) *other = here - (*other - here);
  }
  s->data.contraction = (mdl_contraction){.only = 1 + equation};
  return !rt_rhs(s, b->t, s->x_trial, b->xdot_tried, b->v_tried) && s->data.contraction.turned == 1 + equation;
}

/* From the values reached at `from` to those at `to`. */
static rt_status follow(rt_session *s, double from, double to) {
  rt_branches *b = &s->branches;
  bool found = !look(s, to, 0), contracts = s->data.contraction.ratio <= MDL_CONTRACTS;
  int turned = found ? s->data.contraction.turned : 0;
  if (!found && contracts) return rt_fail_model(s, to, "following a branch"); /* something else has no value */
  if (b->pieces > 0 && (turned || (!contracts && (!found || changed(s, -1) > 1)))) {
    double middle = from + 0.5 * (to - from);
    int equation = turned ? turned - 1 : s->data.contraction.equation;
    b->pieces--;
    if (to - from > 2 * rt_time_resolution(s)) {
      rt_status status = follow(s, from, middle);
      return status ? status : follow(s, middle, to);
    }
    if (turned && changed(s, equation) <= 1 && meets_another(s, equation)) return fail(s, from, equation);
    if (jumps(s, from, to, equation)) {
      if (comes_as_a_root(s, from, to - from, equation)) return fail(s, from, equation);
      if (s->sensitivities) rt_tangent_lose(s, RT_FLAG_FOLD, -1);
    }
    found = !look(s, to, 0);
  }
  if (!found) return rt_fail_model(s, to, "following a branch");
  copy(s, b->v_reached, b->xdot_reached, b->v_tried, b->xdot_tried);
  turn(s, b->facing_reached, b->aside);
  return RT_OK;
}

static void go_back(rt_session *s) {
  rt_branches *b = &s->branches;
  copy(s, b->v_reached, b->xdot_reached, b->v, b->xdot);
  turn(s, b->facing_reached, b->facing);
}

/* The point at t of the last step, from the last of the run: 0 found, in v_tried. */
int rt_branch_look(rt_session *s, double t) {
  go_back(s);
  return look(s, t, 0);
}

/* At one go, where Newton's steps shrink: past a singular point that the branch goes through. */
static bool leap(rt_session *s, double t) {
  rt_branches *b = &s->branches;
  if (rt_branch_look(s, t) || s->data.contraction.ratio > MDL_CONTRACTS) return false;
  copy(s, b->v_reached, b->xdot_reached, b->v_tried, b->xdot_tried);
  turn(s, b->facing_reached, b->aside);
  return true;
}

static rt_status reach(rt_session *s, double t) {
  rt_branches *b = &s->branches;
  rt_failure before = s->failure;
  go_back(s);
  s->data.facing = b->facing_reached;
  if ((b->pieces += PIECES_PER_STEP) > MOST_PIECES) b->pieces = MOST_PIECES;
  rt_status status = follow(s, b->t, t);
  if (status && !b->ended && leap(s, t)) s->failure = before, status = RT_OK;
  b->reached = status ? NAN : t;
  s->data.contraction = (mdl_contraction){0};
  s->data.facing = b->facing;
  if (s->d->n_u) rt_inputs_at(s, s->t);
  return status;
}

/* To `end`, which a step that is not the session's yet has come to: v_reached there. The session is left where it is,
 * unless the branch ends: then it is there. */
rt_status rt_branch_reach(rt_session *s, double end) {
  double begin = s->t;
  rt_failure before = s->failure;
  mdl_failure told = s->data.failure;
  s->t = end;
  rt_status status = reach(s, end);
  if (s->branches.ended) return status;
  s->t = begin;
  s->failure = before;
  s->data.failure = told;
  return status;
}

/* Where the branch has been followed to the session's point, its solution as what nonlinear blocks start from. */
bool rt_branch_take(rt_session *s) {
  rt_branches *b = &s->branches;
  if (!s->d->n_branches || b->reached != s->t) return false;
  for (int k = 0; k < s->d->n_branches; k++) {
    const mdl_computed *c = &s->d->branches[k];
    *kept(c, s->data.v, s->data.xdot) = *kept(c, b->v_reached, b->xdot_reached);
  }
  return true;
}

/* A row at t inside the last step; `found`: its values, from those of the row before. */
rt_status rt_branch_row(rt_session *s, double t, double *xdot, double *v, bool found) {
  if (!s->d->n_branches || s->branches.ended) return found ? RT_OK : rt_fail_model(s, t, "evaluating outputs");
  if (!found || is_doubtful(s)) {
    rt_status status = reach(s, t);
    if (status) return status;
    rt_inputs_at(s, t);
    copy(s, v, xdot, s->branches.v_reached, s->branches.xdot_reached);
    turn(s, s->branches.aside, s->branches.facing_reached);
  }
  set_out(s, t, v, xdot, s->branches.aside);
  return RT_OK;
}

/* Whether a block of the session's point has come to a root that faces another way than that of the branch: one that is
 * near, where the two meet. */
static bool faces_away(const rt_session *s) {
  const rt_branches *b = &s->branches;
  for (int k = 0; k < s->d->n_branches; k++) {
    int equation = s->d->branches[k].equation;
    if (b->orientation[equation] * b->facing_reached[equation] < 0) return true;
  }
  return false;
}

/* To the end of the last step, or to the event that cut it short. Where the step has found another solution there, the
 * run goes on from that of the branch. A multistep method solves the equations by itself: of how it came to their
 * solution nothing is known. */
rt_status rt_branch_follow(rt_session *s) {
  rt_branches *b = &s->branches;
  bool certain = !s->method->multistep && !is_doubtful(s);
  if (!s->d->n_branches || certain || !(s->t > b->t)) return RT_OK;
  rt_status status = b->reached == s->t ? RT_OK : reach(s, s->t);
  if (status) return status;
  copy(s, b->v_tried, b->xdot_tried, s->data.v, s->data.xdot);
  if (changed(s, -1) <= 1 && !faces_away(s)) return RT_OK;
  copy(s, s->data.v, s->data.xdot, b->v_reached, b->xdot_reached);
  turn(s, b->orientation, b->facing_reached);
  if (s->method->multistep) s->pending |= RT_PENDING_BRANCH;
  return RT_OK;
}
