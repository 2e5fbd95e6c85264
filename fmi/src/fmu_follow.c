/* Model exchange: which solution of nonlinear blocks belongs to where the importer has moved the instance. */
#include <string.h>

#include "fmu.h"

static void copy_values(const rt_session *s, double *v, double *xdot, const double *v_from, const double *xdot_from) {
  memcpy(v, v_from, (size_t)s->d->n_v * sizeof *v);
  memcpy(xdot, xdot_from, (size_t)s->d->n_x * sizeof *xdot);
}

/* The importer tells no way from where its step began to where it has moved the session: nonlinear blocks are followed
 * along a straight one. A point to which their branch cannot be followed stays as it is: it may never be accepted. */
static void follow_branch(rt_session *s) {
  rt_branches *b = &s->branches;
  mdl_data *m = &s->data;
  double end = s->t;
  int n = s->d->n_x;
  mdl_failure before = m->failure;
  memcpy(s->x_before, m->x, (size_t)n * sizeof *m->x);
  copy_values(s, s->v_before, s->xdot_before, m->v, m->xdot);
  s->dense = (rt_dense){.c = s->dense.c, .degree = 1, .t0 = b->t, .h = end - b->t, .valid = true};
  for (int i = 0; i < n; i++) {
    s->dense.c[i] = b->x[i];
    s->dense.c[n + i] = m->x[i] - b->x[i];
  }
  rt_failure failure = s->failure;
  bool reached = !rt_branch_reach(s, end);
  s->dense.valid = b->ended = false;
  s->t = end;
  s->failure = failure;
  m->failure = before;
  memcpy(m->x, s->x_before, (size_t)n * sizeof *m->x);
  copy_values(s, m->v, m->xdot, reached ? b->v_reached : s->v_before, reached ? b->xdot_reached : s->xdot_before);
  if (reached) memcpy(b->orientation, b->facing_reached, (size_t)s->d->n_equations * sizeof(double));
}

/* The point is on the branch of the last step's end, and so are the guards. */
void fmu_follow(fmu *f) {
  rt_session *s = f->session;
  bool doubtful = s->data.contraction.ratio > MDL_CONTRACTS || s->data.contraction.turned;
  if (!s->d->n_branches || !(s->t > s->branches.t) || !doubtful) return;
  follow_branch(s);
  if (s->d->n_rel) s->d->roots(&s->data, s->t, s->data.x, s->data.xdot, s->data.v, s->g);
}
