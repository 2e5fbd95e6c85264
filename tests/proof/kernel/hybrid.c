#include "hybrid.h"

#include <math.h>
#include <string.h>

typedef struct {
  const bench *b;
  const double *p;
  const experiment *e;
  int mode[MAX_MODES];
  int interval; /* the sample interval that is being integrated: held inputs keep its first value */
  int lagged[MAX_OUTPUTS], lags;
} run;

static double at_sample(const experiment *e, int k, int channel) {
  if (k < 0) k = 0;
  if (k >= e->samples) k = e->samples - 1;
  return e->input[k * e->inputs + channel];
}

static void inputs_at(const run *r, double t, double *in) {
  const experiment *e = r->e;
  double position = (t - e->delay) / e->period;
  int k = e->delay > 0 ? (int)floor(position) : r->interval;
  for (int c = 0; c < e->inputs; c++) {
    double first = at_sample(e, k, c);
    in[c] = e->hold[c] ? first : first + (position - k) * (at_sample(e, k + 1, c) - first);
  }
}

static void derivative(const run *r, double t, const double *x, double *dx) {
  double in[MAX_INPUTS], y[MAX_OUTPUTS];
  inputs_at(r, t, in);
  r->b->derivative(r->p, r->mode, t, in, x, dx);
  if (!r->lags) return;
  r->b->output(r->p, r->mode, t, in, x, y);
  for (int j = 0; j < r->lags; j++) {
    int s = r->b->states + j, k = r->lagged[j];
    dx[s] = (y[k] - x[s]) / r->e->lag[k];
  }
}

static void rk4(const run *r, double t, double h, const double *x, double *next) {
  int n = r->b->states + r->lags;
  double k1[MAX_STATES], k2[MAX_STATES], k3[MAX_STATES], k4[MAX_STATES], s[MAX_STATES];
  derivative(r, t, x, k1);
  for (int j = 0; j < n; j++)
    s[j] = x[j] + h / 2 * k1[j];
  derivative(r, t + h / 2, s, k2);
  for (int j = 0; j < n; j++)
    s[j] = x[j] + h / 2 * k2[j];
  derivative(r, t + h / 2, s, k3);
  for (int j = 0; j < n; j++)
    s[j] = x[j] + h * k3[j];
  derivative(r, t + h, s, k4);
  for (int j = 0; j < n; j++)
    next[j] = x[j] + h / 6 * (k1[j] + 2 * k2[j] + 2 * k3[j] + k4[j]);
}

static int guards_fail(const run *r, double t, const double *x, double *g) {
  double in[MAX_INPUTS];
  inputs_at(r, t, in);
  for (int j = 0; j < r->b->guards; j++)
    g[j] = 1;
  r->b->guard(r->p, r->mode, t, in, x, g);
  for (int j = 0; j < r->b->guards; j++)
    if (g[j] < 0) return 1;
  return 0;
}

/* Changes modes until every guard holds; a cycle among modes is cut after a few rounds. */
static void settle(run *r, double t, double *x) {
  double g[MAX_GUARDS], in[MAX_INPUTS];
  for (int round = 0; round < 8 && guards_fail(r, t, x, g); round++) {
    inputs_at(r, t, in);
    r->b->change(r->p, g, t, in, x, r->mode);
  }
}

static void substep(run *r, double t, double h, double *x) {
  enum { EVENTS = 40, HALVINGS = 24 };
  double next[MAX_STATES], g[MAX_GUARDS], left = h;
  size_t bytes = sizeof(double) * (size_t)(r->b->states + r->lags);
  for (int event = 0; left > 0; event++) {
    rk4(r, t, left, x, next);
    if (event >= EVENTS || !guards_fail(r, t + left, next, g)) {
      memcpy(x, next, bytes);
      return;
    }
    double low = 0, high = left;
    for (int j = 0; j < HALVINGS; j++) {
      double middle = (low + high) / 2;
      rk4(r, t, middle, x, next);
      if (guards_fail(r, t + middle, next, g))
        high = middle;
      else
        low = middle;
    }
    rk4(r, t, high, x, next);
    memcpy(x, next, bytes);
    t += high;
    left -= high;
    settle(r, t, x);
  }
}

static void record(const run *r, double t, const double *x, double *y) {
  double in[MAX_INPUTS];
  inputs_at(r, t, in);
  r->b->output(r->p, r->mode, t, in, x, y);
  for (int j = 0; j < r->lags; j++)
    y[r->lagged[j]] = x[r->b->states + j];
}

int simulate(const bench *b, const double *p, const double *x0, const experiment *e, double *y) {
  run r = {.b = b, .p = p, .e = e};
  double x[MAX_STATES] = {0}, in[MAX_INPUTS], first[MAX_OUTPUTS];
  memcpy(x, x0, sizeof(double) * (size_t)b->states);
  inputs_at(&r, 0, in);
  b->start(p, in, x, r.mode);
  settle(&r, 0, x);
  b->output(p, r.mode, 0, in, x, first);
  for (int k = 0; k < b->outputs; k++)
    if (e->lag[k] > 0) {
      x[b->states + r.lags] = first[k];
      r.lagged[r.lags++] = k;
    }
  double h = e->period / e->substeps;
  record(&r, 0, x, y);
  for (int k = 0; k + 1 < e->samples; k++) {
    r.interval = k;
    settle(&r, k * e->period, x);
    for (int j = 0; j < e->substeps; j++)
      substep(&r, k * e->period + j * h, h, x);
    record(&r, (k + 1) * e->period, x, y + (k + 1) * b->outputs);
    if (!isfinite(x[0]) || !isfinite(x[1])) return 1;
  }
  return 0;
}
