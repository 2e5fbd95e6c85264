/* Sampler: generated from
 *   Sampler.mo  sha256 99b7a74781a01244b3ebd5b1ed750f78489854a581787f04efdbfddd3eb1455f
 * Do not edit: edit the model. */
#include "mdl_abi.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

static const mdl_variable mdl_variables[] = {
  {"Ts", "s", "", "Sampler.mo", 2, MDL_REAL, MDL_PARAMETER, 0, 1, 1, 0, 0.1, -INFINITY, INFINITY, 0.0, "", 1},
  {"rate", "1/s", "", "Sampler.mo", 3, MDL_REAL, MDL_PARAMETER, 1, 1, 1, 0, 2.0, -INFINITY, INFINITY, 0.0, "", 1},
  {"gain", "", "", "Sampler.mo", 4, MDL_REAL, MDL_PARAMETER, 2, 1, 1, 0, 3.0, -INFINITY, INFINITY, 0.0, "", 1},
  {"u", "", "", "Sampler.mo", 5, MDL_REAL, MDL_DISCRETE, 0, 1, 0, 0, 0.0, -INFINITY, INFINITY, 0.0, "", 0},
  {"x", "", "", "Sampler.mo", 6, MDL_REAL, MDL_STATE, 0, 1, 0, 0, 0.0, -INFINITY, INFINITY, 0.0, "", 0},
  {"n", "", "", "Sampler.mo", 7, MDL_INTEGER, MDL_DISCRETE, 1, 1, 0, 0, 0.0, -INFINITY, INFINITY, 0.0, "", 0},
  {"high", "", "", "Sampler.mo", 8, MDL_BOOLEAN, MDL_DISCRETE, 2, 1, 0, 0, 0.0, -INFINITY, INFINITY, 0.0, "", 0}
};

static const mdl_relation mdl_relations[] = {
  {{"x > 0.7", "Sampler.mo", 11, ""}, 0},
  {{"x < 0.2", "Sampler.mo", 16, ""}, 0}
};

static const int mdl_assert_values[] = {
  0
};

static const mdl_assert mdl_asserts[] = {
  {{"the interval of sample is positive", "Sampler.mo", 12, ""}, 1, mdl_assert_values + 0},
  {{"too many saturations", "Sampler.mo", 18, ""}, 0, NULL}
};

static const int mdl_residual_equation[] = {
  0
};

static const double mdl_p_start[] = {
  0.1,
  2.0,
  3.0
};

static const int mdl_jac_colptr[] = {
  0,
  1
};

static const int mdl_jac_rowidx[] = {
  0
};

static const mdl_equation mdl_equations[] = {
  {"der(x) = rate*(u - x)", "Sampler.mo", 10, ""}
};

static const mdl_computed mdl_computed_by[] = {
  {MDL_DERIVATIVE, 0, 0}
};

static const int mdl_equation_first[] = {
  0,
  3
};

static const int mdl_equation_variables[] = {
  1,
  3,
  4
};

static const unsigned char mdl_affine_guards[] = {
  1,
  1
};

static const unsigned char mdl_least_sizes[] = {
  1
};

static int mdl_fail(mdl_data *m, mdl_failure_kind kind, int equation, double value) {
  m->failure = (mdl_failure){kind, equation, -1, value, 0.0};
  return 1;
}

static int mdl_parameters(mdl_data *m) {
  const double Ts = m->p[0];
  /* Sampler.mo:12  assert */
  if (!(Ts > 0.0)) {
    (void)mdl_fail(m, MDL_FAILURE_ASSERT, 0, 0.0);
    return -1;
  }
  return 0;
}

static int mdl_starts(mdl_data *m) {
  m->x[0] = 0.0;
  m->d[0] = 0.0;
  m->d[1] = 0.0;
  m->pre_d[0] = m->d[0];
  m->pre_d[1] = m->d[1];
  m->pre_d[2] = m->d[2];
  return 0;
}

