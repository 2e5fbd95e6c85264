/* Diode: generated from
 *   Diode.mo  sha256 969152f98ee883e40d11b6d751fe55022a837a19c084de58f5d12601fd5d6e29
 * Do not edit: edit the model. */
#include "mdl_abi.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

static const mdl_variable mdl_variables[] = {
  {"R", "Ohm", "", "Diode.mo", 2, MDL_REAL, MDL_PARAMETER, 0, 1, 1, 0, 100.0, -INFINITY, INFINITY, 0.0, "", 1},
  {"C", "F", "", "Diode.mo", 3, MDL_REAL, MDL_PARAMETER, 1, 1, 1, 0, 1e-05, -INFINITY, INFINITY, 0.0, "", 1},
  {"I_s", "A", "", "Diode.mo", 4, MDL_REAL, MDL_PARAMETER, 2, 1, 1, 0, 1e-09, -INFINITY, INFINITY, 0.0, "", 1},
  {"V_t", "V", "", "Diode.mo", 5, MDL_REAL, MDL_PARAMETER, 3, 1, 1, 0, 0.025, -INFINITY, INFINITY, 0.0, "", 1},
  {"U", "V", "", "Diode.mo", 6, MDL_REAL, MDL_PARAMETER, 4, 1, 1, 0, 5.0, -INFINITY, INFINITY, 0.0, "", 1},
  {"T", "s", "", "Diode.mo", 7, MDL_REAL, MDL_PARAMETER, 5, 1, 1, 0, 0.01, -INFINITY, INFINITY, 0.0, "", 1},
  {"u", "V", "", "Diode.mo", 8, MDL_REAL, MDL_ALGEBRAIC, 0, 1, 0, 0, 0.0, -INFINITY, INFINITY, 0.0, "", 0},
  {"v", "V", "", "Diode.mo", 9, MDL_REAL, MDL_ALGEBRAIC, 1, 1, 0, 0, 0.0, -INFINITY, INFINITY, 0.0, "", 0},
  {"i", "A", "", "Diode.mo", 10, MDL_REAL, MDL_ALGEBRAIC, 2, 1, 0, 0, 0.0, -INFINITY, INFINITY, 0.0, "", 0},
  {"u_C", "V", "", "Diode.mo", 11, MDL_REAL, MDL_STATE, 0, 1, 0, 0, 0.0, -INFINITY, INFINITY, 0.0, "", 0}
};

static const mdl_relation mdl_relations[] = {
  {{"time < T", "Diode.mo", 13, ""}, 5}
};

static const int mdl_z_index[] = {
  1
};

static const unsigned char mdl_z_branches[] = {
  1
};

static const mdl_computed mdl_branches[] = {
  {MDL_ALGEBRAIC, 1, 1}
};

static const int mdl_residual_equation[] = {
  1,
  2
};

static const double mdl_p_start[] = {
  100.0,
  1e-05,
  1e-09,
  0.025,
  5.0,
  0.01,
  40.0,
  99999.99999999999
};

static const int mdl_jac_colptr[] = {
  0,
  2,
  4
};

static const int mdl_jac_rowidx[] = {
  0,
  1,
  0,
  1
};

static const mdl_equation mdl_equations[] = {
  {"u = if time < T then U else -U", "Diode.mo", 13, ""},
  {"u = R*i + v + u_C", "Diode.mo", 14, ""},
  {"i = I_s*(exp(v/V_t) - 1)", "Diode.mo", 15, ""},
  {"C*der(u_C) = i", "Diode.mo", 16, ""},
  {"inverse of V_t = 1.0 / V_t", "Diode.mo", 1, ""},
  {"inverse of C = 1.0 / C", "Diode.mo", 1, ""}
};

static const mdl_computed mdl_computed_by[] = {
  {MDL_PARAMETER, 6, 4},
  {MDL_PARAMETER, 7, 5},
  {MDL_ALGEBRAIC, 0, 0},
  {MDL_ALGEBRAIC, 1, 1},
  {MDL_ALGEBRAIC, 2, 2},
  {MDL_DERIVATIVE, 0, 3}
};

