/* The state of an instance as bytes, for importers that go back in time: everything that a session computes with. What
 * the solver remembers is its step size alone, because a step ends at every communication point. Bytes may come from
 * anywhere: they are judged, all that memory is looked up with among them, before anything is taken from them. */
#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "fmu.h"
#include "onestep.h"
#include "past.h"
#include "swings.h"

/* One pass over everything: with `into` it is read, with `from` written, with `judged` looked at, with none counted. */
typedef struct {
  unsigned char *into;
  const unsigned char *from, *judged;
  size_t size;
  bool unsound; /* what was judged cannot be */
} stream;

static void pass(stream *w, void *place, size_t size) {
  if (w->into) memcpy(w->into + w->size, place, size);
  if (w->from) memcpy(place, w->from + w->size, size);
  w->size += size;
}

#define PASS(field) pass(w, &(field), sizeof(field))

/* An index, or a number of things. */
static void pass_within(stream *w, int *place, int least, int most) {
  int value = least;
  if (w->judged) memcpy(&value, w->judged + w->size, sizeof value);
  w->unsound |= value < least || value > most;
  pass(w, place, sizeof *place);
}

/* Bytes of 0 and 1, those with `sign` -1 too. */
static void judge_flags(stream *w, size_t at, size_t n, bool sign) {
  for (size_t i = 0; w->judged && i < n; i++)
    w->unsound |= w->judged[at + i] > 1 && !(sign && w->judged[at + i] == (unsigned char)-1);
}

static void pass_flag(stream *w, bool *place) {
  judge_flags(w, w->size, sizeof *place, false);
  pass(w, place, sizeof *place);
}

/* Guards of four instants change places as time goes on: their places in the block, each of which belongs to one. */
static void pass_guards(stream *w, rt_session *s) {
  double **const guards[] = {&s->g, &s->g_previous, &s->g_before, &s->g_oldest};
  ptrdiff_t offsets[4], judged[4];
  for (int i = 0; i < 4; i++)
    offsets[i] = *guards[i] - s->numbers;
  if (w->judged) {
    memcpy(judged, w->judged + w->size, sizeof judged);
    for (int i = 0; i < 4; i++) {
      bool known = false, kept = false;
      for (int k = 0; k < 4; k++)
        known |= judged[i] == offsets[k], kept |= judged[k] == offsets[i];
      w->unsound |= !(known && kept);
    }
  }
  PASS(offsets);
  for (int i = 0; i < 4; i++)
    *guards[i] = s->numbers + offsets[i];
}

static void pass_session(stream *w, rt_session *s) {
  PASS(s->start), PASS(s->stop), PASS(s->t_previous), PASS(s->t), PASS(s->t_uncrossed), PASS(s->t_end);
  PASS(s->steps_taken), PASS(s->pieces_taken), PASS(s->tiny_steps), PASS(s->futile_events), PASS(s->pending),
      PASS(s->last_event), PASS(s->branches.t);
  PASS(s->t_before), PASS(s->t_oldest), pass_flag(w, &s->resume), pass_flag(w, &s->reinitialised);
  PASS(s->last_due_back), pass_flag(w, &s->growing);
  pass_within(w, &s->n_initial, 0, s->d->n_x);
  PASS(s->recorder.next), PASS(s->look_curved);
  PASS(s->clock.next_relation), PASS(s->clock.next_tick), PASS(s->clock.tolerance), PASS(s->clock.step);
  PASS(s->data.initial), PASS(s->data.terminal), PASS(s->data.reinitialised);
  pass_within(w, &s->data.terminated, 0, s->d->n_messages);
  PASS(s->data.start_time), PASS(s->options.rtol), PASS(s->options.atol);
  pass(w, s->clock.next, (size_t)s->d->n_sample * sizeof *s->clock.next);
  for (int i = 0; i < s->d->n_x; i++)
    pass_within(w, &s->initial_index[i], 0, s->d->n_x - 1);
  pass(w, s->numbers, s->n_numbers * sizeof *s->numbers);
  size_t signs = (size_t)((unsigned char *)s->division_sign - s->flags);
  judge_flags(w, w->size, signs, false);
  judge_flags(w, w->size + signs, s->n_flags - signs, true);
  pass(w, s->flags, s->n_flags);
  pass_guards(w, s);
  if (w->from) rt_slopes_forget(s);
}

/* How many pieces each delay has come first, so that a state can be judged before anything is taken from it. */
static void pass_counts(stream *w, rt_session *s) {
  for (int k = 0; k < s->d->n_delay; k++)
    PASS(s->delays->past[k].n);
}

static int count_of(const unsigned char *bytes, int k) {
  int count;
  memcpy(&count, bytes + (size_t)k * sizeof count, sizeof count);
  return count;
}

static void pass_pieces(stream *w, rt_history *h, int n) {
  for (int i = 0; w->judged && i < n; i++) {
    judge_flags(w, w->size + (size_t)i * sizeof(rt_piece) + offsetof(rt_piece, jump), sizeof(bool), false);
    judge_flags(w, w->size + (size_t)i * sizeof(rt_piece) + offsetof(rt_piece, kink), sizeof(bool), false);
  }
  pass(w, h->pieces, (size_t)n * sizeof *h->pieces);
}

