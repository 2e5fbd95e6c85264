/* Shaft: generated from
 *   Shaft.mo  sha256 4c10dce42d715c8ccc037fbde8f169032c84d7bf347dbe36ef27eb0767ecfb69
 * Do not edit: edit the model. */
#include "mdl_abi.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

static const mdl_variable mdl_variables[] = {
  {"J1", "kg.m2", "", "Shaft.mo", 2, MDL_REAL, MDL_PARAMETER, 0, 1, 1, 0, 2.0, 1e-09, INFINITY, 0.0, "", 1},
  {"J2", "kg.m2", "", "Shaft.mo", 3, MDL_REAL, MDL_PARAMETER, 1, 1, 1, 0, 3.0, -INFINITY, INFINITY, 0.0, "", 1},
  {"ratio", "", "", "Shaft.mo", 4, MDL_REAL, MDL_PARAMETER, 2, 1, 1, 0, 4.0, -INFINITY, INFINITY, 0.0, "1", 1},
  {"k", "N.m.s", "Gain of the speed loop", "Shaft.mo", 5, MDL_REAL, MDL_PARAMETER, 3, 1, 1, 0, 5.0, -INFINITY, INFINITY, 0.0, "", 1},
  {"tau_max", "N.m", "", "Shaft.mo", 6, MDL_REAL, MDL_PARAMETER, 4, 1, 1, 0, 10.0, -INFINITY, INFINITY, 0.0, "", 1},
  {"w_ref", "1/s", "", "Shaft.mo", 7, MDL_REAL, MDL_PARAMETER, 5, 1, 1, 0, 1.0, -INFINITY, INFINITY, 0.0, "", 1},
  {"phi1", "", "", "Shaft.mo", 8, MDL_REAL, MDL_STATE, 0, 1, 0, 0, 0.0, -INFINITY, INFINITY, 0.0, "1", 0},
  {"phi2", "", "", "Shaft.mo", 9, MDL_REAL, MDL_ALGEBRAIC, 0, 1, 0, 0, 0.0, -INFINITY, INFINITY, 0.0, "1", 0},
  {"w1", "1/s", "", "Shaft.mo", 10, MDL_REAL, MDL_STATE, 1, 1, 0, 0, 0.0, -INFINITY, INFINITY, 0.0, "", 0},
  {"w2", "1/s", "", "Shaft.mo", 11, MDL_REAL, MDL_ALGEBRAIC, 1, 1, 0, 0, 0.0, -INFINITY, INFINITY, 0.0, "", 0},
  {"drive", "N.m", "", "Shaft.mo", 12, MDL_REAL, MDL_ALGEBRAIC, 2, 1, 0, 0, 0.0, -INFINITY, INFINITY, 0.0, "", 0},
  {"tau", "N.m", "", "Shaft.mo", 13, MDL_REAL, MDL_ALGEBRAIC, 3, 1, 0, 0, 0.0, -INFINITY, INFINITY, 0.0, "", 0}
};

static const mdl_relation mdl_relations[] = {
  {{"k * (w_ref - w1) > tau_max in min(k * (w_ref - w1), tau_max)", "Shaft.mo", 18, ""}, 4}
};

static const int mdl_residual_equation[] = {
  0,
  2
};

static const double mdl_p_start[] = {
  2.0,
  3.0,
  4.0,
  5.0,
  10.0,
  1.0,
  0.25,
  0.3333333333333333
};

static const int mdl_jac_colptr[] = {
  0,
  1,
  3
};

static const int mdl_jac_rowidx[] = {
  0,
  0,
  1
};

static const mdl_equation mdl_equations[] = {
  {"w1 = der(phi1)", "Shaft.mo", 15, ""},
  {"w2 = der(phi2)", "Shaft.mo", 16, ""},
  {"phi1 = ratio*phi2", "Shaft.mo", 17, ""},
  {"drive = min(k*(w_ref - w1), tau_max)", "Shaft.mo", 18, ""},
  {"J1*der(w1) = drive - tau", "Shaft.mo", 19, ""},
  {"J2*der(w2) = ratio*tau", "Shaft.mo", 20, ""},
  {"inverse of ratio = 1.0 / ratio", "Shaft.mo", 1, ""},
  {"inverse of J2 = 1.0 / J2", "Shaft.mo", 1, ""}
};

static const mdl_computed mdl_computed_by[] = {
  {MDL_PARAMETER, 6, 6},
  {MDL_PARAMETER, 7, 7},
  {MDL_DERIVATIVE, 0, 0},
  {MDL_ALGEBRAIC, 5, 2},
  {MDL_ALGEBRAIC, 1, 1},
  {MDL_ALGEBRAIC, 0, 2},
  {MDL_ALGEBRAIC, 2, 3},
  {MDL_DERIVATIVE, 1, 2},
  {MDL_ALGEBRAIC, 3, 4},
  {MDL_ALGEBRAIC, 4, 0},
  {MDL_ALGEBRAIC, 7, 5},
  {MDL_ALGEBRAIC, 6, 1}
};

