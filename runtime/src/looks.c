/* A step is looked at in pieces where its ends do not show what the guards do inside it.
 *
 * A guard that follows sin or cos of something may cross many times in a step over which the states hardly bend: no
 * piece is longer than an eighth of a turn of the fastest phase. Of a guard that is curved in another way nothing is
 * known but what the caller wants to see, so it is looked at as often as results are wanted, up to five thousand times
 * in a run, which costs about as much as the steps of a run do. */
#include <math.h>
#include <string.h>

#include "looks.h"

static const double most_turn =
    0.25 * 3.14159265358979323846; /* rad between looks: the dips between them are parabolas */
static const double most_looks = 5000;

void rt_looks_begin(rt_session *s) {
  double span = s->stop - s->start;
  s->looks_inside = s->options.locate_events && s->d->n_rel && (s->d->n_phases || s->d->curved_guards);
  const rt_recorder *r = &s->recorder;
  double wanted = r->n_grid > 1 ? span / r->n_grid : r->interval > 0 ? r->interval : span;
  s->look = s->look_curved = s->d->curved_guards ? rt_max(wanted, span / most_looks) : INFINITY;
}

static int phases(rt_session *s, double *phase) {
  const mdl_data *m = &s->data;
  return s->d->n_phases ? s->d->phases(&s->data, s->t, m->x, m->xdot, m->v, phase) : 0;
}

/* Before a step: its phases there. */
void rt_looks_start(rt_session *s) {
  if (s->looks_inside && phases(s, s->phase_start)) s->phase_start[0] = NAN;
}

/* After a step: the longest piece of it to look at, and its end, to come back to. */
void rt_looks_divide(rt_session *s) {
  const mdl_descriptor *d = s->d;
  s->look = INFINITY;
  s->in_pieces = false;
  if (!s->looks_inside) return;
  double turn = 0, h = s->t_end - s->t_previous;
  if (!phases(s, s->phase))
    for (int k = 0; k < d->n_phases; k++) {
      double moved = fabs(s->phase[k] - s->phase_start[k]);
      if (moved > turn) turn = moved;
    }
  s->look = rt_min(s->look_curved, turn > most_turn && isfinite(turn) ? h / ceil(turn / most_turn) : INFINITY);
  s->in_pieces = s->look < 0.999 * h;
  if (s->in_pieces) rt_keep_step_end(s);
}

/* The end of the step that is looked at, to which the session comes back. */
void rt_keep_step_end(rt_session *s) {
  memcpy(s->x_end, s->data.x, (size_t)s->d->n_x * sizeof(double));
  memcpy(s->xdot_end, s->data.xdot, (size_t)s->d->n_x * sizeof(double));
  memcpy(s->v_end, s->data.v, (size_t)s->d->n_v * sizeof(double));
}

/* The point at `to` in the last step, from that at its start; 0 found. */
static int look_at(rt_session *s, double to) {
  rt_dense_eval(&s->dense, s->d->n_x, to, s->data.x);
  s->t = to;
  int status = rt_rhs(s, to, s->data.x, s->data.xdot, s->data.v);
  return status ? status : rt_check_finite(s, s->data.xdot);
}

/* On to the end of the next piece of the last step. Where there is no such point, as of equations that end behind a
 * relation that switches in the piece, one of half its length: down to what time tells apart. */
rt_status rt_look_on(rt_session *s) {
  const mdl_descriptor *d = s->d;
  double next = s->t_previous + s->look;
  if (!(next < s->t_end - 1e-3 * s->look)) {
    s->t = s->t_end;
    memcpy(s->data.x, s->x_end, (size_t)d->n_x * sizeof(double));
    memcpy(s->data.xdot, s->xdot_end, (size_t)d->n_x * sizeof(double));
    memcpy(s->data.v, s->v_end, (size_t)d->n_v * sizeof(double));
    return RT_OK;
  }
  rt_dense_prepare(s);
  mdl_failure told = s->data.failure;
  memcpy(s->v_before, s->data.v, (size_t)d->n_v * sizeof(double));
  for (double piece = s->look; look_at(s, s->t_previous + piece); piece *= 0.5) {
    if (piece <= rt_smallest_step(s)) return rt_fail_model(s, s->t, "looking inside a step");
    memcpy(s->data.v, s->v_before, (size_t)d->n_v * sizeof(double));
    s->data.failure = told;
  }
  return RT_OK;
}
