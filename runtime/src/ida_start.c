/* IDA's first steps after an event, by a Runge-Kutta method: C. W. Gear, Runge-Kutta starters for multistep methods,
 * ACM Trans. Math. Softw. 6 (1980) 263-279.
 *
 * A multistep method of order 1 takes some thirty steps until order and step size suit the tolerance, and what they err
 * by stays. Five steps of Dormand & Prince give the values that IDA needs for order 5, at the places where IDA itself
 * would look for them, as it doubles its first steps (h, h, 2 h, 4 h, 8 h). To the session they are one step, on the
 * polynomial through them. IDA takes them for its own when it goes on (newton.c), with order 5 and 16 h. */
#include <math.h>
#include <string.h>

#include "ida.h"
#include "onestep.h"
#include "swings.h"

enum { STEPS = RT_IDA_STARTS };
static const double part[STEPS] = {1. / 16, 1. / 16, 1. / 8, 1. / 4, 1. / 2}; /* of the length of the start */
/* What the last of these steps may err by, in tolerances, by its own estimate. IDA's step of order 5 that follows,
 * twice as long, errs by about (16 h)^6 x^(6) / 6; the estimate is 8e-4 (8 h)^5 x^(5) where equations are linear. For
 * the first to be a tenth of the tolerance with 16 h from 0.05 to 0.3 of the time in which x changes, the second is
 * 3e-4 to 5e-5. */
static const double accuracy = 1.5e-4;
static const double within = 5;      /* times that: the length is right to 40 % */
static const double most_growth = 4; /* of the length from start to start */
static const double least_cut = 0.1; /* of it, from try to try */

/* Of errors of the states, in tolerances. */
static double norm(const rt_session *s, const double *e) {
  double sum = 0;
  for (int i = 0; i < s->d->n_x; i++) {
    double weighted = e[i] / (s->atol[i] + s->options.rtol * fabs(s->data.x[i]));
    sum += weighted * weighted;
  }
  return sqrt(sum / s->d->n_x) / ((const rt_ida *)s->memory)->share;
}

/* The fastest state crosses its nominal value in 1 / this (s). */
static double fastest(const rt_session *s) {
  double rate = 0;
  for (int i = 0; i < s->d->n_x; i++)
    rate = rt_max(rate, fabs(s->data.xdot[i]) / s->nominal[i]);
  return rate;
}

/* A short explicit step gives x'' and z': short on the scale of the states, long on that of rounding. The first BDF
 * step, of order 1, errs by h^2/2 x'': the largest h within tolerance follows. */
double rt_ida_first_step(rt_session *s, double *zdot) {
  const mdl_descriptor *d = s->d;
  double speed = norm(s, s->data.xdot), span = s->stop - s->start;
  double rate = fastest(s), delta = fmin(1e-6 * span, rate > 0 ? 1e-6 / rate : INFINITY);
  memcpy(s->v_trial, s->data.v, (size_t)d->n_v * sizeof *s->v_trial);
  for (int i = 0; i < d->n_x; i++)
    s->x_trial[i] = s->data.x[i] + delta * s->data.xdot[i];
  if (rt_rhs(s, s->t + delta, s->x_trial, s->xdot_trial, s->v_trial))
    return fmin(1e-3 * span, speed > 0 ? 0.5 / speed : INFINITY);
  for (int k = 0; k < d->n_z; k++)
    zdot[k] = (s->v_trial[d->z_index[k]] - s->data.v[d->z_index[k]]) / delta;
  for (int i = 0; i < d->n_x; i++)
    s->xdot_trial[i] = (s->xdot_trial[i] - s->data.xdot[i]) / delta;
  double curvature = norm(s, s->xdot_trial);
  return fmin(1e-3 * span, curvature > 0 ? sqrt(0.03 / curvature) : INFINITY);
}

/* The state and the algebraic unknowns z at the end of one of the steps, for IDA. */
static void keep(const rt_session *s, rt_ida *m, int j, double t, const double *x) {
  const mdl_descriptor *d = s->d;
  double *point = m->starts + j * (d->n_x + d->n_z);
  memcpy(point, x, (size_t)d->n_x * sizeof *x);
  for (int k = 0; k < d->n_z; k++)
    point[d->n_x + k] = s->data.v[d->z_index[k]];
  m->start_t[j] = t;
  rt_ida_push(s, m, t, x);
}