static const int mdl_equation_first[] = {
  0,
  2,
  7,
  11,
  13,
  14,
  15
};

static const int mdl_equation_variables[] = {
  4,
  6,
  0,
  8,
  6,
  9,
  7,
  2,
  3,
  8,
  7,
  1,
  8,
  3,
  1
};

static int mdl_fail(mdl_data *m, mdl_failure_kind kind, int equation, double value) {
  m->failure = (mdl_failure){kind, equation, -1, value, 0.0};
  return 1;
}

/* Solve a x = b in place (row-major, n x n) by Gaussian elimination with scaled partial pivoting; b becomes x. Where a
 * is singular to working precision, 1 + the unknown that it does not determine: rows and columns have no scale. b has
 * 2 n places: behind the right sides come the sizes of what is summed up in them. A row that makes place for another
 * changes its sign, so that the determinant stays: its sign is that of the product of the diagonal. */
static int mdl_solve(int n, double *a, double *b) {
  double size[n];
  for (int i = 0; i < n; ++i) {
    double largest = 0.0;
    for (int j = 0; j < n; ++j)
      if (fabs(a[i * n + j]) > largest) largest = fabs(a[i * n + j]);
    const double scale = largest > 0.0 ? 1.0 / largest : 1.0;
    for (int j = 0; j < n; ++j) a[i * n + j] *= scale;
    b[i] *= scale;
    b[n + i] = fabs(b[i]);
  }
  for (int j = 0; j < n; ++j) {
    size[j] = 0.0;
    for (int i = 0; i < n; ++i)
      if (fabs(a[i * n + j]) > size[j]) size[j] = fabs(a[i * n + j]);
  }
  for (int k = 0; k < n; ++k) {
    int pivot = k;
    for (int i = k + 1; i < n; ++i)
      if (fabs(a[i * n + k]) > fabs(a[pivot * n + k])) pivot = i;
    if (!(fabs(a[pivot * n + k]) > 1e-14 * size[k])) return 1 + k;
    if (pivot != k) {
      for (int j = k; j < n; ++j) {
        const double swap = a[k * n + j];
        a[k * n + j] = a[pivot * n + j];
        a[pivot * n + j] = -swap;
      }
      for (int j = 0; j < 2; ++j) {
        const double swap = b[j * n + k];
        b[j * n + k] = b[j * n + pivot];
        b[j * n + pivot] = j == 0 ? -swap : swap;
      }
    }
    for (int i = k + 1; i < n; ++i) {
      const double factor = a[i * n + k] / a[k * n + k];
      if (factor == 0.0) continue;
      for (int j = k + 1; j < n; ++j) a[i * n + j] -= factor * a[k * n + j];
      b[i] -= factor * b[k];
      b[n + i] += fabs(factor) * b[n + k];
    }
  }
  for (int i = n - 1; i >= 0; --i) {
    for (int j = i + 1; j < n; ++j) b[i] -= a[i * n + j] * b[j];
    b[i] /= a[i * n + i];
  }
  return 0;
}

enum { MDL_DAMPED, MDL_SEARCH, MDL_BRACKET, MDL_FOLLOW, MDL_SOLVED, MDL_FAILED };
enum { MDL_ITERATIONS = 50, MDL_CORRECTIONS = 10, MDL_HALVINGS = 12, MDL_DOUBLINGS = 100, MDL_LOOKS = 1000 };
enum { MDL_FIRST_LIMIT = 32, MDL_LAST_LIMIT = 256 }; /* of exponents, whose squares are numbers still */

/* A nonlinear block of n unknowns x. `work` holds 4 n numbers: the start, the last step, the weights of the residuals
 * or, where a path is followed, the residual at the start, and the last point of the path. */
