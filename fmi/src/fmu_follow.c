/* Model exchange: which solution of nonlinear blocks belongs to where the importer has moved the instance. */
#include <string.h>

#include "fmu.h"

/* The importer tells no way from where its step began to where it has moved the session: nonlinear blocks are followed
 * along a straight one. A point to which their branch cannot be followed stays as it is: it may never be accepted. */
static void follow_branch(rt_session *s) {
  rt_branches *b = &s->branches;
  mdl_data *m = &s->data;
  int n = s->d->n_x;
  s->dense = (rt_dense){.c = s->dense.c, .degree = 1, .t0 = b->t, .h = s->t - b->t, .valid = true};
  for (int i = 0; i < n; i++) {
    s->dense.c[i] = b->x[i];
    s->dense.c[n + i] = m->x[i] - b->x[i];
  }
  if (rt_branch_is_reached(s, s->t)) {
    memcpy(m->v, b->v_reached, (size_t)s->d->n_v * sizeof *m->v);
    memcpy(m->xdot, b->xdot_reached, (size_t)n * sizeof *m->xdot);
    memcpy(b->orientation, b->facing_reached, (size_t)s->d->n_equations * sizeof *b->orientation);
  }
  s->dense.valid = false;
}

/* The point is on the branch of the last step's end, and so are the guards. */
void fmu_follow(fmu *f) {
  rt_session *s = f->session;
  bool doubtful = s->data.contraction.ratio > MDL_CONTRACTS || s->data.contraction.turned;
  if (!s->d->n_branches || !(s->t > s->branches.t) || !doubtful) return;
  follow_branch(s);
  if (s->d->n_rel) s->d->roots(&s->data, s->t, s->data.x, s->data.xdot, s->data.v, s->g);
}