/* The steps from the session's point over `length`; the largest of their estimated errors, in tolerances: infinite
 * where one cannot be taken. x, x' at their end are in the starter's x1, f1. */
static double walk(rt_session *s, rt_ida *m, double length) {
  rt_onestep *o = m->starter;
  size_t size = (size_t)s->d->n_x * sizeof *o->x0;
  double largest = 0;
  memcpy(o->x0, s->data.x, size);
  memcpy(o->f0, s->data.xdot, size);
  o->t0 = s->t;
  for (int j = 0; j < STEPS; j++) {
    double h = part[j] * length;
    if (j) {
      memcpy(o->x0, o->x1, size);
      memcpy(o->f0, o->f1, size);
    }
    if (o->scheme->attempt(s, o, h) || rt_check_finite(s, o->f1)) return INFINITY;
    double error = norm(s, o->error);
    if (!(error <= within * accuracy)) return isnan(error) ? INFINITY : error;
    largest = rt_max(largest, error);
    o->t0 += h;
    keep(s, m, j, o->t0, o->x1);
  }
  return largest;
}

/* Whether the steps to `end` have left the branch of a nonlinear block, or would end the run with it: shorter ones
 * tell. */
static bool strays(rt_session *s, const rt_ida *m, double end) {
  mdl_contraction seen = s->data.contraction;
  if (!s->d->n_branches || (seen.ratio <= MDL_CONTRACTS && !seen.turned)) return false;
  s->dense.valid = false;
  bool strays = rt_branch_strays(s, end, m->starter->x1, m->starter->f1, seen.turned, NULL);
  s->data.contraction = seen;
  return strays;
}

/* The same, infinite too where the guards want a shorter way (swings.c), or the branch of a nonlinear block does. */
static double attempt(rt_session *s, rt_ida *m, double length) {
  double error = walk(s, m, length);
  if (!(error <= within * accuracy)) return error;
  if (strays(s, m, m->start_t[STEPS - 1])) return INFINITY;
  if (!s->d->guard_rates) return error;
  s->dense.valid = false;
  return rt_swing_error(s, m->start_t[STEPS - 1], m->starter->error) <= 1 ? error : INFINITY;
}

/* Nothing has been tried. */
static void go_back(rt_session *s, rt_ida *m) {
  memcpy(s->data.v, s->v_before, (size_t)s->d->n_v * sizeof *s->data.v);
  rt_branch_retreat(s);
  s->data.failure.kind = MDL_FAILURE_NONE;
  m->latest = m->first;
}

/* The length that the steps should have had. */
static double better(double length, double error) {
  return length * rt_min(most_growth, rt_max(least_cut, pow(accuracy / rt_max(error, DBL_MIN), 0.2)));
}

/* To the end of a start, at `limit` at most; false: it would be no longer than the first five steps of IDA. */
bool rt_ida_start(rt_session *s, rt_ida *m, double limit) {
  if (s->sensitivities || s->undetermined) return false;
  double left = limit - s->t, longest = s->options.max_step > 0 ? rt_min(left, s->options.max_step) : left, error;
  double own = rt_min(m->h_first / part[0], longest);
  double length = rt_min(rt_max(m->length, own), longest);
  m->first = m->latest;
  m->order = STEPS;
  memcpy(s->v_before, s->data.v, (size_t)s->d->n_v * sizeof *s->v_before);
  while (!((error = attempt(s, m, length)) <= within * accuracy)) {
    go_back(s, m);
    length = better(length, error);
    if (!(length >= own && own > 0)) return false;
  }
  const rt_onestep *o = m->starter;
  m->length = length < longest ? better(length, error) : rt_max(m->length, better(length, error));
  s->t = length < left ? m->start_t[STEPS - 1] : limit;
  memcpy(s->data.x, o->x1, (size_t)s->d->n_x * sizeof *o->x1);
  memcpy(s->data.xdot, o->f1, (size_t)s->d->n_x * sizeof *o->f1);
  m->known = 0;
  m->h_first = part[0] * length;
  s->result->counters.steps += STEPS;
  return true;
}