static int mdl_samples(const mdl_data *m, double *start, double *interval) {
  const double Ts = m->p[0];
  start[0] = 0.0;
  interval[0] = Ts;
  return 0;
}

static inline __attribute__((always_inline)) int mdl_explicit(mdl_data *m, double t, const double *x, double *xdot, double *v) {
  (void)t;
  (void)v;
  const double u = m->d[0];
  const double rate = m->p[1];
  const double x_2 = x[0];
  /* Sampler.mo:10  der(x) = rate*(u - x) */
  const double der_x_2 = rate * (u - x_2);
  xdot[0] = der_x_2;
  return 0;
}

static int mdl_rhs(mdl_data *m, double t, const double *x, double *xdot, double *v) {
  return mdl_explicit(m, t, x, xdot, v);
}

static int mdl_stages(mdl_data *m, const mdl_scheme *scheme, double t, double h, const double *x, double *restrict k,
                      double *restrict end, double *restrict v) {
  enum { N = 1 };
  const int last = scheme->stages - 1;
  for (int j = 1; j <= last; ++j) {
    const double *a = scheme->weights + j * last;
    double at[N];
    for (int i = 0; i < N; ++i)
      at[i] = x[i];
    for (int l = 0; l < j; ++l) {
      const double weight = h * a[l];
      for (int i = 0; i < N; ++i)
        at[i] += weight * k[l * N + i];
    }
    for (int i = 0; i < N; ++i)
      end[i] = at[i];
    m->undetermined = m->unsettled = 0;
    m->brief = j < last;
    const int status = mdl_explicit(m, t + scheme->nodes[j] * h, at, k + j * N, v);
    m->brief = 0;
    if (status) return status;
  }
  return 0;
}

static int mdl_initial_system(mdl_data *m, double t) {
  const double pre_x_2 = m->x[0];
  /* Sampler.mo:6  start of x */
  const double x_2 = pre_x_2;
  m->x[0] = x_2;
  return mdl_rhs(m, t, m->x, m->xdot, m->v);
}

static int mdl_residual(mdl_data *m, double t, const double *y, const double *yp, double *r) {
  (void)t;
  const double u = m->d[0];
  const double rate = m->p[1];
  const double x_2 = y[0];
  const double der_x_2 = yp[0];
  /* Sampler.mo:10  der(x) = rate*(u - x) */
  r[0] = der_x_2 - rate * (u - x_2);
  return 0;
}

static int mdl_jacobian(mdl_data *m, double t, const double *y, const double *yp, double cj, double *values) {
  (void)t;
  (void)y;
  (void)yp;
  const double rate = m->p[1];
  values[0] = cj + rate;
  return 0;
}

static int mdl_roots(mdl_data *m, double t, const double *x, const double *xdot, const double *v, double *g) {
  (void)m;
  (void)t;
  (void)xdot;
  (void)v;
  const double x_2 = x[0];
  g[0] = x_2 - 0.7;  /* Sampler.mo:11  x > 0.7 */
  g[1] = 0.2 - x_2;  /* Sampler.mo:16  x < 0.2 */
  return 0;
}

static int mdl_time_relations(mdl_data *m, double t) {
  (void)m;
  (void)t;
  return 0;
}

static double mdl_next_time_event(const mdl_data *m, double t) {
  (void)m;
  (void)t;
  double next = INFINITY;
  return next;
}

