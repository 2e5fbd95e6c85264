/* What is in a pipe that carries a quantity: segments by rising label, read at both ends. transport.c fills it. */
#include "pipe.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

rt_segment *rt_pipe_at(const rt_pipe *c, int k) {
  return &c->all[c->first + k];
}

/* The fraction at which a segment has a label: regula falsi (Illinois). Where two looks have not halved the interval
 * the third is at its middle, so that it is as short as rounding after 3 * 52 of them at most. */
static double fraction(const rt_segment *g, double label) {
  double a = 0, b = 1, fa = g->label[0] - label, fb = g->label[NODES - 1] - label, length = 1;
  if (!(fa < 0)) return 0;
  if (!(fb > 0)) return 1;
  for (int i = 1, side = 0; b - a > DBL_EPSILON; i++) {
    bool creeps = i % 3 == 0 && b - a > 0.5 * length;
    double t = creeps ? 0.5 * (a + b) : a + (b - a) * fa / (fa - fb);
    t = rt_min(rt_max(t, a + 0.25 * DBL_EPSILON), b - 0.25 * DBL_EPSILON); /* both ends move in */
    double f = rt_along(g->label, t) - label;
    if (f == 0) return t;
    double *end = f < 0 ? &a : &b, *value = f < 0 ? &fa : &fb, *other = f < 0 ? &fb : &fa;
    int moved = f < 0 ? -1 : 1;
    *end = t;
    *value = f;
    if (side == moved) *other *= 0.5;
    side = moved;
    if (i % 3 == 0) length = b - a;
  }
  return 0.5 * (a + b);
}

/* The segment that an end reads at a label between two marks. */
static const rt_segment *segment_at(const rt_pipe *c, bool right, double label, const double *between) {
  if (right) {
    int k = c->n - 1;
    while (k > 0 && (rt_pipe_at(c, k)->lo >= between[1] || rt_pipe_at(c, k)->lo > label) &&
           rt_pipe_at(c, k)->lo > between[0])
      k--;
    return rt_pipe_at(c, k);
  }
  int k = 0;
  while (k + 1 < c->n && (rt_pipe_at(c, k)->hi <= between[0] || rt_pipe_at(c, k)->hi < label) &&
         rt_pipe_at(c, k)->hi < between[1])
    k++;
  return rt_pipe_at(c, k);
}

double rt_pipe_read(const rt_pipe *c, double end, double x, int order) {
  if (!isfinite(x)) return NAN;
  if (!c->n) return 0;
  bool right = end > 0;
  const double *between = right ? c->right : c->left;
  double label = rt_min(rt_max(end - x, between[0]), between[1]);
  const rt_segment *g = segment_at(c, right, label, between);
  double theta = fraction(g, label);
  if (!order) return rt_along(g->value, theta);
  double run = rt_slope_along(g->label, theta);
  return run > 0 ? -rt_slope_along(g->value, theta) / run : 0; /* none where it turns round: nothing moves there */
}

/* Room for one more at either end. */
bool rt_pipe_grow(rt_pipe *c) {
  if (c->first > 0 && c->first + c->n < c->capacity) return true;
  int capacity = 2 * (c->n + 32), first = (capacity - c->n) / 2;
  rt_segment *larger = malloc((size_t)capacity * sizeof *larger);
  if (!larger) return false;
  if (c->n) memcpy(larger + first, c->all + c->first, (size_t)c->n * sizeof *larger);
  free(c->all);
  *c = (rt_pipe){larger, first, c->n, capacity, {c->left[0], c->left[1]}, {c->right[0], c->right[1]}};
  return true;
}

static double slope(const rt_segment *g, int from, int to) {
  double run = g->label[to] - g->label[from];
  return run > 0 ? (g->value[to] - g->value[from]) / run : INFINITY;
}

/* Whether the contents jump or bend where a segment follows another, by more than the tolerance resolves. */
bool rt_pipe_marks(const rt_session *s, const rt_segment *below, const rt_segment *above, bool fresh) {
  double theta_below = fraction(below, above->lo), theta_above = fraction(above, above->lo), size = 0;
  double a = rt_along(below->value, theta_below), b = rt_along(above->value, theta_above);
  for (int i = 0; i < NODES; i++)
    size = rt_max(size, rt_max(fabs(below->value[i]), fabs(above->value[i])));
  if (fabs(b - a) > 1e-3 * s->options.rtol * size) return true;
  double turn = slope(above, 0, 1) - slope(below, NODES - 2, NODES - 1);
  double span = rt_max(above->hi - above->lo, below->hi - below->lo);
  return fresh && !(fabs(turn) * span <= s->options.rtol * size);
}

/* The initial distribution: straight lines between its points. */
int rt_pipe_fill(rt_session *s, rt_pipe *c, int points, const double *point, double x) {
  const double *value = point + points;
  c->n = 0;
  if (!rt_pipe_grow(c)) return -1;
  for (int i = 0; i + 1 < points; i++) {
    if (!(point[i + 1] > point[i])) continue;
    rt_segment g = {.lo = point[i] - x, .hi = point[i + 1] - x};
    for (int j = 0; j < NODES; j++) {
      g.label[j] = g.lo + node[j] * (g.hi - g.lo);
      g.value[j] = value[i] + node[j] * (value[i + 1] - value[i]);
    }
    g.mark = c->n && rt_pipe_marks(s, rt_pipe_at(c, c->n - 1), &g, true);
    if (!rt_pipe_grow(c)) return -1;
    c->all[c->first + c->n++] = g;
  }
  return 0;
}

/* What is in the pipe no more. It is cut when the next step begins: until then the last one is looked into. */
void rt_pipe_cut(rt_pipe *c, double lo, double hi) {
  while (c->n > 1 && rt_pipe_at(c, 0)->hi <= lo)
    c->first++, c->n--;
  while (c->n > 1 && rt_pipe_at(c, c->n - 1)->lo >= hi)
    c->n--;
  rt_pipe_at(c, 0)->lo = rt_max(rt_pipe_at(c, 0)->lo, lo);
  rt_pipe_at(c, c->n - 1)->hi = rt_min(rt_pipe_at(c, c->n - 1)->hi, hi);
}
