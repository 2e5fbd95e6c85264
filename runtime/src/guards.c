/* The guards of relations: inside the last step, and how far each is from switching. */
#include "session.h"

int rt_guards_at(rt_session *s, double t, double *g) {
  rt_dense_eval(&s->dense, s->d->n_x, t, s->x_trial);
  int status = rt_rhs(s, t, s->x_trial, s->xdot_trial, s->v_trial);
  s->result->counters.root_evaluations++;
  return status ? status : s->d->roots(&s->data, t, s->x_trial, s->xdot_trial, s->v_trial, g);
}

/* Positive while relation r keeps its value, whose guard g_previous has just been the start of a step. */
double rt_margin(const rt_session *s, int r, double g) {
  bool holds = s->data.rel[r];
  double at_start = holds ? s->g_previous[r] : -s->g_previous[r];
  return (holds ? g : -g) + (at_start > 0 ? 0 : rt_hysteresis(s, r));
}
