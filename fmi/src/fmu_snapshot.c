/* The state of an instance as bytes, for importers that go back in time: everything that a session computes with. What
 * the solver remembers is its step size alone, because a step ends at every communication point. */
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "fmu.h"
#include "onestep.h"
#include "past.h"

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

/* Guards of four instants change places as time goes on: their place in the block. */
static void pass_guards(stream *w, double **guards, double *block) {
  ptrdiff_t offset = *guards - block;
  PASS(offset);
  *guards = block + offset;
}

static void pass_session(stream *w, rt_session *s) {
  PASS(s->start), PASS(s->stop), PASS(s->t_previous), PASS(s->t), PASS(s->t_uncrossed), PASS(s->t_end);
  PASS(s->steps_taken), PASS(s->tiny_steps), PASS(s->futile_events), PASS(s->pending), PASS(s->last_event);
  PASS(s->t_before), PASS(s->t_oldest), PASS(s->resume), PASS(s->reinitialised), PASS(s->n_initial),
      PASS(s->recorder.next), PASS(s->look_curved);
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
  pass_guards(w, &s->g_oldest, s->numbers);
}

/* How many pieces each delay has come first, so that a state can be judged before anything is taken from it. */
static void pass_counts(stream *w, rt_session *s) {
  for (int k = 0; k < s->d->n_delay; k++)
    PASS(s->delays->past[k].n);
}

static void pass_delays(stream *w, rt_session *s) {
  rt_delays *d = s->delays;
  if (!d) return;
  PASS(d->fresh);
  pass(w, d->seconds, (size_t)d->n * sizeof *d->seconds);
  pass(w, d->left, (size_t)d->n * sizeof *d->left);
  for (int k = 0; k < d->n; k++) {
    rt_history *h = &d->past[k];
    PASS(h->cursor), PASS(h->ahead), PASS(h->before), PASS(h->size);
    pass(w, h->pieces, (size_t)h->n * sizeof *h->pieces);
  }
}

static void pass_all(stream *w, fmu *f) {
  pass_counts(w, f->session);
  PASS(f->mode), PASS(f->begun), PASS(f->fresh), PASS(f->retuned), PASS(f->driven);
  pass(w, f->input, (size_t)f->session->d->n_u * sizeof *f->input);
  rt_onestep *solver = f->session->memory;
  PASS(solver->h_next), PASS(solver->last_log_error);
  pass_session(w, f->session);
  pass_delays(w, f->session);
}

static size_t size_of(fmu *f) {
  stream w = {0};
  pass_all(&w, f);
  return w.size;
}

static size_t pieces_of(const int *counts, int n) {
  size_t sum = 0;
  for (int k = 0; k < n; k++)
    sum += (size_t)counts[k];
  return sum * sizeof(rt_piece);
}

/* Whether these bytes are a state of this FMU, whose delays may have another past than at present; room is made for
 * that. */
static bool fits(fmu *f, const unsigned char *bytes, size_t size) {
  rt_delays *d = f->session->delays;
  int n = d ? d->n : 0, counts[n + 1], now[n + 1];
  size_t head = (size_t)n * sizeof *counts;
  bool sound = size >= head;
  if (sound) memcpy(counts, bytes, head);
  for (int k = 0; k < n && sound; k++) {
    now[k] = d->past[k].n;
    sound = counts[k] >= 0;
  }
  if (!sound || size - pieces_of(counts, n) != size_of(f) - pieces_of(now, n))
    return fmu_refuse(f, "these %zu bytes are no state of this FMU", size);
  for (int k = 0; k < n; k++)
    if (!rt_history_reserve(&d->past[k], counts[k])) return fmu_refuse(f, "out of memory");
  return true;
}

static bool reserve(fmu *f, void **snapshot, size_t size) {
  fmu_snapshot *kept = realloc(*snapshot, sizeof *kept + size);
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
  if (!fits(f, bytes, size)) return false;
  *snapshot = NULL;
  if (!reserve(f, snapshot, size)) return false;
  memcpy(((fmu_snapshot *)*snapshot)->bytes, bytes, size);
  return true;
}

bool fmu_load(fmu *f, const void *snapshot) {
  rt_session *s = f->session;
  const fmu_snapshot *kept = snapshot;
  if (!fits(f, kept->bytes, kept->size)) return false;
  stream w = {.from = kept->bytes};
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