typedef struct {
  int n;
  double *x, *work;
  const double *nominal; /* sizes of the unknowns */
  int phase, iterations, halvings, looks, moved, singular;
  double orientation; /* sign of the determinant of the last matrix, 0 before there was one */
  double norm;
  double last, ratio; /* size of Newton's last step, and the largest of a step to the one before */
  double low, high, low_r, high_r, length; /* one unknown: what has been searched, or the bracket; residuals there */
  double edge, far, far_r, near, near_r;   /* one unknown: the largest residual at the ends of the first bracket; where
                                              it was found, and how far was searched on the other side */
  int found;                               /* by which look */
  double path, reached, stride;            /* several: s, the last s that was reached, the step */
  double limit;                            /* several: of exponents, INFINITY: none; */
  int limited;                             /* there has been one */
} mdl_newton;

static void mdl_newton_place(mdl_newton *s, const double *x) {
  for (int i = 0; i < s->n; ++i) s->x[i] = x[i];
}

/* The step that is about to be taken is lost in the rounding of its unknowns. */
static int mdl_newton_is_small(const mdl_newton *s, const double *step) {
  for (int i = 0; i < s->n; ++i)
    if (!(fabs(step[i]) <= 1e-9 * fabs(s->x[i]) + 1e-12 * s->nominal[i])) return 0;
  return 1;
}

/* Compare an undamped step from the start values with the one before. */
static void mdl_newton_compare(mdl_newton *s, const double *step, int small) {
  double size = 0.0;
  for (int i = 0; i < s->n; ++i) size = fmax(size, fabs(step[i]) / s->nominal[i]);
  if (!small && s->last > 0.0 && size > s->ratio * s->last) s->ratio = size / s->last;
  s->last = size;
}

/* For the runtime: the first block, since it asked, whose steps do not shrink, or the one that comes nearest to it; and
 * one whose root is of another branch. */
static void mdl_newton_tell(mdl_data *m, const mdl_newton *s, int equation) {
  mdl_contraction *c = &m->contraction;
  if (s->orientation * m->facing[equation] < 0.0) c->turned = 1 + equation;
  if (s->orientation != 0.0) m->orientation[equation] = s->orientation;
  if (c->only ? c->only != 1 + equation : c->ratio > MDL_CONTRACTS || !(s->ratio > c->ratio)) return;
  c->ratio = s->ratio;
  c->equation = equation;
}

/* Of the matrix that mdl_solve has left, whose rows were exchanged without a change of its determinant. */
static void mdl_newton_orient(mdl_newton *s, const double *a) {
  s->orientation = 1.0;
  for (int i = 0; i < s->n; ++i)
    if (a[i * s->n + i] < 0.0) s->orientation = -s->orientation;
}

/* Begin at the start values, one way or the other. */
static void mdl_newton_begin(mdl_newton *s, int phase) {
  s->ratio = INFINITY;
  mdl_newton_place(s, s->work);
  s->phase = phase;
  s->iterations = s->halvings = 0;
  s->path = s->reached = 0.0;
  s->stride = 0.25;
}

/* Several unknowns: other start values, where there are any left. */
static void mdl_newton_move(mdl_newton *s) {
  if (s->moved == 2) {
    s->phase = MDL_FAILED;
    return;
  }
  for (int i = 0; i < s->n; ++i) s->work[i] += s->moved ? -2.0 * s->nominal[i] : s->nominal[i];
  ++s->moved;
  mdl_newton_begin(s, MDL_DAMPED);
}

/* Several unknowns, with exponentials of them: where all else has failed these go on as straight lines beyond a limit
 * of their exponents, which is doubled from solution to solution until there is none. Whether there is more to try. */
static inline int mdl_newton_limit(mdl_newton *s) {
  const int solved = s->phase == MDL_SOLVED;
  if (solved ? s->limit == INFINITY : s->limited) return 0;
  for (int i = 0; i < s->n; ++i) {
    s->work[i] = solved ? s->x[i] : s->work[i] + (s->moved == 2 ? s->nominal[i] : 0.0);
    s->work[2 * s->n + i] = 0.0;
  }
  s->limit = !solved ? MDL_FIRST_LIMIT : s->limit < MDL_LAST_LIMIT ? 2.0 * s->limit : INFINITY;
  s->limited = 1;
  s->moved = s->looks = 0;
  mdl_newton_begin(s, MDL_DAMPED);
  return 1;
}

