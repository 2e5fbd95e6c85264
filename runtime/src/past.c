/* The past of what is delayed, looked into: values, and the instants at which they jump or bend. delay.c writes it. */
#include <math.h>

#include "past.h"

/* A polynomial through values at the nodes, at a fraction of their interval. */
double rt_along(const double *value, double theta) {
  double above = 0, below = 0;
  for (int i = 0; i < NODES; i++) {
    double off = theta - node[i];
    if (off == 0) return value[i];
    above += weight[i] / off * (value[i] - value[0]);
    below += weight[i] / off;
  }
  return value[0] + above / below;
}

/* The derivative of that polynomial, by Newton's form of it. */
double rt_slope_along(const double *value, double theta) {
  double c[NODES];
  for (int i = 0; i < NODES; i++)
    c[i] = value[i];
  for (int k = 1; k < NODES; k++)
    for (int i = NODES - 1; i >= k; i--)
      c[i] = (c[i] - c[i - 1]) / (node[i] - node[i - k]);
  double sum = c[NODES - 1], slope = 0;
  for (int k = NODES - 2; k >= 0; k--) {
    slope = slope * (theta - node[k]) + sum;
    sum = sum * (theta - node[k]) + c[k];
  }
  return slope;
}

static double inside(const rt_piece *p, double t) {
  return rt_along(p->value, rt_min(1, rt_max(0, (t - p->begin) / p->length)));
}

/* The piece that holds t, not beyond a jump. */
int rt_reached(rt_history *h, double t) {
  int k = h->near > h->cursor ? h->near : h->cursor;
  while (k > h->cursor && !(h->pieces[k].begin < t))
    k--;
  while (k + 1 < h->n && h->pieces[k + 1].begin < t && !h->pieces[k + 1].jump)
    k++;
  return h->near = k;
}

void rt_delays_at(rt_session *s, double t) {
  rt_delays *d = s->delays;
  for (int k = 0; d && k < d->n; k++) {
    rt_history *h = &d->past[k];
    int at = rt_reached(h, t - d->seconds[k]);
    s->data.u[s->d->delay_input[k]] = at < 0 ? h->before : inside(&h->pieces[at], t - d->seconds[k]);
  }
}

/* An event at t: what has been reached by then holds from now on. */
void rt_delays_pass(rt_session *s, double t) {
  rt_delays *d = s->delays;
  for (int k = 0; d && k < d->n; k++) {
    rt_history *h = &d->past[k];
    while (h->cursor + 1 < h->n && h->pieces[h->cursor + 1].begin + d->seconds[k] <= t + s->clock.tolerance)
      h->cursor++;
  }
}

/* What no step may pass: the end of what is known, and the next instant at which a delay jumps or bends. */
double rt_delays_limit(rt_session *s) {
  rt_delays *d = s->delays;
  double limit = INFINITY, now = s->t + s->clock.tolerance;
  for (int k = 0; d && k < d->n; k++) {
    rt_history *h = &d->past[k];
    const rt_piece *p = h->pieces;
    while (h->ahead < h->n && (p[h->ahead].begin + d->seconds[k] <= now || !(p[h->ahead].jump || p[h->ahead].kink)))
      h->ahead++;
    if (h->ahead < h->n) limit = rt_min(limit, p[h->ahead].begin + d->seconds[k]);
    limit = rt_min(limit, s->t + d->seconds[k]);
  }
  return limit;
}

int rt_delays_due(rt_session *s) {
  rt_delays *d = s->delays;
  int pending = 0;
  for (int k = 0; d && k < d->n; k++) {
    const rt_history *h = &d->past[k];
    for (int i = h->cursor + 1; i < h->n; i++) {
      double off = h->pieces[i].begin + d->seconds[k] - s->t;
      if (off > s->clock.tolerance) break;
      if (h->pieces[i].jump) pending |= RT_PENDING_JUMP;
      if (h->pieces[i].kink && s->method->multistep && off >= -s->clock.tolerance) pending |= RT_PENDING_KINK;
    }
  }
  return pending;
}