static const int mdl_equation_first[] = {
  0,
  1,
  2,
  5,
  10,
  13,
  16,
  17,
  18
};

static const int mdl_equation_variables[] = {
  8,
  9,
  6,
  7,
  2,
  10,
  3,
  4,
  8,
  5,
  0,
  10,
  11,
  1,
  2,
  11,
  2,
  1
};

static const unsigned char mdl_affine_guards[] = {
  1
};

static int mdl_fail(mdl_data *m, mdl_failure_kind kind, int equation, double value) {
  m->failure = (mdl_failure){kind, equation, -1, value, 0.0};
  return 1;
}

static int mdl_parameters(mdl_data *m) {
  const double J1 = m->p[0];
  const double J2 = m->p[1];
  const double ratio = m->p[2];
  /* Shaft.mo:1  inverse of ratio = 1.0 / ratio */
  const double inverse_of_ratio = 1.0 / ratio;
  m->p[6] = inverse_of_ratio;
  /* Shaft.mo:1  inverse of J2 = 1.0 / J2 */
  const double inverse_of_J2 = 1.0 / J2;
  m->p[7] = inverse_of_J2;
  if (!(J1 >= 1e-09)) {
    m->failure = (mdl_failure){MDL_FAILURE_BOUND, -1, 0, J1, 1e-09};
    return -1;
  }
  return 0;
}

static int mdl_starts(mdl_data *m) {
  m->x[0] = 0.0;
  m->x[1] = 0.0;
  return 0;
}

static int mdl_samples(const mdl_data *m, double *start, double *interval) {
  (void)m;
  (void)start;
  (void)interval;
  return 0;
}

static inline __attribute__((always_inline)) int mdl_explicit(mdl_data *m, double t, const double *x, double *xdot, double *v) {
  (void)t;
  const double J1 = m->p[0];
  const double ratio = m->p[2];
  const double k = m->p[3];
  const double tau_max = m->p[4];
  const double w_ref = m->p[5];
  const double inverse_of_ratio = m->p[6];
  const double inverse_of_J2 = m->p[7];
  const int rel0 = m->rel[0];
  const double phi1 = x[0];
  const double w1 = x[1];
  /* Shaft.mo:15  w1 = der(phi1) */
  const double der_phi1 = w1;
  /* Shaft.mo:18  drive = min(k*(w_ref - w1), tau_max) */
  const double drive = !rel0 ? k * (w_ref - w1) : tau_max;
  /* linear block of 5, torn to 1 */
  /* Shaft.mo:17  dd/dtdt of phi1 = ratio*phi2 */
  const double der_w1_divisor = 1.0 + ratio * (ratio * J1 * inverse_of_J2);
  const double der_w1_inverse = 1.0 / der_w1_divisor;
  double der_w1 = ratio * (ratio * drive * inverse_of_J2);
  if (der_w1_divisor != 0.0) der_w1 *= der_w1_inverse;
  else if (der_w1 != 0.0) return mdl_fail(m, MDL_FAILURE_SINGULAR, 2, 0.0);
  else {
    const double tmp1 = fabs(k) * fabs(w_ref) / fabs(J1);
    der_w1 = m->shift * (tmp1 > 0.0 ? tmp1 : 2.5);
    m->undetermined = 3;
  }
  /* Shaft.mo:19  J1*der(w1) = drive - tau */
  const double tau = drive - J1 * der_w1;
  /* Shaft.mo:15  d/dt of w1 = der(phi1) */
  const double der_der_phi1_ = der_w1;
  /* Shaft.mo:20  J2*der(w2) = ratio*tau */
  const double der_w2_ = ratio * tau * inverse_of_J2;
  /* Shaft.mo:16  d/dt of w2 = der(phi2) */
  const double der_der_phi2_ = der_w2_;
  xdot[0] = der_phi1;
  xdot[1] = der_w1;
  if (!m->brief) {
    /* Shaft.mo:17  d/dt of phi1 = ratio*phi2 */
    const double der_phi2_ = der_phi1 * inverse_of_ratio;
    /* Shaft.mo:16  w2 = der(phi2) */
    const double w2 = der_phi2_;
    /* Shaft.mo:17  phi1 = ratio*phi2 */
    const double phi2 = phi1 * inverse_of_ratio;
    v[5] = der_phi2_;
    v[1] = w2;
    v[0] = phi2;
    v[2] = drive;
    v[3] = tau;
    v[4] = der_der_phi1_;
    v[7] = der_w2_;
    v[6] = der_der_phi2_;
  }
  return 0;
}

static int mdl_rhs(mdl_data *m, double t, const double *x, double *xdot, double *v) {
  return mdl_explicit(m, t, x, xdot, v);
}