/* Where the search looks after look k. */
static double mdl_newton_next(const mdl_newton *s, int k) {
  const double start = s->work[0], size = 1e-6 * (fabs(start) + s->nominal[0]);
  return start + (k % 2 ? -size : size) * ldexp(1.0, k / 2);
}

/* What changed its sign was a pole: look on from where it was met. */
static void mdl_newton_resume(mdl_newton *s) {
  s->phase = MDL_SEARCH;
  s->iterations = s->found + 1;
  const int up = s->found % 2;
  s->low = up ? s->near : s->far, s->low_r = up ? s->near_r : s->far_r;
  s->high = up ? s->far : s->near, s->high_r = up ? s->far_r : s->near_r;
  s->x[0] = mdl_newton_next(s, s->found);
}

/* Look for a change of sign at start +- size 2^k, in turn. */
static void mdl_newton_search(mdl_newton *s, double r) {
  const int k = s->iterations++;
  if (k == 0) {
    s->low = s->high = s->work[0];
    s->low_r = s->high_r = r;
  } else if (r * (k % 2 ? s->high_r : s->low_r) < 0.0) {
    s->found = k, s->far = s->x[0], s->far_r = r;
    s->near = k % 2 ? s->low : s->high, s->near_r = k % 2 ? s->low_r : s->high_r;
    if (k % 2) s->low = s->high, s->low_r = s->high_r, s->high = s->x[0], s->high_r = r;
    else s->high = s->low, s->high_r = s->low_r, s->low = s->x[0], s->low_r = r;
    s->length = INFINITY;
    s->edge = fmax(fabs(s->low_r), fabs(s->high_r));
    s->iterations = 0;
    s->phase = MDL_BRACKET;
    return;
  } else if (isfinite(r)) {
    *(k % 2 ? &s->high : &s->low) = s->x[0];
    *(k % 2 ? &s->high_r : &s->low_r) = r;
  }
  if (k > 2 * MDL_DOUBLINGS) s->phase = MDL_FAILED;
  s->x[0] = mdl_newton_next(s, k);
}

/* Halve the bracket where Newton's step leaves it, or three of them have not halved it. A residual that has grown
 * towards its end is that of a pole. */
static void mdl_newton_narrow(mdl_newton *s, double step) {
  const double next = s->x[0] - step, length = s->high - s->low;
  const int creeps = s->iterations % 3 == 0 && length > 0.5 * s->length;
  if (s->iterations % 3 == 0) s->length = length;
  const int small = mdl_newton_is_small(s, &step);
  if (small && s->norm > s->edge * s->edge) {
    mdl_newton_resume(s);
    return;
  }
  if (small) s->phase = MDL_SOLVED;
  else if (++s->iterations > 4 * MDL_ITERATIONS) s->phase = MDL_FAILED;
  const int inside = next > s->low && next < s->high;
  s->x[0] = s->phase == MDL_SOLVED || (inside && !creeps) ? next : s->low + 0.5 * length;
}

/* The corrector has arrived at the path, or does not: a longer stride or a shorter one. */
static void mdl_newton_follow(mdl_newton *s, int arrived) {
  double *const last = s->work + 3 * s->n;
  s->iterations = 0;
  if (arrived) {
    if (s->path == 1.0) s->phase = MDL_SOLVED;
    for (int i = 0; i < s->n; ++i) last[i] = s->x[i];
    s->reached = s->path;
    s->stride *= 2.0;
  } else {
    mdl_newton_place(s, last);
    s->stride *= 0.25;
    if (s->stride < 1e-6) {
      mdl_newton_move(s);
      return;
    }
  }
  s->path = s->reached + s->stride < 1.0 ? s->reached + s->stride : 1.0;
}

/* Several unknowns: weigh residuals r by what they change by where the unknowns change by their sizes, by the matrix a.
 * That a step is too long is then told in the unknowns, as by the natural monotonicity test (P. Deuflhard, Newton
 * Methods for Nonlinear Problems, 2004, 3.3.1), whatever the units of the equations. */
