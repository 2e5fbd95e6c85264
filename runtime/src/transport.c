/* spatialDistribution(in0, in1, x, ...): a quantity that moves with x along a pipe of length 1, whose ends are 0 and 1.
 *
 * What lies at y when x is the position has the label y - x, which it keeps while it moves. The contents are segments
 * by rising label, one or more a step and one between initial points: label and value are polynomials of the time
 * (keep.c), which is as exact where the velocity passes zero as elsewhere. Steps that go forward add segments at the
 * left end, steps backward at the right end; what leaves is cut.
 *
 * A mark is a label at which the contents jump or bend. An end reads between two marks only; the inputs of the model
 * say at which positions x the next ones are reached, and the model has a relation for each: an event, which moves on.
 * No step reads what it writes itself: the label written last counts as a mark. */
#include "transport.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "pipe.h"

enum { IN0, IN1, AT, FORWARD, VALUES };
static const double reached = 1e-9; /* of the pipe's length: a mark as near as that has been reached */

struct rt_transports {
  int n;
  bool fresh; /* an event lies between the last segment and the next */
  rt_pipe *pipe;
  double *point;                 /* initial points and values */
  double *now, *scale, *at_node; /* [VALUES n], [VALUES n], [VALUES n NODES] */
};

static double carried(const mdl_data *m, int k, double end, double x, int order) {
  return rt_pipe_read(&((const struct rt_transports *)m->transports)->pipe[k], end, x, order);
}

bool rt_transports_create(rt_session *s) {
  int n = s->d->n_transport;
  if (n <= 0) return true;
  struct rt_transports *t = s->transports = calloc(1, sizeof *t);
  if (!t) return false;
  t->n = n;
  t->pipe = calloc((size_t)n, sizeof *t->pipe);
  t->now = calloc((size_t)n * VALUES * (2 + NODES), sizeof *t->now);
  t->scale = t->now + (size_t)n * VALUES;
  t->at_node = t->scale + (size_t)n * VALUES;
  size_t points = 0;
  for (int k = 0; k < n; k++)
    points += 2 * (size_t)s->d->transport_points[k];
  t->point = calloc(points, sizeof *t->point);
  s->data.transports = t;
  s->data.carried = carried;
  return t->pipe && t->now && t->point;
}

void rt_transports_free(rt_session *s) {
  struct rt_transports *t = s->transports;
  if (!t) return;
  for (int k = 0; t->pipe && k < t->n; k++)
    free(t->pipe[k].all);
  free(t->pipe);
  free(t->now);
  free(t->point);
  free(t);
}

/* What goes in at the present point, and where. */
static int look_in(rt_session *s) {
  mdl_data *m = &s->data;
  return s->d->transports(m, s->t, m->x, m->xdot, m->v, s->transports->now);
}

static bool is_distribution(int points, const double *point) {
  for (int i = 0; i + 1 < points; i++)
    if (!(point[i] <= point[i + 1])) return false;
  return points > 1 && fabs(point[0]) <= reached && fabs(point[points - 1] - 1) <= reached;
}

/* Between which marks the ends read from x on, and at which positions they reach the next. A mark that an end has just
 * reached is passed by an event only. */
static void look_around(rt_session *s, int k, double x, bool event) {
  rt_pipe *c = &s->transports->pipe[k];
  double near = reached + 16 * DBL_EPSILON * fabs(x), left = -x, right = 1 - x;
  double passed_left = c->left[0], passed_right = c->right[1];
  rt_pipe_cut(c, left, right);
  c->left[0] = c->right[0] = rt_pipe_at(c, 0)->lo;
  c->left[1] = c->right[1] = rt_pipe_at(c, c->n - 1)->hi;
  for (int i = 1; i < c->n; i++) {
    double label = rt_pipe_at(c, i)->lo;
    if (!rt_pipe_at(c, i)->mark) continue;
    bool behind = label < left - near || (label <= left + near && (event || label <= passed_left));
    if (behind)
      c->left[0] = label;
    else
      c->left[1] = rt_min(c->left[1], label);
    behind = label > right + near || (label >= right - near && (event || label >= passed_right));
    if (behind)
      c->right[1] = rt_min(c->right[1], label);
    else
      c->right[0] = label;
  }
  const int *input = s->d->transport_input + 2 * k;
  s->data.u[input[0]] = event ? rt_max(1 - c->right[0], x + near) : 1 - c->right[0];
  s->data.u[input[1]] = event ? rt_min(-c->left[1], x - near) : -c->left[1];
}

static int pass(rt_session *s, bool event) {
  struct rt_transports *t = s->transports;
  if (!t || !t->pipe[0].n) return 0;
  int status = look_in(s);
  for (int k = 0; !status && k < t->n; k++)
    look_around(s, k, t->now[VALUES * k + AT], event);
  return status;
}

