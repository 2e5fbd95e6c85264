/* Recorded inputs: linear or held between samples, constant outside.
 *
 * A held input jumps at its samples. Its value is frozen while a step is computed, so that the end of a step that lands
 * on a jump sees the value before it; rt_inputs_begin then moves on to the value after it. */
#include <math.h>

#include "delay.h"

static int sample_at(const rt_input *in, int guess, double t) {
  int k = guess;
  while (k > 0 && in->time[k] > t)
    k--;
  while (k + 1 < in->n && in->time[k + 1] <= t)
    k++;
  return k;
}

/* Beyond the line on which the input was last. */
static double move_on(rt_input *in, double t) {
  int k = in->cursor = sample_at(in, in->cursor, t);
  if (k + 1 == in->n || t < in->time[k]) return in->values[k];
  in->from = in->time[k];
  in->until = in->time[k + 1];
  in->span = in->until - in->from;
  in->base = in->values[k];
  in->rise = in->values[k + 1] - in->base;
  return in->base + (t - in->from) / in->span * in->rise;
}

static inline double linear(rt_input *in, double t) {
  return t >= in->from && t < in->until ? in->base + (t - in->from) / in->span * in->rise : move_on(in, t);
}

/* A run begins: nothing is known of the samples to come. */
void rt_inputs_reset(rt_session *s) {
  for (int i = 0; i < s->d->n_u; i++)
    s->inputs[i].ahead = 0, s->inputs[i].from = s->inputs[i].until = 0;
}

/* Inputs from t on: samples at t itself have been reached. */
void rt_inputs_begin(rt_session *s, double t) {
  for (int i = 0; i < s->d->n_u; i++)
    if (s->inputs[i].n) s->inputs[i].cursor = sample_at(&s->inputs[i], s->inputs[i].cursor, t + s->clock.tolerance);
  rt_delays_pass(s, t);
  s->input_time = NAN;
}

void rt_inputs_at(rt_session *s, double t) {
  if (t == s->input_time) return;
  for (int i = 0; i < s->d->n_u; i++) {
    rt_input *in = &s->inputs[i];
    if (in->n) s->data.u[i] = in->interpolation == RT_HOLD ? in->values[in->cursor] : linear(in, t);
  }
  rt_delays_at(s, t);
  s->input_time = t;
}

/* Slope of input i at the end of the last step, as that step has seen it (per s). */
double rt_input_slope(const rt_session *s, int i) {
  const rt_input *in = &s->inputs[i];
  if (!in->n || in->interpolation == RT_HOLD) return 0;
  int k = sample_at(in, in->cursor, s->t);
  if (k > 0 && in->time[k] >= s->t) k--;
  if (k + 1 == in->n || s->t < in->time[k]) return 0;
  return (in->values[k + 1] - in->values[k]) / (in->time[k + 1] - in->time[k]);
}

/* Does the slope change at sample k? One-step methods land on every kink that is more than rounding, because it would
 * cost them their order. A multistep method restarts at a kink that is larger than its tolerance, and steps over
 * smaller ones. */
static bool is_kink(const rt_session *s, const rt_input *in, int k) {
  if (k == 0 || k + 1 >= in->n) return true;
  const double *t = in->time, *v = in->values;
  double expected = v[k] + (v[k] - v[k - 1]) / (t[k] - t[k - 1]) * (t[k + 1] - t[k]);
  double negligible = s->method->multistep ? s->options.rtol : 1e-9;
  return fabs(v[k + 1] - expected) > negligible * (fabs(v[k - 1]) + fabs(v[k]) + fabs(v[k + 1]));
}

/* Does the input jump or bend at sample k? */
static bool is_break(const rt_session *s, const rt_input *in, int k) {
  return in->interpolation == RT_HOLD ? k > 0 && in->values[k] != in->values[k - 1] : is_kink(s, in, k);
}

/* The next sample after the present time at which an input jumps or bends. No step passes it, so that every sample is
 * looked at once in a run. */
double rt_inputs_next_break(rt_session *s) {
  double next = INFINITY, now = s->t + s->clock.tolerance;
  for (int i = 0; i < s->d->n_u; i++) {
    rt_input *in = &s->inputs[i];
    if (!in->n) continue;
    int k = in->ahead;
    while (k < in->n && (in->time[k] <= now || (in->time[k] < next && !is_break(s, in, k))))
      k++;
    in->ahead = k;
    if (k < in->n) next = rt_min(next, in->time[k]);
  }
  return rt_min(next, rt_delays_limit(s));
}

/* The jumps that are due at the present time and, for a multistep method, the kinks. */
int rt_inputs_due(rt_session *s) {
  int pending = rt_delays_due(s);
  double now = s->t + s->clock.tolerance;
  for (int i = 0; i < s->d->n_u; i++) {
    rt_input *in = &s->inputs[i];
    if (!in->n) continue;
    if (in->interpolation == RT_HOLD) {
      for (; in->cursor + 1 < in->n && in->time[in->cursor + 1] <= now; in->cursor++)
        if (in->values[in->cursor + 1] != in->values[in->cursor]) {
          pending |= RT_PENDING_JUMP;
          break;
        }
    } else if (s->method->multistep) {
      int k = sample_at(in, in->cursor, now);
      if (fabs(in->time[k] - s->t) <= s->clock.tolerance && is_kink(s, in, k)) pending |= RT_PENDING_KINK;
    }
  }
  return pending;
}
