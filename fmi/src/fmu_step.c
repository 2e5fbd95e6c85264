/* Co-simulation: the runtime's own loop, from one communication point to the next. */
#include <math.h>
#include <string.h>

#include "fmu.h"

static bool step_to(fmu *f, double stop, bool may_stop, bool *event) {
  rt_session *s = f->session;
  s->stop = stop;
  rt_start_patience(s); /* what the importer has computed meanwhile does not count */
  while (s->t < stop - s->clock.tolerance && !s->data.terminated) {
    if (!fmu_done(f, rt_advance(s))) return false;
    *event = may_stop && s->pending;
    if (*event) return true;
    if (!fmu_done(f, rt_happen(s))) return false;
    s->result->n_events = 0;
  }
  return true;
}

/* Where an event is left to the importer, and where the step ends before it gets there, session->t says how far. */
bool fmu_step(fmu *f, double from, double size, bool may_stop, bool *event) {
  rt_session *s = f->session;
  *event = false;
  if (f->mode != FMU_STEP) return fmu_refuse(f, "a step follows initialisation or event mode");
  if (!(size > 0) || !isfinite(size)) return fmu_refuse(f, "a step of %g s", size);
  const double rounding = 1e-9 * size + 1e-12 * fabs(s->t); /* of times that an importer adds up */
  if (fabs(from - s->t) > rounding)
    return fmu_refuse(f, "the step begins at %.17g s, but the last one ended at %.17g s", from, s->t);
  if (from + size > f->last_stop + rounding)
    return fmu_refuse(f, "the step ends at %.15g s, the stop time that was given is %.15g s", from + size,
                      f->last_stop);
  fmu_news news;
  if ((f->driven || f->retuned || s->pending) && !fmu_happen(f, &news)) return false;
  bool done = step_to(f, from + size, may_stop, event);
  f->fresh = true;
  return done;
}
