/* RODAS: a stiffly accurate, L-stable Rosenbrock method of order 4(3) with six stages, for stiff models.
 * Hairer & Wanner, Solving Ordinary Differential Equations II, IV.7 and VI.4; dense output of order 3 from there.
 *
 * The stages are (I / (h gamma) - J) k = r with the Jacobian J = df/dx of the explicit form. J is never formed: the
 * residual form F(t, [x; z], x') = 0 gives J = -[F_x' F_z]^-1 F_x for its first rows, so that multiplying a stage by
 * F_x' leaves [F_x + F_x' / (h gamma)  F_z] [k; .] = F_x' r, whose matrix is the analytic Jacobian of the residual form
 * with c_j = 1 / (h gamma). */
#include <math.h>
#include <string.h>

#include "onestep.h"
#include "sparse.h"
#include "undetermined.h"

enum {
  STAGES = 6,
  DENSE_LIMIT = 40, /* unknowns up to which, of a ladder, a dense matrix is faster than KLU */
  STIFF = 100       /* 2^STIFF: rates in a step beside which dF/dy' keeps its digits */
};

static const double gamma_ = 0.25;
static const double alpha[STAGES] = {0, 0.386, 0.21, 0.63, 1, 1};
static const double d[STAGES] = {0.25, -0.1043, 0.1035, -0.3620000000000023e-01, 0, 0};
static const double a[STAGES][STAGES - 1] = {
    {0},
    {0.1544000000000000e+01},
    {0.9466785280815826e+00, 0.2557011698983284e+00},
    {0.3314825187068521e+01, 0.2896124015972201e+01, 0.9986419139977817e+00},
    {0.1221224509226641e+01, 0.6019134481288629e+01, 0.1253708332932087e+02, -0.6878860361058950e+00},
    {0.1221224509226641e+01, 0.6019134481288629e+01, 0.1253708332932087e+02, -0.6878860361058950e+00, 1}};
static const double c[STAGES][STAGES - 1] = {
    {0},
    {-0.5668800000000000e+01},
    {-0.2430093356833875e+01, -0.2063599157091915e+00},
    {-0.1073529058151375e+00, -0.9594562251023355e+01, -0.2047028614809616e+02},
    {0.7496443313967647e+01, -0.1024680431464352e+02, -0.3399990352819905e+02, 0.1170890893206160e+02},
    {0.8083246795921522e+01, -0.7981132988064893e+01, -0.3152159432874371e+02, 0.1631930543123136e+02,
     -0.6058818238834054e+01}};
static const double d2[STAGES - 1] = {0.1012623508344586e+02, -0.7487995877610167e+01, -0.3480091861555747e+02,
                                      -0.7992771707568823e+01, 0.1025137723295662e+01};
static const double d3[STAGES - 1] = {-0.6762803392806898e+00, 0.6087714651680015e+01, 0.1643084320892478e+02,
                                      0.2476722511418386e+02, -0.6594389125716872e+01};

typedef struct {
  double *fy, *fyp; /* [jac_nnz] dF/dy and dF/dy' at the start of the step */
  double *values;   /* [jac_nnz] of the matrix of the stages */
  double *matrix;   /* [n * n] factored, n = n_x + n_z; of few unknowns, else */
  rt_sparse *sparse;
  double *right; /* [n] */
  double *dfdt;  /* [n_x] */
  double *row;   /* [n] powers of two that give the rows of the matrix size 1, in units of the unknowns' sizes */
  int *pivot;    /* [n] */
  double t;      /* where fy, fyp and dfdt were computed */
  bool known;    /* whether they were, in this run */
} work;

static bool is_sparse(const mdl_descriptor *m) {
  return rt_has_sparse && m->n_x + m->n_z > DENSE_LIMIT;
}

static size_t work_size(const mdl_descriptor *m) {
  size_t n_x = (size_t)m->n_x, n = n_x + (size_t)m->n_z;
  size_t numbers = 3 * (size_t)m->jac_nnz + (is_sparse(m) ? 0 : n * n) + 2 * n + n_x;
  return sizeof(work) + numbers * sizeof(double) + n * sizeof(int);
}

