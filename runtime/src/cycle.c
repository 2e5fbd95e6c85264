/* Passes of an event that go round in a circle: what comes again to where it was goes on as it did.
 *
 * One earlier point is kept, at passes 1, 2, 4, 8 ... (R. P. Brent, BIT 20 (1980) 176-184): a circle is noticed at the
 * latest when it has been gone through twice as often as it takes to come to it. */
#include <string.h>

#include "session.h"

static bool is_where_it_was(const rt_session *s) {
  const mdl_descriptor *d = s->d;
  const mdl_data *m = &s->data;
  return !memcmp(m->rel, s->rel_seen, (size_t)d->n_rel) && !memcmp(m->when, s->when_seen, (size_t)d->n_when) &&
         !memcmp(m->d, s->d_seen, (size_t)d->n_d * sizeof *m->d) &&
         !memcmp(m->x, s->x_seen, (size_t)d->n_x * sizeof *m->x);
}

static void keep(rt_session *s) {
  const mdl_data *m = &s->data;
  memcpy(s->rel_seen, m->rel, (size_t)s->d->n_rel);
  memcpy(s->when_seen, m->when, (size_t)s->d->n_when);
  memcpy(s->d_seen, m->d, (size_t)s->d->n_d * sizeof *m->d);
  memcpy(s->x_seen, m->x, (size_t)s->d->n_x * sizeof *m->x);
}

/* Whether pass k (1, 2, ...) of one kind, with the same ticks, has come to where an earlier one was. */
bool rt_event_circles(rt_session *s, int k) {
  if (k > 1 && is_where_it_was(s)) return true;
  if ((k & (k - 1)) == 0) keep(s);
  return false;
}