static int mdl_stages(mdl_data *m, const mdl_scheme *scheme, double t, double h, const double *x, double *restrict k,
                      double *restrict end, double *restrict v) {
  enum { N = 2 };
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
  const double pre_phi1 = m->x[0];
  const double pre_w1 = m->x[1];
  /* Shaft.mo:10  start of w1 */
  const double w1 = pre_w1;
  /* Shaft.mo:8  start of phi1 */
  const double phi1 = pre_phi1;
  m->x[1] = w1;
  m->x[0] = phi1;
  return mdl_rhs(m, t, m->x, m->xdot, m->v);
}

static int mdl_residual(mdl_data *m, double t, const double *y, const double *yp, double *r) {
  (void)t;
  const double J1 = m->p[0];
  const double J2 = m->p[1];
  const double ratio = m->p[2];
  const double k = m->p[3];
  const double tau_max = m->p[4];
  const double w_ref = m->p[5];
  const int rel0 = m->rel[0];
  const double w1 = y[1];
  const double der_phi1 = yp[0];
  const double der_w1 = yp[1];
  /* Shaft.mo:18  drive = min(k*(w_ref - w1), tau_max) */
  const double drive = !rel0 ? k * (w_ref - w1) : tau_max;
  /* Shaft.mo:19  J1*der(w1) = drive - tau */
  const double tau = drive - J1 * der_w1;
  /* Shaft.mo:15  d/dt of w1 = der(phi1) */
  const double der_der_phi1_ = der_w1;
  /* Shaft.mo:20  J2*der(w2) = ratio*tau */
  const double der_w2_ = ratio * tau / J2;
  /* Shaft.mo:16  d/dt of w2 = der(phi2) */
  const double der_der_phi2_ = der_w2_;
  /* Shaft.mo:15  w1 = der(phi1) */
  r[0] = w1 - der_phi1;
  /* Shaft.mo:17  dd/dtdt of phi1 = ratio*phi2 */
  r[1] = der_der_phi1_ - ratio * der_der_phi2_;
  return 0;
}

static int mdl_jacobian(mdl_data *m, double t, const double *y, const double *yp, double cj, double *values) {
  (void)t;
  (void)y;
  (void)yp;
  const double J1 = m->p[0];
  const double J2 = m->p[1];
  const double ratio = m->p[2];
  const double k = m->p[3];
  const int rel0 = m->rel[0];
  const double d_drive_d_w1 = !rel0 ? -k : 0.0;
  const double d_tau_d_w1 = d_drive_d_w1 - J1 * cj;
  const double d_der_w2_d_w1 = ratio * d_tau_d_w1 / J2;
  values[0] = -cj;
  values[1] = 1.0;
  values[2] = cj - ratio * d_der_w2_d_w1;
  return 0;
}

static int mdl_roots(mdl_data *m, double t, const double *x, const double *xdot, const double *v, double *g) {
  (void)t;
  (void)xdot;
  (void)v;
  const double k = m->p[3];
  const double tau_max = m->p[4];
  const double w_ref = m->p[5];
  const double w1 = x[1];
  g[0] = k * (w_ref - w1) - tau_max;  /* Shaft.mo:18  k * (w_ref - w1) > tau_max in min(k * (w_ref - w1), tau_max) */
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
  (void)m;
  (void)t;
  (void)x;
  (void)xdot;
  (void)v;
  return 0;
}

static int mdl_nominals(mdl_data *m, double *nominal) {
  const double tau_max = m->p[4];
  const double w_ref = m->p[5];
  const double tmp1 = fabs(w_ref);
  const double tmp2 = tmp1 > 0.0 ? tmp1 : 1.0;
  nominal[0] = tmp2;
  nominal[1] = tmp2;
  const double tmp3 = fabs(tau_max);
  nominal[2] = tmp3 > 0.0 ? tmp3 : 10.0;
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
  (void)t;
  const double k = m->p[3];
  const double w1 = x[1];
  g[0] = -(k * w1);  /* Shaft.mo:18  k * (w_ref - w1) > tau_max in min(k * (w_ref - w1), tau_max) */
  return 0;
}

static const mdl_descriptor mdl_model = {
  .abi_version = MDL_ABI_VERSION,
  .name = "Shaft",
  .hash = "",
  .jac_nnz = 3,
  .n_asserts = 0,
  .n_computed = 12,
  .n_d = 0,
  .n_divisions = 0,
  .n_equations = 8,
  .n_messages = 0,
  .n_p = 8,
  .n_rel = 1,
  .n_sample = 0,
  .n_u = 0,
  .n_v = 8,
  .n_variables = 12,
  .n_when = 0,
  .n_x = 2,
  .n_z = 0,
  .variables = mdl_variables,
  .equations = mdl_equations,
  .asserts = NULL,
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
  .stages = mdl_stages,
};

const mdl_descriptor *mdl_descriptor_get(void);

const mdl_descriptor *mdl_descriptor_get(void) { return &mdl_model; }