/* IDA takes the steps of the start, as far as it has not. */
int rt_ida_follow_start(rt_ida *m, double limit) {
  sunrealtype t;
  int flag = 0;
  if (m->known == 0 && IDASetInitStep(m->ida, m->h_first)) return IDA_ILL_INPUT;
  while (flag >= 0 && m->known < STEPS)
    flag = IDASolve(m->ida, limit, &t, m->y, m->yp, IDA_ONE_STEP);
  IDAGetNumSteps(m->ida, &m->taken);
  return flag;
}

/* The polynomial of the starter's step over h: of degree 4, through as many points in it. */
static void keep_over(rt_session *s, rt_ida *m, rt_onestep *o, double h) {
  o->h = h;
  rt_onestep_dense(s, o, &s->dense);
  s->dense.valid = false;
  m->latest = m->first;
  m->order = s->dense.degree;
  for (int j = 1; j < m->order; j++) {
    double t = o->t0 + j * h / m->order;
    rt_dense_eval(&s->dense, s->d->n_x, t, s->x_trial);
    rt_ida_push(s, m, t, s->x_trial);
  }
  rt_ida_push(s, m, o->t0 + h, o->x1);
}

/* One step of Dormand & Prince from the session's point; its error in tolerances, as the states and the guards have
 * it, negative where it cannot be taken. */
static double try_over(rt_session *s, rt_ida *m, double h) {
  rt_onestep *o = m->starter;
  memcpy(s->data.v, s->v_before, (size_t)s->d->n_v * sizeof *s->data.v);
  memcpy(o->x0, s->data.x, (size_t)s->d->n_x * sizeof *o->x0);
  memcpy(o->f0, s->data.xdot, (size_t)s->d->n_x * sizeof *o->f0);
  o->t0 = s->t;
  if (o->scheme->attempt(s, o, h) || rt_check_finite(s, o->f1)) return -1;
  double error = norm(s, o->error);
  if (!(error <= 1)) return isnan(error) ? -1 : error;
  keep_over(s, m, o, h);
  return s->d->guard_rates ? rt_max(error, rt_swing_error(s, s->t + h, o->error)) : error;
}

/* Where IDA does not get on: at a corner of nonlinear equations their branch ends (the trigger of Schmitt), and
 * Newton's method, from what IDA predicts, never comes across; where flows by a root come to rest or turn, unknowns
 * have infinite slopes. The solver of the blocks finds what is behind. Steps by Dormand & Prince, twice as long each,
 * from the length `h` on, until one errs by more than the tolerance or leaves the branch: the longest that does not is
 * the session's. Where each leaves it, it is the shortest that can be taken. False: there is none. */
bool rt_ida_step_over(rt_session *s, rt_ida *m, double h, double limit) {
  if (!s->d->n_branches || s->sensitivities || s->undetermined) return false;
  double taken = 0, tried = 0;
  bool goes_on = true;
  if (s->options.max_step > 0) limit = rt_min(limit, s->t + s->options.max_step);
  memcpy(s->v_before, s->data.v, (size_t)s->d->n_v * sizeof *s->v_before);
  m->first = m->latest;
  for (h = rt_max(h, rt_smallest_step(s)); s->t + h < limit && goes_on; h *= 2) {
    double error = try_over(s, m, tried = h);
    if (error < 0) continue;
    goes_on = error <= 1 && !strays(s, m, s->t + h);
    if (error <= 1 && (goes_on || !(taken > 0))) taken = h;
  }
  if (!(taken > 0) || (tried != taken && !(fabs(try_over(s, m, taken)) <= 1))) {
    memcpy(s->data.v, s->v_before, (size_t)s->d->n_v * sizeof *s->data.v);
    return false;
  }
  const rt_onestep *o = m->starter;
  s->data.failure.kind = MDL_FAILURE_NONE;
  s->t += taken;
  memcpy(s->data.x, o->x1, (size_t)s->d->n_x * sizeof *o->x1);
  memcpy(s->data.xdot, o->f1, (size_t)s->d->n_x * sizeof *o->f1);
  s->pending |= RT_PENDING_BRANCH;
  s->result->counters.steps++;
  return true;
}
