/* The tight reference: classical Runge-Kutta at a small fixed step, in the ODE form, every event located by
 * repeating the step that crosses it with the length that ends on it. No interpolation anywhere. */
#include "problem.h"

#include <math.h>
#include <string.h>
#include <time.h>

typedef struct {
  const problem *p;
  problem_mode mode;
  bench_counters *counters;
} integrator;

static void rk4_step(const integrator *s, const double *x, double h, double *next) {
  static const double node[4] = {0.0, 0.5, 0.5, 1.0}, weight[4] = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};
  const int n = s->p->n_x;
  double stage[MAX_Y], slope[MAX_Y] = {0};
  memcpy(next, x, (size_t)n * sizeof *x);
  for (int k = 0; k < 4; k++) {
    for (int i = 0; i < n; i++) {
      stage[i] = x[i] + node[k] * h * slope[i];
    }
    s->p->derivatives(&s->mode, stage, slope);
    for (int i = 0; i < n; i++) {
      next[i] += weight[k] * h * slope[i];
    }
  }
  s->counters->residuals += 4;
}

static double smallest_guard(const integrator *s, const double *x) {
  double g[MAX_GUARDS], least = INFINITY;
  s->p->guards(&s->mode, x, g);
  for (int i = 0; i < s->p->n_guards; i++) {
    least = fmin(least, g[i]);
  }
  s->counters->roots += 1;
  return least;
}

/* Length of the step from `x`, shorter than `h`, after which a guard has just fallen to zero; bisection to the
 * last bit. `next` is the state there. */
static double locate(const integrator *s, const double *x, double h, double *next) {
  double before = 0.0, after = h;
  for (;;) {
    const double middle = 0.5 * (before + after);
    if (middle <= before || middle >= after || after - before < 1e-17) {
      rk4_step(s, x, after, next);
      return after;
    }
    rk4_step(s, x, middle, next);
    if (smallest_guard(s, next) > 0.0) {
      before = middle;
    } else {
      after = middle;
    }
  }
}

static void advance(integrator *s, double *x, double t, double goal, double step) {
  double next[MAX_Y];
  while (goal - t > 1e-12 * step) {
    const double event = s->p->next_time_event(&s->mode);
    double h = fmin(step, goal - t);
    rk4_step(s, x, h, next);
    s->counters->steps += 1;
    const int crossed = smallest_guard(s, next) <= 0.0;
    if (crossed) {
      h = locate(s, x, h, next);
    }
    memcpy(x, next, (size_t)s->p->n_x * sizeof *x);
    t += h;
    if (crossed) {
      s->p->guard_event(&s->mode, x);
      s->counters->events += 1;
    }
    if (fabs(t - event) < 1e-9) { /* time events lie on the output grid */
      s->p->time_event(&s->mode);
      s->counters->events += 1;
    }
  }
}

int solve_with_rk4(const problem *p, double step, double *rows, bench_counters *counters) {
  struct timespec begin, end;
  *counters = (bench_counters){0};
  clock_gettime(CLOCK_MONOTONIC, &begin);
  integrator s = {.p = p, .counters = counters};
  double x[MAX_Y];
  p->start(&s.mode, x);
  const int points = (int)lround(p->stop / p->interval);
  for (int k = 0; k <= points; k++) {
    if (k) {
      advance(&s, x, (k - 1) * p->interval, k * p->interval, step);
    }
    memcpy(rows + k * p->n_x, x, (size_t)p->n_x * sizeof *x);
  }
  clock_gettime(CLOCK_MONOTONIC, &end);
  counters->seconds = (double)(end.tv_sec - begin.tv_sec) + 1e-9 * (double)(end.tv_nsec - begin.tv_nsec);
  return 0;
}