static int mdl_event(mdl_data *m, double t, double *x, const double *xdot, const double *v) {
  (void)t;
  (void)xdot;
  (void)v;
  const double gain = m->p[2];
  const int rel0 = m->rel[0];
  const int rel1 = m->rel[1];
  const int tick0 = m->tick[0];
  const double x_2 = x[0];
  /* Sampler.mo:11  high = x > 0.7 */
  const int high = rel0;
  /* Sampler.mo:12  when */
  double u = m->pre_d[0];
  const int when0 = tick0;
  if (when0 && !m->when[0] && !m->initial) {
    u = gain * (1.0 - x_2);
  }
  m->when[0] = (unsigned char)when0;
  /* Sampler.mo:15  algorithm */
  double n = m->pre_d[1];
  const int when1 = high;
  const int when2 = rel1 && n > 10.0;
  if (when1 && !m->when[1] && !m->initial) {
    n = n + 1.0;
    if (!(n < 100.0)) {
      (void)mdl_fail(m, MDL_FAILURE_ASSERT, 1, 0.0);
      return -1;
    }
  }
  else if (when2 && !m->when[2] && !m->initial) {
    n = 0.0;
  }
  m->when[1] = (unsigned char)when1;
  m->when[2] = (unsigned char)when2;
  m->d[2] = high;
  m->d[0] = u;
  m->d[1] = n;
  return 0;
}

static int mdl_check(mdl_data *m, double t, const double *x, const double *xdot, const double *v) {
  (void)m;
  (void)t;
  (void)x;
  (void)xdot;
  (void)v;
  return 0;
}

static int mdl_nominals(mdl_data *m, double *nominal) {
  (void)m;
  nominal[0] = 0.2;
  nominal[1] = 0.7;
  nominal[2] = 0.2;
  return 0;
}

static int mdl_divisions(mdl_data *m, double t, const double *x, const double *xdot, const double *v, double *value) {
  (void)m;
  (void)t;
  (void)x;
  (void)xdot;
  (void)v;
  (void)value;
  return 0;
}

static int mdl_guard_rates(mdl_data *m, double t, const double *x, double *g) {
  (void)m;
  (void)t;
  const double x_2 = x[0];
  g[0] = x_2;  /* Sampler.mo:11  x > 0.7 */
  g[1] = -x_2;  /* Sampler.mo:16  x < 0.2 */
  return 0;
}

static const mdl_descriptor mdl_model = {
  .abi_version = MDL_ABI_VERSION,
  .name = "Sampler",
  .hash = "",
  .jac_nnz = 1,
  .n_asserts = 2,
  .n_computed = 1,
  .n_d = 3,
  .n_divisions = 0,
  .n_equations = 1,
  .n_messages = 0,
  .n_p = 3,
  .n_rel = 2,
  .n_sample = 1,
  .n_u = 0,
  .n_v = 0,
  .n_variables = 7,
  .n_when = 3,
  .n_x = 1,
  .n_z = 0,
  .variables = mdl_variables,
  .equations = mdl_equations,
  .asserts = mdl_asserts,
  .relations = mdl_relations,
  .messages = NULL,
  .z_index = NULL,
  .z_branches = NULL,
  .residual_equation = mdl_residual_equation,
  .p_start = mdl_p_start,
  .start_time = 0.0,
  .stop_time = 1.0,
  .tolerance = 1e-06,
  .interval = 0.0,
  .jac_colptr = mdl_jac_colptr,
  .jac_rowidx = mdl_jac_rowidx,
  .computed = mdl_computed_by,
  .equation_first = mdl_equation_first,
  .equation_variables = mdl_equation_variables,
  .division_equation = NULL,
  .starts = mdl_starts,
  .parameters = mdl_parameters,
  .samples = mdl_samples,
  .initial_system = mdl_initial_system,
  .rhs = mdl_rhs,
  .residual = mdl_residual,
  .jacobian = mdl_jacobian,
  .roots = mdl_roots,
  .time_relations = mdl_time_relations,
  .next_time_event = mdl_next_time_event,
  .event = mdl_event,
  .nominals = mdl_nominals,
  .divisions = mdl_divisions,
  .affine_guards = mdl_affine_guards,
  .guard_rates = mdl_guard_rates,
  .least_sizes = mdl_least_sizes,
  .check = mdl_check,
  .stages = mdl_stages,
};

const mdl_descriptor *mdl_descriptor_get(void);

const mdl_descriptor *mdl_descriptor_get(void) { return &mdl_model; }
