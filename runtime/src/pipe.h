/* What transport.c keeps and pipe.c looks into. */
#ifndef RT_PIPE_H
#define RT_PIPE_H

#include "past.h"

typedef struct {
  double lo, hi; /* labels that are in the pipe */
  double label[NODES], value[NODES];
  bool mark; /* at lo */
} rt_segment;

typedef struct {
  rt_segment *all; /* [capacity]; from `first` on there are n */
  int first, n, capacity;
  double left[2], right[2]; /* between which labels each end reads */
} rt_pipe;

rt_segment *rt_pipe_at(const rt_pipe *c, int k);
double rt_pipe_read(const rt_pipe *c, double end, double x, int order); /* at position x; 1: its derivative by x */
bool rt_pipe_grow(rt_pipe *c);
bool rt_pipe_marks(const rt_session *s, const rt_segment *below, const rt_segment *above, bool fresh);
int rt_pipe_fill(rt_session *s, rt_pipe *c, int points, const double *point, double x);
void rt_pipe_cut(rt_pipe *c, double lo, double hi);

#endif
