/* What delay() and spatialDistribution() keep of a step: pieces, each a polynomial through the values at its
 * Chebyshev-Lobatto points (J.-P. Berrut, L. N. Trefethen, Barycentric Lagrange interpolation, SIAM Review 46 (2004)
 * 501-517).
 *
 * The method chose the step for the states. What varies with the time itself may turn many times in it: a piece is as
 * short as it takes for the polynomial to be right between its points as well, to the tolerance. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "past.h"

static const double between[] = {0.30865828381745508, 0.69134171618254492}; /* nodes, in the middle of their angles */
enum { CHECKS = sizeof between / sizeof *between, MOST = 1 << 20 };         /* pieces a step: 80 MB of a delay */

/* At t in the last step. */
static int at_point(rt_session *s, const rt_kept *kept, double t, double *value) {
  if (!(t < s->t)) {
    memcpy(s->v_trial, s->data.v, (size_t)s->d->n_v * sizeof *s->v_trial);
    return kept->values(&s->data, s->t, s->data.x, s->data.xdot, s->data.v, value);
  }
  rt_dense_point(s, t, s->x_trial);
  int status = rt_rhs(s, t, s->x_trial, s->xdot_trial, s->v_trial);
  return status ? status : kept->values(&s->data, t, s->x_trial, s->xdot_trial, s->v_trial, value);
}

/* Values at the nodes of a piece from its second on. */
static int at_nodes(rt_session *s, const rt_kept *kept, double begin, double end) {
  for (int i = NODES - 1; i > 0; i--) {
    double t = i == NODES - 1 ? end : begin + node[i] * (end - begin);
    int status = at_point(s, kept, t, kept->at_node + i * kept->count);
    if (status) return status;
  }
  return 0;
}

/* How far from the polynomial of value i a value may be: the tolerance, and what the rounding of the time is worth. */
static double visible(const rt_session *s, const rt_kept *kept, const double *value, int i, double length) {
  double size = kept->scale[i], run = 0;
  for (int n = 0; n < NODES; n++) {
    size = rt_max(size, fabs(value[n]));
    if (n) run = rt_max(run, fabs(value[n] - value[n - 1]) / (node[n] - node[n - 1]));
  }
  return rt_max(s->options.rtol, 64 * DBL_EPSILON) * size + 4 * rt_time_resolution(s) * run / length;
}

static int resolved(rt_session *s, const rt_kept *kept, double begin, double length, bool *well) {
  *well = true;
  for (int j = 0; j < CHECKS && *well; j++) {
    int status = at_point(s, kept, begin + between[j] * length, kept->test);
    if (status) return status;
    for (int i = 0; i < kept->count && *well; i++) {
      double value[NODES];
      for (int n = 0; n < NODES; n++)
        value[n] = kept->at_node[n * kept->count + i];
      *well = !(fabs(rt_along(value, between[j]) - kept->test[i]) > visible(s, kept, value, i, length));
    }
  }
  return 0;
}

/* The step from t_previous to t in pieces. What is kept at its begin stands in the first row of at_node. A jump that
 * makes no event is in a piece as short as the clock resolves. */
rt_status rt_keep_step(rt_session *s, const rt_kept *kept, const char *doing) {
  double begin = s->t_previous, length = s->t - begin, shortest = 16 * rt_time_resolution(s);
  for (int pieces = 0; begin < s->t;) {
    double end = s->t - (begin + length) < shortest ? s->t : begin + length;
    bool well = false;
    if (at_nodes(s, kept, begin, end) || resolved(s, kept, begin, end - begin, &well))
      return rt_fail_model(s, s->t, doing);
    if (!well && end - begin > 2 * shortest) {
      length = 0.5 * (end - begin);
      continue;
    }
    if (++pieces > MOST)
      return rt_fail(s, RT_ARGUMENT, s->t, -1, NULL,
                     "%s: it varies too fast: %d pieces of a step of %.9g s do not show it", doing, MOST,
                     s->t - s->t_previous);
    if (!kept->take(s, begin, end - begin))
      return rt_fail(s, RT_MEMORY, s->t, -1, NULL, "out of memory while %s", doing);
    memcpy(kept->at_node, kept->at_node + (NODES - 1) * kept->count, (size_t)kept->count * sizeof *kept->at_node);
    begin = end;
    length *= 2;
  }
  rt_inputs_at(s, s->t);
  return RT_OK;
}
