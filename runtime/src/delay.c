/* delay(e, T) = e at T seconds ago: an input of the model whose samples the run writes itself.
 *
 * The past of e is kept in pieces (keep.c), one or more a step. No step is longer than the shortest T, so that it looks
 * into what is known. Where e jumped or bent, its delay does so T later: an event. As with recorded inputs, the end of
 * a step that lands on a jump sees the value before it. */
#include "past.h"

#include <stdlib.h>
#include <string.h>

bool rt_delays_create(rt_session *s) {
  int n = s->d->n_delay;
  if (!n) return true;
  rt_delays *d = s->delays = calloc(1, sizeof *d);
  if (!d) return false;
  d->n = n;
  d->past = calloc((size_t)n, sizeof *d->past);
  d->seconds = calloc((size_t)n * (4 + NODES), sizeof *d->seconds);
  if (!d->past || !d->seconds) return false;
  d->left = d->seconds + n;
  d->test = d->left + n;
  d->largest = d->test + n;
  d->at_node = d->largest + n;
  return true;
}

void rt_delays_free(rt_session *s) {
  rt_delays *d = s->delays;
  if (!d) return;
  for (int k = 0; d->past && k < d->n; k++)
    free(d->past[k].pieces);
  free(d->past);
  free(d->seconds);
  free(d);
}

rt_status rt_delays_begin(rt_session *s) {
  rt_delays *d = s->delays;
  if (!d) return RT_OK;
  if (s->sensitivities)
    return rt_fail(s, RT_ARGUMENT, s->start, -1, NULL, "sensitivities of a model with delay() are not computed");
  if (s->d->delay_times(&s->data, d->seconds)) return rt_fail_model(s, s->start, "computing delays");
  d->fresh = true;
  for (int k = 0; k < d->n; k++) {
    d->past[k].n = d->past[k].ahead = 0;
    d->past[k].cursor = d->past[k].near = -1;
    if (!(d->seconds[k] >= 16 * rt_time_resolution(s)) || d->seconds[k] < s->options.step)
      return rt_fail(s, RT_ARGUMENT, s->start, -1, s->d->equations + s->d->delay_equation[k],
                     "delay() number %d is by %.9g s, which is no time or less than a step", k + 1, d->seconds[k]);
  }
  return RT_OK;
}

enum { MANY = 4096 }; /* pieces behind the cursor that are worth the move */

static int values_at(rt_session *s, double t, const double *x, const double *xdot, const double *v, double *value) {
  return s->d->delays(&s->data, t, x, xdot, v, value);
}

/* Up to the start everything was as it is there. */
int rt_delays_start(rt_session *s) {
  rt_delays *d = s->delays;
  if (!d) return 0;
  int status = values_at(s, s->t, s->data.x, s->data.xdot, s->data.v, d->left);
  for (int k = 0; k < d->n; k++) {
    d->past[k].before = s->data.u[s->d->delay_input[k]] = d->left[k];
    d->past[k].size = fabs(d->left[k]);
  }
  return status;
}

/* Per second, at the first or the last point of a piece. */
static double slope(const rt_piece *p, int at) {
  double sum = 0;
  for (int i = 0; i < NODES; i++)
    if (i != at) sum += weight[i] / weight[at] / (node[at] - node[i]) * (p->value[i] - p->value[at]);
  return sum / p->length;
}

/* A step begins: what e is there, after any event. Pieces that no step looks into any more are forgotten. */
rt_status rt_delays_leave(rt_session *s) {
  rt_delays *d = s->delays;
  if (!d) return RT_OK;
  for (int k = 0; k < d->n; k++) {
    rt_history *h = &d->past[k];
    h->near = h->cursor;
    h->cursor = rt_reached(h, s->t - d->seconds[k]);
    if (h->cursor < MANY || h->cursor < h->n / 2) continue;
    h->n -= h->cursor;
    h->ahead = h->ahead > h->cursor ? h->ahead - h->cursor : 0;
    memmove(h->pieces, h->pieces + h->cursor, (size_t)h->n * sizeof *h->pieces);
    h->cursor = h->near = 0;
  }
  if (!values_at(s, s->t, s->data.x, s->data.xdot, s->data.v, d->left)) return RT_OK;
  return rt_fail_model(s, s->t, "keeping what is delayed");
}

/* Whether the newest piece jumps or bends against the one before, by more than the tolerance resolves. */
static void compare_ends(const rt_session *s, rt_history *h, bool fresh) {
  rt_piece *p = &h->pieces[h->n - 1];
  const rt_piece *last = h->n > 1 ? p - 1 : NULL;
  double visible = 1e-3 * s->options.rtol * h->size;
  p->jump = fabs(p->value[0] - (last ? last->value[NODES - 1] : h->before)) > visible;
  double turn = slope(p, 0) - (last ? slope(last, NODES - 1) : 0);
  double span = last ? rt_max(p->length, last->length) : p->length;
  p->kink = fresh && !p->jump && fabs(turn) * span > s->options.rtol * h->size;
}

bool rt_history_reserve(rt_history *h, int n) {
  if (n <= h->capacity) return true;
  int capacity = h->capacity > n / 2 ? 2 * h->capacity : n + 63;
  rt_piece *larger = realloc(h->pieces, (size_t)capacity * sizeof *larger);
  if (!larger) return false;
  h->pieces = larger;
  h->capacity = capacity;
  return true;
}

static bool append(rt_session *s, double begin, double length) {
  rt_delays *d = s->delays;
  for (int k = 0; k < d->n; k++) {
    rt_history *h = &d->past[k];
    if (!rt_history_reserve(h, h->n + 1)) return false;
    rt_piece *p = &h->pieces[h->n++];
    *p = (rt_piece){.begin = begin, .length = length};
    for (int i = 0; i < NODES; i++) {
      p->value[i] = d->at_node[i * d->n + k];
      h->size = rt_max(h->size, fabs(p->value[i]));
    }
    d->largest[k] = rt_max(d->largest[k], h->size);
    compare_ends(s, h, d->fresh);
  }
  d->fresh = false;
  return true;
}

/* The step from t_previous to t is done. */
rt_status rt_delays_follow(rt_session *s) {
  rt_delays *d = s->delays;
  if (!d || !(s->t > s->t_previous)) return RT_OK;
  memcpy(d->at_node, d->left, (size_t)d->n * sizeof *d->left);
  for (int k = 0; k < d->n; k++)
    d->largest[k] = rt_max(d->past[k].size, rt_least_share(s->options.rtol) * s->delay_nominal[k]);
  rt_kept kept = {s->d->delays, append, d->n, d->at_node, d->test, d->largest};
  return rt_keep_step(s, &kept, "keeping what is delayed");
}

void rt_delays_event(rt_session *s) {
  if (s->delays) s->delays->fresh = true;
}
