/* The state of an instance as bytes, for importers that go back in time: everything that a session computes with. What
 * the solver remembers is its step size alone, because a step ends at every communication point. */
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "fmu.h"
#include "onestep.h"

/* One pass over everything: with `into` it is read, with `from` written, with neither counted. */
typedef struct {
  unsigned char *into;
  const unsigned char *from;
  size_t size;
} stream;

static void pass(stream *w, void *place, size_t size) {
  if (w->into) memcpy(w->into + w->size, place, size);
  if (w->from) memcpy(place, w->from + w->size, size);
  w->size += size;
}

#define PASS(field) pass(w, &(field), sizeof(field))

/* Guards of three instants change places as time goes on: their place in the block. */
static void pass_guards(stream *w, double **guards, double *block) {
  ptrdiff_t offset = *guards - block;
  PASS(offset);
  *guards = block + offset;
}

static void pass_session(stream *w, rt_session *s) {
  PASS(s->start), PASS(s->stop), PASS(s->t_previous), PASS(s->t), PASS(s->t_uncrossed), PASS(s->t_end);
  PASS(s->steps_taken), PASS(s->tiny_steps), PASS(s->futile_events), PASS(s->pending), PASS(s->last_event);
  PASS(s->t_before), PASS(s->resume), PASS(s->reinitialised), PASS(s->n_initial), PASS(s->recorder.next),
      PASS(s->look_curved);
  PASS(s->clock.next_relation), PASS(s->clock.tolerance), PASS(s->clock.step);
  PASS(s->data.initial), PASS(s->data.terminal), PASS(s->data.reinitialised), PASS(s->data.terminated);
  PASS(s->data.start_time), PASS(s->options.rtol), PASS(s->options.atol);
  pass(w, s->clock.next, (size_t)s->d->n_sample * sizeof *s->clock.next);
  pass(w, s->initial_index, (size_t)s->d->n_x * sizeof *s->initial_index);
  pass(w, s->numbers, s->n_numbers * sizeof *s->numbers);
  pass(w, s->flags, s->n_flags);
  pass_guards(w, &s->g, s->numbers);
  pass_guards(w, &s->g_previous, s->numbers);
  pass_guards(w, &s->g_before, s->numbers);
}

static void pass_all(stream *w, fmu *f) {
  PASS(f->mode), PASS(f->begun), PASS(f->fresh), PASS(f->retuned), PASS(f->driven);
  pass(w, f->input, (size_t)f->session->d->n_u * sizeof *f->input);
  rt_onestep *solver = f->session->memory;
  PASS(solver->h_next), PASS(solver->last_log_error);
  pass_session(w, f->session);
}

static size_t size_of(fmu *f) {
  stream w = {0};
  pass_all(&w, f);
  return w.size;
}

static bool reserve(fmu *f, void **snapshot, size_t size) {
  fmu_snapshot *kept = *snapshot ? *snapshot : malloc(sizeof *kept + size);
  if (!kept) return fmu_refuse(f, "out of memory");
  kept->size = size;
  *snapshot = kept;
  return true;
}

bool fmu_save(fmu *f, void **snapshot) {
  if (!reserve(f, snapshot, size_of(f))) return false;
  stream w = {.into = ((fmu_snapshot *)*snapshot)->bytes};
  pass_all(&w, f);
  return true;
}

bool fmu_pack(fmu *f, const void *snapshot, void *bytes, size_t size) {
  const fmu_snapshot *kept = snapshot;
  if (size < kept->size) return fmu_refuse(f, "a state needs %zu bytes", kept->size);
  memcpy(bytes, kept->bytes, kept->size);
  return true;
}

bool fmu_unpack(fmu *f, const void *bytes, size_t size, void **snapshot) {
  if (size != size_of(f)) return fmu_refuse(f, "these %zu bytes are no state of this FMU", size);
  *snapshot = NULL;
  if (!reserve(f, snapshot, size)) return false;
  memcpy(((fmu_snapshot *)*snapshot)->bytes, bytes, size);
  return true;
}

bool fmu_load(fmu *f, const void *snapshot) {
  rt_session *s = f->session;
  stream w = {.from = ((const fmu_snapshot *)snapshot)->bytes};
  pass_all(&w, f);
  s->input_time = NAN;
  s->dense.valid = s->resume = false;
  if (!f->begun) return true;
  rt_onestep *solver = s->memory; /* its derivatives are those of another point */
  double h = solver->h_next, error = solver->last_log_error;
  if (!fmu_done(f, s->method->begin(s, solver))) return false;
  solver->h_next = h;
  solver->last_log_error = error;
  return true;
}
