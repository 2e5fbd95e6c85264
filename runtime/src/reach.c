/* Affine guards that keep far away from zero in a step, told from how far the states move, without their polynomials.
 *
 * |g(t) - g(t0)| <= sum_i |dg/dx_i| max |x_i(t) - x_i(t0)| + |dg/dt| h, where dg/dx_i and dg/dt are constant between
 * events. They are asked for once after an event, a call of guard_rates each, when the polynomials have cost as much
 * since: so no more than twice the calls that would have been the fewest are made, however far events are apart. */
#include <stdlib.h>
#include <string.h>

#include "swings.h"

enum {
  CALLS_OF_A_SHAPE = 5, /* of guard_rates, that polynomials of degree 4 and their error take */
  MOST_SLOPES = 100000  /* of all guards, zero or not: 1 MB */
};

/* Slopes that are not zero, guard by guard: those of guard r are from first[r] on. */
struct rt_slopes {
  int *first;   /* [n_rel + 1] */
  int *state;   /* i */
  int *watched; /* [n_watched] states that some guard follows */
  int n_watched;
  double *size;          /* |dg/dx_i| */
  double *rate;          /* [n_rel] |dg/dt| */
  double *move, *leeway; /* [n_x + 1] how far each state, and last the time, moves in the last step, and still may */
  bool known;
  long shapings; /* polynomials of all guards since the last event */
};

/* NULL also where the model has no affine guards, or too many. */
struct rt_slopes *rt_slopes_new(const mdl_descriptor *d) {
  size_t n = (size_t)d->n_x, n_rel = (size_t)d->n_rel, most = n_rel * (n + 1);
  if (!d->guard_rates || most > MOST_SLOPES) return NULL;
  struct rt_slopes *k = calloc(1, sizeof *k + (most + n_rel + 2 * (n + 1)) * sizeof(double));
  int *numbers = calloc(n_rel + 1 + n + most, sizeof *numbers);
  if (!k || !numbers) {
    free(k);
    free(numbers);
    return NULL;
  }
  k->move = (double *)(k + 1);
  k->leeway = k->move + n + 1;
  k->rate = k->leeway + n + 1;
  k->size = k->rate + n_rel;
  k->first = numbers;
  k->watched = numbers + n_rel + 1;
  k->state = k->watched + n;
  return k;
}

void rt_slopes_free(struct rt_slopes *k) {
  if (k) free(k->first);
  free(k);
}

/* The equations are other ones, or what they hold is. */
void rt_slopes_forget(rt_session *s) {
  if (!s->slopes) return;
  s->slopes->known = false;
  s->slopes->shapings = 0;
}

/* The slopes by state i, or by the time, at places [r][i]. */
static int ask(rt_session *s, int i) {
  const mdl_descriptor *d = s->d;
  bool time = i == d->n_x;
  memset(s->x_trial, 0, (size_t)d->n_x * sizeof *s->x_trial);
  if (!time) s->x_trial[i] = 1;
  int status = d->guard_rates(&s->data, time, s->x_trial, s->rates);
  for (int r = 0; r < d->n_rel; r++)
    s->slopes->size[r * (d->n_x + 1) + i] = d->affine_guards[r] ? fabs(s->rates[r]) : 0;
  return status;
}

/* All slopes, if they are due. */
static bool learn(rt_session *s) {
  struct rt_slopes *k = s->slopes;
  int width = s->d->n_x + 1, count = 0;
  if (k->shapings++ * CALLS_OF_A_SHAPE < width) return false;
  mdl_failure before = s->data.failure;
  for (int i = 0; i < width; i++) {
    if (!ask(s, i)) continue;
    s->data.failure = before;
    k->shapings = 0;
    return false;
  }
  for (int r = 0; r < s->d->n_rel; r++) {
    k->first[r] = count;
    k->rate[r] = k->size[r * width + width - 1];
    for (int i = 0; i < width - 1; i++) {
      double size = k->size[r * width + i];
      if (size == 0) continue;
      k->state[count] = i;
      k->size[count++] = size;
    }
  }
  k->first[s->d->n_rel] = count;
  k->n_watched = 0;
  for (int i = 0; i < width; i++)
    k->leeway[i] = INFINITY;
  for (int j = 0; j < count; j++) {
    int i = k->state[j];
    if (k->leeway[i] > 0) k->watched[k->n_watched++] = i;
    k->leeway[i] = -INFINITY;
  }
  k->leeway[width - 1] = -INFINITY;
  return k->known = true;
}

/* How far the states move in the last step, sum_k |c_k|; whether none of them by more than it still may, nor errs so.
 */
static inline __attribute__((always_inline)) bool measure(const struct rt_slopes *k, const rt_dense *dense, int degree,
                                                          int n, const double *error, double per_error) {
  bool free = 2 * dense->h <= k->leeway[n];
  for (int w = 0; w < k->n_watched; w++) {
    int i = k->watched[w];
    double sum = 0;
    for (int j = 1; j <= degree; j++)
      sum += fabs(dense->c[j * n + i]);
    k->move[i] = sum;
    free &= 2 * sum + per_error * fabs(error[i]) <= k->leeway[i];
  }
  return free;
}

/* Guard by guard: whether g, less all that the last step moves it by, is not less than that again, nor than its error
 * over `share`. Where all are so, how far each state, and the time, may move before one of them is not. */
static bool look(rt_session *s, const double *error, double share) {
  const mdl_descriptor *d = s->d;
  struct rt_slopes *k = s->slopes;
  for (int i = 0; i <= d->n_x; i++)
    k->leeway[i] = INFINITY;
  for (int r = 0; r < d->n_rel; r++) {
    if (!d->affine_guards[r]) continue;
    double reach = k->rate[r] * s->dense.h, off = 0, held = s->data.rel[r] ? s->g[r] : -s->g[r];
    for (int j = k->first[r]; j < k->first[r + 1]; j++) {
      reach += k->size[j] * k->move[k->state[j]];
      off += k->size[j] * fabs(error[k->state[j]]);
    }
    if (!(held - reach >= reach && off <= share * (held - reach))) return false;
    double each = held / (k->first[r + 1] - k->first[r] + (k->rate[r] > 0));
    for (int j = k->first[r]; j < k->first[r + 1]; j++)
      k->leeway[k->state[j]] = rt_min(k->leeway[k->state[j]], each / k->size[j]);
    if (k->rate[r] > 0) k->leeway[d->n_x] = rt_min(k->leeway[d->n_x], each / k->rate[r]);
  }
  return true;
}

/* Whether all affine guards keep twice as far away from zero as they may move in the last step, whose error in them is
 * `share` of their distance at most; s->g belongs to its start. False where that is not known. */
bool rt_keep_away(rt_session *s, const double *error, double share) {
  struct rt_slopes *k = s->slopes;
  if (!k || (!k->known && !learn(s))) return false;
  const rt_dense *dense = &s->dense;
  int n = s->d->n_x;
  rt_dense_prepare(s);
  if (dense->t0 != s->t_previous) return false;
  bool free = dense->degree == 4 /* as that of dopri5 */ ? measure(k, dense, 4, n, error, 1 / share)
              : dense->degree == 5 /* as IDA's mostly */ ? measure(k, dense, 5, n, error, 1 / share)
                                                         : measure(k, dense, dense->degree, n, error, 1 / share);
  if (!free && !look(s, error, share)) {
    k->leeway[n] = -INFINITY;
    return false;
  }
  for (int w = 0; w < k->n_watched; w++)
    k->leeway[k->watched[w]] -= k->move[k->watched[w]];
  k->leeway[n] -= dense->h;
  return true;
}
