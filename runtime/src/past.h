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
 * nothing before piece `ahead` that jumps or bends is still to come. */
typedef struct {
  rt_piece *pieces;
  int n, capacity, cursor, ahead;
  double before, size; /* value up to the start; largest one so far */
} rt_history;

struct rt_delays {
  int n;
  bool fresh; /* an event lies between the last piece and the next */
  rt_history *past;
  double *seconds, *left, *right, *at_node; /* [n], and [n * NODES] */
};

typedef int (*rt_point_values)(mdl_data *m, double t, const double *x, const double *xdot, const double *v,
                               double *value);
int rt_at_nodes(rt_session *s, rt_point_values values, int count, double *at_node);
double rt_along(const double *value, double theta);
double rt_slope_along(const double *value, double theta);
bool rt_history_reserve(rt_history *h, int n); /* room for n pieces */
int rt_reached(const rt_history *h, double t);

#endif