static work *layout(const rt_session *s, void *memory) {
  size_t n_x = (size_t)s->d->n_x, n = n_x + (size_t)s->d->n_z, nnz = (size_t)s->d->jac_nnz;
  work *w = memory;
  w->fy = (double *)(w + 1);
  w->fyp = w->fy + nnz;
  w->values = w->fyp + nnz;
  w->right = w->values + nnz;
  w->dfdt = w->right + n;
  w->row = w->dfdt + n_x;
  w->matrix = w->row + n;
  w->pivot = (int *)(w->matrix + (is_sparse(s->d) ? 0 : n * n));
  return w;
}

/* dF/dy and dF/dy' at the start of the step: the generated Jacobian is linear in c_j. A c_j far above what the step has
 * (1/s) loses no digits of dF/dy' beside a dF/dy that is stiff, and a power of two rounds nothing. */
static int differentiate(rt_session *s, work *w, double h) {
  const mdl_descriptor *m = s->d;
  int status, exponent;
  frexp(1 / (h * gamma_), &exponent);
  exponent += exponent < 500 ? STIFF : 0;
  double cj = ldexp(1, exponent), per_cj = ldexp(1, -exponent);
  rt_residual_point(s);
  rt_inputs_at(s, s->t);
  s->result->counters.jacobians++;
  if ((status = rt_jacobian(s, s->t, s->y, s->yp, 0, w->fy)) ||
      (status = rt_jacobian(s, s->t, s->y, s->yp, cj, w->fyp)))
    return status;
  for (int k = 0; k < m->jac_nnz; k++)
    w->fyp[k] = (w->fyp[k] - w->fy[k]) * per_cj;
  return 0;
}

/* Partial derivative of f with respect to time, by a forward difference well inside the step, over what time as it is
 * rounded has moved. */
static int differentiate_time(rt_session *s, rt_onestep *o, work *w, double h) {
  double t = o->t0 + rt_max(1e-4 * h, rt_min(h, rt_time_resolution(s))), delta = t - o->t0;
  memcpy(s->v_trial, s->data.v, (size_t)s->d->n_v * sizeof *s->v_trial);
  int status = rt_rhs(s, t, o->x0, w->dfdt, s->v_trial);
  for (int i = 0; i < s->d->n_x; i++)
    w->dfdt[i] = delta > 0 ? (w->dfdt[i] - o->f0[i]) / delta : 0;
  return status;
}

static int factor_dense(const rt_session *s, work *w) {
  const mdl_descriptor *m = s->d;
  int n = m->n_x + m->n_z;
  memset(w->matrix, 0, (size_t)(n * n) * sizeof *w->matrix);
  for (int j = 0; j < n; j++)
    for (int k = m->jac_colptr[j]; k < m->jac_colptr[j + 1]; k++)
      w->matrix[j * n + m->jac_rowidx[k]] = w->row[m->jac_rowidx[k]] * w->values[k];
  for (int k = 0; k < s->n_held; k++)
    w->matrix[s->held[k].column * n + s->held[k].row] += w->row[s->held[k].row] * s->held[k].value;
  return rt_lu_factor(n, w->matrix, w->pivot);
}

static int factor(rt_session *s, work *w, double h) {
  double cj = 1 / (h * gamma_);
  for (int k = 0; k < s->d->jac_nnz; k++)
    w->values[k] = w->fy[k] + cj * w->fyp[k];
  rt_row_factors(s, w->values, w->row);
  int singular = w->sparse ? rt_sparse_factor(s, w->sparse, w->values, w->row) : factor_dense(s, w);
  if (!singular) return 0;
  s->data.failure = (mdl_failure){MDL_FAILURE_SINGULAR, -1, rt_unknown_variable(s, singular - 1), 0, 0};
  return 1;
}

static int prepare(rt_session *s, rt_onestep *o, work *w, double h) {
  int status;
  if (!w->known || w->t != o->t0) {
    w->known = false;
    if ((status = differentiate(s, w, h)) || (status = differentiate_time(s, o, w, h))) return status;
    w->t = o->t0;
    w->known = true;
  }
  return factor(s, w, h);
}

