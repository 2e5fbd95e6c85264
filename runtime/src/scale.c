/* Sizes of unknowns and guards: what absolute tolerances and the hysteresis of events are measured in, so that a model
 * behaves the same in any units.
 *
 * The model tells nominal values for the parameters of the run (codegen/structure/nominal.py has the rule); an unknown
 * is no smaller than at its start, and one that nothing is known of has size 1. The absolute tolerance of an unknown
 * follows the largest size that it has had, no further than its nominal value, which is followed itself where the
 * model only tells a least one, and from a floor up that rounding does not reach. */
#include <math.h>
#include <string.h>

#include "swings.h"

static const double lowest = 1e-3; /* of the nominal value: where a tolerance by the largest size begins */

static const double several = 8; /* of the smallest steps: a method begins with a few of about one length */
enum { deep = 8 };               /* states that move one another from rest, each by the one before */

static double sized(double nominal, double start) {
  double size = nominal > 0 && isfinite(nominal) ? nominal : 0;
  if (isfinite(start)) size = rt_max(size, fabs(start));
  return size > 0 ? size : 1;
}

/* Sizes that follow from the parameters; those of guards and of what is delayed are complete, 0 where the model does
 * not tell. */
rt_status rt_scale_parameters(rt_session *s) {
  const mdl_descriptor *d = s->d;
  size_t n = (size_t)(d->n_x + d->n_z + d->n_rel + d->n_delay);
  memset(s->nominal, 0, n * sizeof *s->nominal);
  if (d->nominals && d->nominals(&s->data, s->nominal)) return rt_fail_model(s, s->start, "computing nominal values");
  for (int i = 0; i < d->n_variables; i++) { /* hand-written models declare theirs in the table alone */
    const mdl_variable *v = &d->variables[i];
    if (!d->nominals && v->storage == MDL_STATE && v->nominal > 0) s->nominal[v->index] = v->nominal;
  }
  for (int r = 0; r < d->n_rel + d->n_delay; r++)
    if (!(s->g_nominal[r] > 0) || !isfinite(s->g_nominal[r])) s->g_nominal[r] = 0;
  for (int i = 0; i < d->n_x; i++)
    s->modest[i] = d->least_sizes && d->least_sizes[i] && s->nominal[i] > 0;
  for (int i = 0; i < d->n_x + d->n_z; i++) /* until the start is known */
    s->atol[i] = s->options.atol * sized(s->nominal[i], 0);
  return RT_OK;
}

/* The share of a nominal value up from which sizes count, where what is asked for is so much of them. */
double rt_least_share(double tolerance) {
  return rt_min(1, rt_max(lowest, RT_ROUNDING / tolerance));
}

static void set_tolerances(rt_session *s) {
  s->growing = false;
  for (int i = 0; i < s->d->n_x; i++) {
    if (s->modest[i] > 0) s->nominal[i] = rt_max(s->nominal[i], s->range[i]);
    bool grows = s->range[i] < s->nominal[i] || s->modest[i] > 0;
    s->outgrown[i] = grows ? 2 * s->range[i] : INFINITY;
    s->growing |= grows;
  }
  double relative = s->options.atol, least = s->atol_given ? 1 : rt_least_share(relative);
  for (int i = 0; i < s->d->n_x + s->d->n_z; i++)
    s->atol[i] = relative * rt_min(s->nominal[i], rt_max(s->range[i], least * s->nominal[i]));
}

/* States as they are a short way from the start on, by Euler's steps of that length from one slope to the next: what is
 * moved by what moves follows in the next. Whether one has moved that had not. */
static bool move_on(rt_session *s, double way) {
  bool more = false;
  for (int i = 0; i < s->d->n_x; i++)
    s->x_trial[i] = s->data.x[i] + way * s->xdot_trial[i];
  if (rt_rhs(s, s->t + way, s->x_trial, s->xdot_trial, s->v_trial)) return false;
  for (int i = 0; i < s->d->n_x; i++) {
    double reached = way * fabs(s->xdot_trial[i]);
    if (!isfinite(reached)) return false;
    more |= reached > 0 && s->range[i] == 0;
    s->range[i] = rt_max(s->range[i], reached);
  }
  return more;
}

/* A step errs by no more than its tolerance where that is small beside the size of a state by the square of what the
 * step is beside the time in which the state comes to it. Steps that time resolves can do that for sizes that are
 * reached in so many of them, and for no smaller ones. */
static void begin_where_time_resolves(rt_session *s) {
  const double way = several * rt_smallest_step(s) / sqrt(s->options.atol);
  mdl_failure told = s->data.failure;
  int undetermined = s->data.undetermined, unsettled = s->data.unsettled;
  memcpy(s->v_trial, s->data.v, (size_t)s->d->n_v * sizeof *s->v_trial);
  memcpy(s->xdot_trial, s->data.xdot, (size_t)s->d->n_x * sizeof *s->xdot_trial);
  for (int k = 0, more = 1; more && k < deep; k++)
    more = move_on(s, way);
  s->data.failure = told;
  s->data.undetermined = undetermined, s->data.unsettled = unsettled;
  if (s->d->n_u) rt_inputs_at(s, s->t);
}

/* Whether some state may come to be larger than it is at the start, as far as its tolerance goes. */
static bool is_open(const rt_session *s) {
  for (int i = 0; i < s->d->n_x; i++)
    if (s->range[i] < s->nominal[i] || s->modest[i] > 0) return true;
  return false;
}

/* At the start: sizes of what the model tells nothing of, and the first tolerances. */
void rt_scale_start(rt_session *s) {
  const mdl_descriptor *d = s->d;
  for (int i = 0; i < d->n_x + d->n_z; i++) {
    double start = i < d->n_x ? s->data.x[i] : s->data.v[d->z_index[i - d->n_x]];
    s->nominal[i] = sized(s->nominal[i], start);
    s->range[i] = i < d->n_x ? fabs(start) : s->nominal[i];
  }
  if (is_open(s) && !s->atol_given) begin_where_time_resolves(s);
  set_tolerances(s);
}

/* Whether a state has outgrown what is known of its size. */
static bool has_outgrown(const rt_session *s) {
  for (int i = 0; i < s->d->n_x; i++)
    if (fabs(s->data.x[i]) > s->outgrown[i]) return true;
  return false;
}

/* After a step: sizes that are still followed. */
void rt_scale_grow(rt_session *s) {
  if (!has_outgrown(s)) return;
  for (int i = 0; i < s->d->n_x; i++)
    s->range[i] = rt_max(s->range[i], fabs(s->data.x[i]));
  set_tolerances(s);
}