rt_status rt_transports_leave(rt_session *s, bool event) {
  return pass(s, event) ? rt_fail_model(s, s->t, "keeping what is transported") : RT_OK;
}

/* Where the points of each transport begin, their values after them. */
static double *points_of(const rt_session *s, int k) {
  double *point = s->transports->point;
  for (int i = 0; i < k; i++)
    point += 2 * s->d->transport_points[i];
  return point;
}

rt_status rt_transports_begin(rt_session *s) {
  struct rt_transports *t = s->transports;
  if (!t) return RT_OK;
  if (s->sensitivities)
    return rt_fail(s, RT_ARGUMENT, s->start, -1, NULL, "sensitivities of spatialDistribution() are not computed");
  if (s->d->transport_initial(&s->data, t->point)) return rt_fail_model(s, s->start, "computing what is transported");
  t->fresh = true;
  for (int i = 0; i < t->n * VALUES; i++) /* positions count in lengths of the pipe; which way it moves is no number */
    t->scale[i] = i % VALUES == AT ? 1 : i % VALUES == FORWARD ? INFINITY : 0;
  for (int k = 0; k < t->n; k++) {
    t->pipe[k].n = 0;
    if (!is_distribution(s->d->transport_points[k], points_of(s, k)))
      return rt_fail(s, RT_ARGUMENT, s->start, -1, NULL,
                     "initialPoints of spatialDistribution() number %d do not rise from 0 to 1", k + 1);
  }
  return RT_OK;
}

int rt_transports_start(rt_session *s) {
  struct rt_transports *t = s->transports;
  if (!t) return 0;
  int status = look_in(s);
  for (int k = 0; !status && k < t->n; k++)
    status = rt_pipe_fill(s, &t->pipe[k], s->d->transport_points[k], points_of(s, k), t->now[VALUES * k + AT]);
  return status ? status : pass(s, true);
}

/* What a piece of a step adds at one end. */
static bool add(rt_session *s, int k) {
  const struct rt_transports *t = s->transports;
  rt_pipe *c = &t->pipe[k];
  const double *first = t->at_node + VALUES * k, *last = first + (size_t)VALUES * t->n * (NODES - 1);
  bool forward = last[FORWARD] != 0;
  double moved = last[AT] - first[AT];
  if (forward ? !(moved > 0 && -last[AT] < rt_pipe_at(c, 0)->lo)
              : !(moved < 0 && 1 - last[AT] > rt_pipe_at(c, c->n - 1)->hi))
    return true;
  rt_segment g = {.lo = forward ? -last[AT] : rt_pipe_at(c, c->n - 1)->hi,
                  .hi = forward ? rt_pipe_at(c, 0)->lo : 1 - last[AT]};
  for (int i = 0; i < NODES; i++) {
    const double *from = t->at_node + VALUES * ((size_t)t->n * (size_t)(forward ? NODES - 1 - i : i) + (size_t)k);
    g.label[i] = (forward ? 0 : 1) - from[AT];
    g.value[i] = from[forward ? IN0 : IN1];
  }
  if (!rt_pipe_grow(c)) return false;
  if (forward) {
    rt_pipe_at(c, 0)->mark = rt_pipe_marks(s, &g, rt_pipe_at(c, 0), t->fresh);
    c->all[--c->first] = g;
  } else {
    g.mark = rt_pipe_marks(s, rt_pipe_at(c, c->n - 1), &g, t->fresh);
    c->all[c->first + c->n] = g;
  }
  c->n++;
  return true;
}

static bool add_all(rt_session *s, double begin, double length) {
  (void)begin, (void)length; /* labels say where a piece is */
  struct rt_transports *t = s->transports;
  for (int k = 0; k < t->n; k++)
    if (!add(s, k)) return false;
  t->fresh = false;
  for (int i = 0; i < t->n * VALUES * NODES; i++) {
    double *largest = &t->scale[i % (t->n * VALUES)];
    if (i % VALUES == IN0 || i % VALUES == IN1) *largest = rt_max(*largest, fabs(t->at_node[i]));
  }
  return true;
}

/* The step from t_previous to t is done. */
rt_status rt_transports_follow(rt_session *s) {
  struct rt_transports *t = s->transports;
  if (!t || !(s->t > s->t_previous)) return RT_OK;
  memcpy(t->at_node, t->now, (size_t)t->n * VALUES * sizeof *t->now);
  rt_kept kept = {s->d->transports, add_all, VALUES * t->n, t->at_node, t->now, t->scale};
  return rt_keep_step(s, &kept, "keeping what is transported");
}

void rt_transports_event(rt_session *s) {
  if (s->transports) s->transports->fresh = true;
}