/* k := solution of the stage with right side k. */
static void solve(const rt_session *s, work *w, double *k) {
  const mdl_descriptor *m = s->d;
  int n_x = m->n_x, n = n_x + m->n_z;
  memset(w->right, 0, (size_t)n * sizeof *w->right);
  for (int j = 0; j < n_x; j++)
    for (int l = m->jac_colptr[j]; l < m->jac_colptr[j + 1]; l++)
      w->right[m->jac_rowidx[l]] += w->fyp[l] * k[j];
  for (int i = 0; i < n; i++)
    w->right[i] *= w->row[i];
  if (w->sparse)
    rt_sparse_solve(w->sparse, w->right);
  else
    rt_lu_solve(n, w->matrix, w->pivot, w->right);
  memcpy(k, w->right, (size_t)n_x * sizeof *k);
}

/* The matrix of the last step serves inside it. */
static void filter(rt_session *s, void *memory, double t, double *defect) {
  const rt_onestep *o = memory;
  (void)t;
  solve(s, layout(s, o->work), defect);
  for (int i = 0; i < s->d->n_x; i++)
    defect[i] /= o->h * gamma_;
}

static int attempt(rt_session *s, rt_onestep *o, double h) {
  int n = s->d->n_x;
  work *w = layout(s, o->work);
  int status = prepare(s, o, w, h);
  if (status) return status;
  for (int j = 0; j < STAGES; j++) {
    double *k = o->k + j * n;
    const double *x = rt_stage(o, 1, s->d->n_x, j, a[j]);
    if (j == 0)
      memcpy(k, o->f0, (size_t)n * sizeof *k);
    else if ((status = rt_derivatives(s, o->t0 + alpha[j] * h, x, k, s->data.v)))
      return status;
    for (int i = 0; i < n; i++) {
      double sum = 0;
      for (int l = 0; l < j; l++)
        sum += c[j][l] * o->k[l * n + i];
      k[i] += sum / h + h * d[j] * w->dfdt[i];
    }
    solve(s, w, k);
  }
  for (int i = 0; i < n; i++) {
    o->error[i] = o->k[(STAGES - 1) * n + i];
    o->x1[i] += o->error[i];
  }
  return rt_rhs(s, o->t0 + h, o->x1, o->f1, s->data.v);
}

/* x0 (1 - s) + s (x1 + (1 - s) (r2 + s r3)), expanded in powers of s. */
static void dense(int n, const rt_onestep *o, rt_dense *out) {
  out->degree = 3;
  for (int i = 0; i < n; i++) {
    double r2 = 0, r3 = 0;
    for (int j = 0; j < STAGES - 1; j++) {
      r2 += d2[j] * o->k[j * n + i];
      r3 += d3[j] * o->k[j * n + i];
    }
    out->c[i] = o->x0[i];
    out->c[n + i] = o->x1[i] - o->x0[i] + r2;
    out->c[2 * n + i] = r3 - r2;
    out->c[3 * n + i] = -r3;
  }
}

static const rt_scheme scheme = {.stages = STAGES,
                                 .order = 4,
                                 .min_factor = 0.2,
                                 .max_factor = 6,
                                 .work_size = work_size,
                                 .attempt = attempt,
                                 .dense = dense};

static void destroy(void *memory) {
  rt_sparse_free(((work *)((rt_onestep *)memory)->work)->sparse);
  rt_onestep_destroy(memory);
}

static void *create(rt_session *s) {
  rt_onestep *o = rt_onestep_create(s, &scheme);
  if (!o || !is_sparse(s->d)) return o;
  if ((((work *)o->work)->sparse = rt_sparse_new(s))) return o;
  destroy(o);
  return NULL;
}

static rt_status begin(rt_session *s, void *memory) {
  rt_onestep *o = memory;
  ((work *)o->work)->known = false;
  return rt_onestep_begin(s, memory);
}

const rt_method rt_method_rodas4 = {
    .name = "rodas4",
    .create = create,
    .destroy = destroy,
    .begin = begin,
    .restart = rt_onestep_restart,
    .step = rt_onestep_step,
    .dense = rt_onestep_dense,
    .count = rt_onestep_count,
    .errors = rt_onestep_errors,
    .filter = filter,
};