static inline void mdl_newton_weigh(mdl_newton *s, const double *a, const double *r) {
  if (s->phase != MDL_DAMPED) return;
  s->norm = 0.0;
  for (int i = 0; i < s->n; ++i) {
    double size = 0.0;
    for (int j = 0; j < s->n; ++j) size += fabs(a[i * s->n + j]) * s->nominal[j];
    const double weight = size > 0.0 && isfinite(size) ? 1.0 / size : 1.0;
    s->work[2 * s->n + i] = weight;
    s->norm += weight * r[i] * (weight * r[i]);
  }
}

/* The residual r at x. 1: x has been changed, solved or given up, 0: the Jacobian is needed for a step from here. */
static int mdl_newton_look(mdl_newton *s, double *r) {
  const double *const weights = s->work + 2 * s->n;
  const int weighed = s->phase == MDL_DAMPED && weights[0] > 0.0;
  double norm = 0.0;
  for (int i = 0; i < s->n; ++i) norm += weighed ? weights[i] * r[i] * (weights[i] * r[i]) : r[i] * r[i];
  /* Zero is a root even where the Jacobian is singular; but far away from the start it may be an underflow, and so it
   * is behind what has fallen nearly as far. */
  const int fell = s->phase == MDL_DAMPED && s->iterations > 0 && s->norm < 1e-290;
  if (norm == 0.0 && s->phase != MDL_SEARCH && !fell) s->phase = MDL_SOLVED;
  if (++s->looks > MDL_LOOKS) s->phase = MDL_FAILED;
  switch (s->phase) {
  case MDL_DAMPED:
    if (s->iterations > 0 && !(norm <= s->norm) && s->halvings < MDL_HALVINGS) {
      ++s->halvings;
      s->ratio = INFINITY;
      for (int i = 0; i < s->n; ++i) s->x[i] += s->work[s->n + i] *= 0.5;
      return 1;
    }
    /* A step that halves the residual is worth another. */
    if (s->iterations > 0 && norm <= 0.25 * s->norm && !fell) --s->iterations;
    s->halvings = 0;
    s->norm = norm;
    return 0;
  case MDL_SEARCH:
    mdl_newton_search(s, r[0]);
    return 1;
  case MDL_BRACKET:
    *(r[0] * s->low_r > 0.0 ? &s->low : &s->high) = s->x[0];
    s->norm = norm;
    return 0;
  case MDL_FOLLOW:
    if (s->path == 0.0) {
      for (int i = 0; i < s->n; ++i) s->work[2 * s->n + i] = r[i];
      mdl_newton_follow(s, 1);
    }
    for (int i = 0; i < s->n; ++i) r[i] -= (1.0 - s->path) * s->work[2 * s->n + i];
    return 0;
  default:
    return 1;
  }
}

/* Newton's step from x: minus `step`; `singular`: as mdl_solve says. */
static void mdl_newton_step(mdl_newton *s, const double *step, int singular) {
  int finite = !singular;
  for (int i = 0; finite && i < s->n; ++i) finite = isfinite(step[i]);
  if (s->phase == MDL_BRACKET) {
    mdl_newton_narrow(s, finite ? step[0] : INFINITY);
    return;
  }
  const int most = s->phase == MDL_DAMPED ? MDL_ITERATIONS : MDL_CORRECTIONS;
  if (!finite || ++s->iterations > most) {
    if (s->phase == MDL_FOLLOW) mdl_newton_follow(s, 0);
    else s->singular = singular, mdl_newton_begin(s, s->n == 1 ? MDL_SEARCH : MDL_FOLLOW);
    return;
  }
  const int small = mdl_newton_is_small(s, step);
  if (s->phase == MDL_DAMPED) mdl_newton_compare(s, step, small);
  for (int i = 0; i < s->n; ++i) {
    s->work[s->n + i] = step[i];
    s->x[i] -= step[i];
  }
  if (small && s->phase == MDL_FOLLOW) mdl_newton_follow(s, 1);
  else if (small) s->phase = MDL_SOLVED;
}