static void pass_delays(stream *w, rt_session *s) {
  rt_delays *d = s->delays;
  if (!d) return;
  pass_flag(w, &d->fresh);
  pass(w, d->seconds, (size_t)d->n * sizeof *d->seconds);
  pass(w, d->left, (size_t)d->n * sizeof *d->left);
  for (int k = 0; k < d->n; k++) {
    rt_history *h = &d->past[k];
    int n = w->judged ? count_of(w->judged, k) : h->n;
    pass_within(w, &h->cursor, -1, n - 1);
    h->near = h->cursor;
    pass_within(w, &h->ahead, 0, n);
    PASS(h->before), PASS(h->size);
    pass_pieces(w, h, n);
  }
}

static void pass_all(stream *w, fmu *f) {
  pass_counts(w, f->session);
  int mode = f->mode;
  pass_within(w, &mode, FMU_SETUP, FMU_DONE);
  f->mode = mode;
  pass_flag(w, &f->begun), pass_flag(w, &f->fresh), pass_flag(w, &f->retuned), pass_flag(w, &f->untuned),
      pass_flag(w, &f->driven);
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
  for (int k = 0; k < n && sound; k++) {
    counts[k] = count_of(bytes, k), now[k] = d->past[k].n;
    sound = counts[k] >= 0;
  }
  sound = sound && size - pieces_of(counts, n) == size_of(f) - pieces_of(now, n);
  stream w = {.judged = bytes};
  if (sound) pass_all(&w, f);
  if (!sound || w.unsound) return fmu_refuse(f, "these %zu bytes are no state of this FMU", size);
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

/* FNV-1a, of which FMU it is a state, too (http://www.isthe.com/chongo/tech/comp/fnv). */
static uint64_t checksum(const unsigned char *bytes, size_t size) {
  uint64_t sum = 0xcbf29ce484222325u;
  for (const char *c = fmu_configuration.token; *c; c++)
    sum = (sum ^ (unsigned char)*c) * 0x100000001b3u;
  for (size_t i = 0; i < size; i++)
    sum = (sum ^ bytes[i]) * 0x100000001b3u;
  return sum;
}

size_t fmu_packed_size(const void *snapshot) {
  return ((const fmu_snapshot *)snapshot)->size + sizeof(uint64_t);
}

bool fmu_pack(fmu *f, const void *snapshot, void *bytes, size_t size) {
  const fmu_snapshot *kept = snapshot;
  if (size < fmu_packed_size(kept)) return fmu_refuse(f, "a state needs %zu bytes", fmu_packed_size(kept));
  uint64_t sum = checksum(kept->bytes, kept->size);
  memcpy(bytes, kept->bytes, kept->size);
  memcpy((unsigned char *)bytes + kept->size, &sum, sizeof sum);
  return true;
}

bool fmu_unpack(fmu *f, const void *bytes, size_t size, void **snapshot) {
  uint64_t sum = 0;
  bool whole = size >= sizeof sum;
  if (whole) {
    size -= sizeof sum;
    memcpy(&sum, (const unsigned char *)bytes + size, sizeof sum);
    whole = sum == checksum(bytes, size);
  }
  if (!whole) return fmu_refuse(f, "these bytes are no state of this FMU, or were damaged");
  if (!fits(f, bytes, size)) return false;
  *snapshot = NULL;
  if (!reserve(f, snapshot, size)) return false;
  memcpy(((fmu_snapshot *)*snapshot)->bytes, bytes, size);
  return true;
}

/* Are the next ticks in the future, or due for less than an interval? Others would be counted one by one. */
static bool clocks_fit(const rt_session *s) {
  const rt_clock *c = &s->clock;
  for (int i = 0; i < s->d->n_sample; i++) {
    double ahead = c->first[i] + (double)c->next[i] * c->interval[i] - s->t;
    bool counts = c->interval[i] >= 16 * rt_time_resolution(s) && c->tolerance <= 64 * c->interval[i];
    if (!counts || !(ahead > -c->interval[i])) return false;
  }
  return true;
}

bool fmu_load(fmu *f, const void *snapshot) {
  rt_session *s = f->session;
  const fmu_snapshot *kept = snapshot;
  if (!fits(f, kept->bytes, kept->size)) return false;
  stream w = {.from = kept->bytes};
  pass_all(&w, f);
  s->input_time = NAN;
  s->dense.valid = s->shaped = s->resume = false;
  if (!f->begun) return true;
  if (!clocks_fit(s)) return fmu_refuse(f, "a state whose clocks do not belong to its time");
  rt_onestep *solver = s->memory; /* its derivatives are those of another point */
  double h = solver->h_next, error = solver->last_log_error;
  if (!fmu_done(f, s->method->begin(s, solver))) return false;
  solver->h_next = h;
  solver->last_log_error = error;
  return true;
}
