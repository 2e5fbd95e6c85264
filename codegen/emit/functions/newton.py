"""The solver that a generated model carries along for its nonlinear blocks, as C.

Newton's method with a damped step, as long as a step halves the residual, and fifty steps more: down the exponential
of a diode each step is a thermal voltage. Where it gets nowhere from the start values (the residual has a valley that
is no root, a limited gain throws each step to the other limit, the Jacobian is singular), a second way is tried:

- one unknown: the interval around the start value is doubled until the residual changes its sign, on the nearer side
  first, and the root is bracketed by Newton's steps and bisection. A continuous residual that changes its sign has a
  root; where it jumps over zero there is none, and the block fails; behind a pole the search goes on.
- several: the root of F(x) = (1 - s) F(start) is followed from s = 0 to 1 (Newton homotopy; Allgower & Georg,
  Introduction to Numerical Continuation Methods, 2003), with steps of s that halve where Newton's method does not
  follow and double where it does. Where that does not leave the start (a Jacobian that is singular or not finite
  there), both ways are tried from starts moved by the sizes of the unknowns, up and down.
- of several with exponentials, where all that fails: their exponents are limited for a while (text/limited.py).

How each step compares with the one before is kept for the runtime, which sees to it that a run follows one root
(runtime/src/fold.c).
"""

NEWTON = """\
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
}"""