/* Value of a time relation just after t, while the initial equations are solved at t: g is left minus right at t, slope
 * its derivative. */
static int mdl_time_relation(const mdl_data *m, double g, double slope, double t) {
  const double tolerance = 4e-15 * fabs(t) * fabs(slope);
  return slope > 0.0 && !m->initial ? g >= -tolerance : g > tolerance;
}

/* The earlier of `next` and the instant after t at which a time relation switches: half the tolerance of its value is
 * after t, so that no instant is between what has switched and what will. */
static double mdl_next_switch(double g, double slope, double t, double next) {
  const double instant = t - g / slope;
  return instant > t + 2e-15 * fabs(t) && instant < next ? instant : next;
}

static int mdl_parameters(mdl_data *m) {
  const double C = m->p[1];
  const double V_t = m->p[3];
  /* Diode.mo:1  inverse of V_t = 1.0 / V_t */
  const double inverse_of_V_t = 1.0 / V_t;
  m->p[6] = inverse_of_V_t;
  /* Diode.mo:1  inverse of C = 1.0 / C */
  const double inverse_of_C = 1.0 / C;
  m->p[7] = inverse_of_C;
  return 0;
}

static int mdl_starts(mdl_data *m) {
  m->x[0] = 0.0;
  return 0;
}

static int mdl_samples(const mdl_data *m, double *start, double *interval) {
  (void)m;
  (void)start;
  (void)interval;
  return 0;
}

static int mdl_rhs(mdl_data *m, double t, const double *x, double *xdot, double *v) {
  (void)t;
  const double R = m->p[0];
  const double I_s = m->p[2];
  const double V_t = m->p[3];
  const double U = m->p[4];
  const double inverse_of_V_t = m->p[6];
  const double inverse_of_C = m->p[7];
  const int rel0 = m->rel[0];
  const double u_C = x[0];
  /* Diode.mo:13  u = if time < T then U else -U */
  const double u = rel0 ? U : -U;
  /* nonlinear block of 2, torn to 1 */
  double v_2 = v[1];
  double i = 0.0;
  double v_2_block_x[1] = {v_2};
  double v_2_block_work[4] = {v_2};
  const double v_2_block_nominal[1] = {fabs(V_t) > 0.0 ? fabs(V_t) : 0.025};
  mdl_newton v_2_block = {.n = 1, .x = v_2_block_x, .work = v_2_block_work, .nominal = v_2_block_nominal};
  for (;;) {
    v_2 = v_2_block_x[0];
    /* Diode.mo:15  i = I_s*(exp(v/V_t) - 1) */
    const double tmp1 = exp(v_2 * inverse_of_V_t);
    i = I_s * (tmp1 - 1.0);
    if (v_2_block.phase == MDL_SOLVED) break;
    /* Diode.mo:14  u = R*i + v + u_C */
    double v_2_block_r[2] = {u - (R * i + v_2 + u_C)};
    const int v_2_block_looked = mdl_newton_look(&v_2_block, v_2_block_r);
    if (v_2_block.phase == MDL_FAILED) {
      mdl_newton_tell(m, &v_2_block, 1);
      return mdl_fail(m, MDL_FAILURE_NEWTON, (const int[]){1, 1}[v_2_block.singular], 0.0);
    }
    if (v_2_block_looked) continue;
    double v_2_block_a[1] = {-(R * (I_s * (tmp1 * inverse_of_V_t)) + 1.0)};
    const int v_2_block_singular = mdl_solve(1, v_2_block_a, v_2_block_r);
    if (!v_2_block_singular) mdl_newton_orient(&v_2_block, v_2_block_a);
    mdl_newton_step(&v_2_block, v_2_block_r, v_2_block_singular);
  }
  mdl_newton_tell(m, &v_2_block, 1);
  /* Diode.mo:16  C*der(u_C) = i */
  const double der_u_C = i * inverse_of_C;
  v[1] = v_2;
  v[2] = i;
  xdot[0] = der_u_C;
  if (!m->brief) {
    v[0] = u;
  }
  return 0;
}

