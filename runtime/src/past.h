/* What delay.c keeps and past.c looks into. */
#ifndef RT_PAST_H
#define RT_PAST_H

#include "delay.h"

enum { NODES = 5 };
static const double node[NODES] = {0, 0.14644660940672624, 0.5, 0.85355339059327376, 1};
static const double weight[NODES] = {0.5, -1, 1, -1, 0.5};

typedef struct {
  double begin, length; /* s */
  double value[NODES];
  bool jump, kink; /* against the piece before */
} rt_piece;

/* `cursor` is the piece that is looked into from the start of the present step on, -1 before the start of the run;
 * `near` the one that was looked into last, where that is not before; nothing before piece `ahead` that jumps or bends
 * is still to come. */
typedef struct {
  rt_piece *pieces;
  int n, capacity, cursor, near, ahead;
  double before, size; /* value up to the start; largest one so far */
} rt_history;

struct rt_delays {
  int n;
  bool fresh; /* an event lies between the last piece and the next */
  rt_history *past;
  double *seconds, *left, *test, *largest, *at_node; /* [n], and [n * NODES] */
};

typedef int (*rt_point_values)(mdl_data *m, double t, const double *x, const double *xdot, const double *v,
                               double *value);

/* What is kept of a step: `values` [count] at the nodes of one piece after another, which `take` gets in `at_node`
 * [NODES count]. `scale` [count] are the sizes that the tolerance is relative to, or more where a piece has more. */
typedef struct {
  rt_point_values values;
  bool (*take)(rt_session *s, double begin, double length);
  int count;
  double *at_node, *test;
  const double *scale;
} rt_kept;

rt_status rt_keep_step(rt_session *s, const rt_kept *kept, const char *doing);
double rt_along(const double *value, double theta);
double rt_slope_along(const double *value, double theta);
bool rt_history_reserve(rt_history *h, int n); /* room for n pieces */
int rt_reached(rt_history *h, double t);

#endif
