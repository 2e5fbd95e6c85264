/* Dormand & Prince 5(4): J. R. Dormand, P. J. Prince, J. Comp. Appl. Math. 6 (1980) 19-26. The seventh stage is the
 * first of the next step. Dense output of order 4: Hairer, Norsett & Wanner, Solving Ordinary Differential Equations I,
 * II.6. */
#include "onestep.h"

enum { STAGES = 7 };

static const double c[STAGES] = {0, 1. / 5, 3. / 10, 4. / 5, 8. / 9, 1, 1};
static const double a[STAGES][STAGES - 1] = {{0},
                                             {1. / 5},
                                             {3. / 40, 9. / 40},
                                             {44. / 45, -56. / 15, 32. / 9},
                                             {19372. / 6561, -25360. / 2187, 64448. / 6561, -212. / 729},
                                             {9017. / 3168, -355. / 33, 46732. / 5247, 49. / 176, -5103. / 18656},
                                             {35. / 384, 0, 500. / 1113, 125. / 192, -2187. / 6784, 11. / 84}};
/* fifth-order minus fourth-order weights */
static const double e[STAGES] = {71. / 57600, 0, -71. / 16695, 71. / 1920, -17253. / 339200, 22. / 525, -1. / 40};
static const double d[STAGES] = {-12715105075. / 11282082432.,  0,
                                 87487479700. / 32700410799.,   -10690763975. / 1880347072.,
                                 701980252875. / 199316789632., -1453857185. / 822651844.,
                                 69997945. / 29380423.};

static const mdl_scheme tableau = {.stages = STAGES, .nodes = c, .weights = &a[0][0]};

/* The stages, of n states, and the error. */
static inline __attribute__((always_inline)) int stages(rt_session *s, rt_onestep *o, double h, int n) {
  int status = 0;
  if (s->d->stages && !o->tangent) {
    status = rt_stages_at_once(s, o, h, &tableau);
  } else {
#pragma GCC unroll 6
    for (int j = 1; j < STAGES; j++) {
      status = rt_explicit_stage(s, o, h, n, j, c[j], a[j], j == STAGES - 1);
      if (status) return status;
    }
  }
  const double *k = o->k;
  double *error = o->error;
  for (int next = 0; next < n; next += 2) {
    int i = rt_pair_at(n, next);
    rt_pair sum = e[0] * rt_load(k + i);
    for (int j = 2; j < STAGES - 1; j++)
      sum += e[j] * rt_load(k + j * n + i);
    rt_store(error + i, h * (sum + e[STAGES - 1] * rt_load_fresh(k + (STAGES - 1) * n + i)));
  }
  return status;
}

/* Of few states, as most models have, the loops over them are a third of all work: their number is known to each. */
static int attempt(rt_session *s, rt_onestep *o, double h) {
  switch (s->d->n_x) {
  case 1:
    return stages(s, o, h, 1);
  case 2:
    return stages(s, o, h, 2);
  case 3:
    return stages(s, o, h, 3);
  case 4:
    return stages(s, o, h, 4);
  case 5:
    return stages(s, o, h, 5);
  case 6:
    return stages(s, o, h, 6);
  default:
    return stages(s, o, h, s->d->n_x);
  }
}

/* x0 + s (r1 + (1 - s) (r2 + s (r3 + (1 - s) r4))), expanded in powers of s, which are written in rising order: of a
 * single state, the second of its pair is overwritten by the next power. */
static void dense(int n, const rt_onestep *o, rt_dense *out) {
  out->degree = 4;
  for (int next = 0; next < n; next += 2) {
    int i = rt_pair_at(n, next);
    double *c = out->c + i;
    rt_pair x0 = rt_load(o->x0 + i), r1 = rt_load(o->x1 + i) - x0, r2 = o->h * rt_load(o->f0 + i) - r1,
            r3 = r1 - o->h * rt_load(o->f1 + i) - r2, r4 = d[0] * rt_load(o->k + i);
    for (int j = 2; j < STAGES; j++)
      r4 += d[j] * rt_load(o->k + j * n + i);
    r4 *= o->h;
    rt_store(c, x0);
    rt_store(c + n, r1 + r2);
    rt_store(c + 2 * n, r3 + r4 - r2);
    rt_store(c + 3 * n, -r3 - 2 * r4);
    rt_store(c + 4 * n, r4);
  }
}

static const rt_scheme scheme = {.stages = STAGES,
                                 .order = 5,
                                 .damping = 0.04,
                                 .min_factor = 0.2,
                                 .max_factor = 10,
                                 .ends_are_stages = true,
                                 .error_has_f1 = true,
                                 .attempt = attempt,
                                 .dense = dense,
                                 .nodes = c,
                                 .weights = &a[0][0],
                                 .error_weights = e};

static void *create(rt_session *s) {
  return rt_onestep_create(s, &scheme);
}

const rt_method rt_method_dopri5 = {
    .name = "dopri5",
    .create = create,
    .destroy = rt_onestep_destroy,
    .begin = rt_onestep_begin,
    .restart = rt_onestep_restart,
    .step = rt_onestep_step,
    .dense = rt_onestep_dense,
    .count = rt_onestep_count,
    .errors = rt_onestep_errors,
    .sensitivities = rt_onestep_sensitivities,
    .dense_tangent = rt_onestep_dense_tangent,
};