static int mdl_initial_system(mdl_data *m, double t) {
  const double pre_u_C = m->x[0];
  /* Diode.mo:11  start of u_C */
  const double u_C = pre_u_C;
  m->x[0] = u_C;
  return mdl_rhs(m, t, m->x, m->xdot, m->v);
}

static int mdl_residual(mdl_data *m, double t, const double *y, const double *yp, double *r) {
  (void)t;
  const double R = m->p[0];
  const double C = m->p[1];
  const double I_s = m->p[2];
  const double V_t = m->p[3];
  const double U = m->p[4];
  const int rel0 = m->rel[0];
  const double u_C = y[0];
  const double v_2 = y[1];
  const double der_u_C = yp[0];
  /* Diode.mo:13  u = if time < T then U else -U */
  const double u = rel0 ? U : -U;
  /* Diode.mo:16  C*der(u_C) = i */
  const double i = C * der_u_C;
  /* Diode.mo:14  u = R*i + v + u_C */
  r[0] = u - (R * i + v_2 + u_C);
  /* Diode.mo:15  i = I_s*(exp(v/V_t) - 1) */
  r[1] = i - I_s * (exp(v_2 / V_t) - 1.0);
  return 0;
}

static int mdl_jacobian(mdl_data *m, double t, const double *y, const double *yp, double cj, double *values) {
  (void)t;
  (void)yp;
  const double R = m->p[0];
  const double C = m->p[1];
  const double I_s = m->p[2];
  const double V_t = m->p[3];
  const double v_2 = y[1];
  const double d_i_d_u_C = C * cj;
  values[0] = -(R * d_i_d_u_C + 1.0);
  values[1] = d_i_d_u_C;
  values[2] = -1.0;
  values[3] = -(I_s * (exp(v_2 / V_t) * (1.0 / V_t)));
  return 0;
}

static int mdl_roots(mdl_data *m, double t, const double *x, const double *xdot, const double *v, double *g) {
  (void)m;
  (void)t;
  (void)x;
  (void)xdot;
  (void)v;
  g[0] = 0.0;  /* Diode.mo:13  time < T */
  return 0;
}

static int mdl_time_relations(mdl_data *m, double t) {
  const double T = m->p[5];
  m->rel[0] = (unsigned char)mdl_time_relation(m, T - t, -1.0, t);
  return 0;
}

static double mdl_next_time_event(const mdl_data *m, double t) {
  const double T = m->p[5];
  double next = INFINITY;
  next = mdl_next_switch(T - t, -1.0, t, next);
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
  const double V_t = m->p[3];
  const double tmp1 = fabs(V_t);
  const double tmp2 = tmp1 > 0.0 ? tmp1 : 0.025;
  nominal[0] = tmp2;
  nominal[1] = tmp2;
  nominal[2] = 1.0;
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

static const mdl_descriptor mdl_model = {
  .abi_version = MDL_ABI_VERSION,
  .name = "Diode",
  .hash = "",
  .jac_nnz = 4,
  .n_asserts = 0,
  .n_branches = 1,
  .n_computed = 6,
  .n_d = 0,
  .n_divisions = 0,
  .n_equations = 6,
  .n_messages = 0,
  .n_p = 8,
  .n_rel = 1,
  .n_sample = 0,
  .n_u = 0,
  .n_v = 3,
  .n_variables = 10,
  .n_when = 0,
  .n_x = 1,
  .n_z = 1,
  .variables = mdl_variables,
  .equations = mdl_equations,
  .asserts = NULL,
  .relations = mdl_relations,
  .messages = NULL,
  .z_index = mdl_z_index,
  .z_branches = mdl_z_branches,
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
  .branches = mdl_branches,
};

const mdl_descriptor *mdl_descriptor_get(void);

const mdl_descriptor *mdl_descriptor_get(void) { return &mdl_model; }
