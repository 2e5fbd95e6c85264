"""Linear equations: the solvers that a generated model carries along for its blocks, as C.

A block may leave unknowns open in some modes, as the torques of two brakes that hold one shaft. Where its equations
do not contradict each other the solution next to zero is taken, in units of the unknowns' nominal values, as other
Modelica tools do. The model notes it, and the runtime sees to it that no derivative depends on the choice
(runtime/src/undetermined.c).
"""

from __future__ import annotations

SOLVE_OF = """\
/* Solve a x = b in place (row-major, n x n) by Gaussian elimination with scaled partial pivoting; b becomes x. Where a
 * is singular to working precision, 1 + the unknown that it does not determine: rows and columns have no scale. b has
 * 2 n places: behind the right sides come the sizes of what is summed up in them. A row that makes place for another
 * changes its sign, so that the determinant stays: its sign is that of the product of the diagonal. */
static inline __attribute__((always_inline)) int mdl_solve_of(int n, double *a, double *b) {
  double size[n];
#pragma GCC unroll 4
  for (int i = 0; i < n; ++i) {
    double largest = 0.0;
    for (int j = 0; j < n; ++j)
      if (fabs(a[i * n + j]) > largest) largest = fabs(a[i * n + j]);
    const double scale = largest > 0.0 ? 1.0 / largest : 1.0;
    for (int j = 0; j < n; ++j) a[i * n + j] *= scale;
    b[i] *= scale;
    b[n + i] = fabs(b[i]);
  }
#pragma GCC unroll 4
  for (int j = 0; j < n; ++j) {
    size[j] = 0.0;
    for (int i = 0; i < n; ++i)
      if (fabs(a[i * n + j]) > size[j]) size[j] = fabs(a[i * n + j]);
  }
#pragma GCC unroll 4
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
#pragma GCC unroll 4
  for (int i = n - 1; i >= 0; --i) {
    for (int j = i + 1; j < n; ++j) b[i] -= a[i * n + j] * b[j];
    b[i] /= a[i * n + i];
  }
  return 0;
}"""

# Of a size that the compiler sees, it would write out rows that are not there, and say so.
WITH_LOOPS = SOLVE_OF.replace("#pragma GCC unroll 4\n", "").replace(
    "static inline __attribute__((always_inline)) int mdl_solve_of", "static int mdl_solve"
)
UNROLLED = (2, 3, 4)  # unknowns of blocks that are solved without loops
SOLVES = {
    "mdl_solve_of": SOLVE_OF,
    "mdl_solve": WITH_LOOPS,
    **{f"mdl_solve_{n}": f"static int mdl_solve_{n}(double *a, double *b) {{ return mdl_solve_of({n}, a, b); }}"
       for n in UNROLLED},
}  # fmt: skip


def solved(n: int, a: str, b: str) -> str:
    """The call that solves a x = b."""
    return f"mdl_solve_{n}({a}, {b})" if n in UNROLLED else f"mdl_solve({n}, {a}, {b})"


LEAST = """\
static void mdl_swap(double *a, double *b) {
  const double swap = *a;
  *a = *b;
  *b = swap;
}

/* Triangular equations for the first `rank` unknowns: x is the solution with the smallest sum of squares in units of
 * `nominal`, moved by `shift` along what is open. The columns of `all` are directions that are open, one of the last
 * unknowns being -1 and the others zero, then the solution with zeros there. */
static int mdl_nearest(
  int n, int rank, const double *a, const double *b, const double *nominal, double shift, double *x) {
  const int open = n - rank, width = open + 1;
  double all[n * width], gram[open * open], c[2 * open];
  for (int j = 0; j < width; ++j)
    for (int i = n - 1; i >= 0; --i) {
      double sum = i >= rank ? (i - rank == j ? -1.0 : 0.0) : j < open ? a[i * n + rank + j] : b[i];
      for (int l = i + 1; i < rank && l < rank; ++l) sum -= a[i * n + l] * all[l * width + j];
      all[i * width + j] = i < rank ? sum / a[i * n + i] : sum;
    }
  for (int j = 0; j < open; ++j)
    for (int l = 0; l < width; ++l) {
      double sum = 0.0;
      for (int i = 0; i < n; ++i) sum += all[i * width + j] / nominal[i] * (all[i * width + l] / nominal[i]);
      *(l < open ? &gram[j * open + l] : &c[j]) = sum;
    }
  if (mdl_solve(open, gram, c)) return 1;
  for (int i = 0; i < n; ++i) {
    x[i] = all[i * width + open];
    for (int j = 0; j < open; ++j) x[i] -= all[i * width + j] * (c[j] + shift * nominal[rank + j] / (1.0 + j));
  }
  return 0;
}

/* Where mdl_solve has found no pivot for unknown k: elimination goes on with pivots from all columns that are left. 1
 * where the equations that remain contradict each other, else the solution of mdl_nearest is in b. */
static int mdl_least(const mdl_data *m, int n, int k, double *a, double *b, const double *nominal) {
  double size[n], unit[n], x[n];
  int place[n], rank = k;
  for (int j = 0; j < n; ++j) {
    size[j] = 0.0;
    place[j] = j;
    unit[j] = nominal[j];
    for (int i = 0; i < (j < k ? j + 1 : n); ++i)
      if (fabs(a[i * n + j]) > size[j]) size[j] = fabs(a[i * n + j]);
  }
  for (; rank < n; ++rank) {
    int row = -1, column = -1;
    double best = 1e-13;
    for (int i = rank; i < n; ++i)
      for (int j = rank; j < n; ++j)
        if (fabs(a[i * n + j]) > best * size[j]) best = fabs(a[i * n + j]) / size[j], row = i, column = j;
    if (row < 0) break;
    for (int j = rank; j < n; ++j) mdl_swap(&a[rank * n + j], &a[row * n + j]);
    for (int j = 0; j < 2; ++j) mdl_swap(&b[j * n + rank], &b[j * n + row]);
    for (int i = 0; i < n; ++i) mdl_swap(&a[i * n + rank], &a[i * n + column]);
    mdl_swap(&size[rank], &size[column]);
    mdl_swap(&unit[rank], &unit[column]);
    const int moved = place[rank];
    place[rank] = place[column];
    place[column] = moved;
    for (int i = rank + 1; i < n; ++i) {
      const double factor = a[i * n + rank] / a[rank * n + rank];
      for (int j = rank + 1; j < n; ++j) a[i * n + j] -= factor * a[rank * n + j];
      b[i] -= factor * b[rank];
      b[n + i] += fabs(factor) * b[n + rank];
    }
  }
  for (int i = rank; i < n; ++i)
    if (!(fabs(b[i]) <= 1e-9 * b[n + i])) return 1;
  if (mdl_nearest(n, rank, a, b, unit, m->shift, x)) return 1;
  for (int i = 0; i < n; ++i) b[place[i]] = x[i];
  return 0;
}"""

FACTOR = """\
/* LU factors of a (row-major, n x n) in place, pivots chosen by their size against the largest of their row; row i of
 * the factors is row order[i] of a. Returns 1 where a is singular to working precision. */
static int mdl_factor(int n, double *a, int *order) {
  for (int i = 0; i < n; ++i)
    order[i] = i;
  for (int k = 0; k < n; ++k) {
    int pivot = k;
    double best = 0.0;
    for (int i = k; i < n; ++i) {
      double largest = 0.0;
      for (int j = k; j < n; ++j)
        if (fabs(a[i * n + j]) > largest) largest = fabs(a[i * n + j]);
      const double size = largest > 0.0 ? fabs(a[i * n + k]) / largest : 0.0;
      if (size > best) best = size, pivot = i;
    }
    if (!(best > 1e-14)) return 1;
    const int row = order[k];
    order[k] = order[pivot];
    order[pivot] = row;
    for (int j = 0; j < n && pivot != k; ++j) {
      const double swap = a[k * n + j];
      a[k * n + j] = a[pivot * n + j];
      a[pivot * n + j] = swap;
    }
    for (int i = k + 1; i < n; ++i) {
      a[i * n + k] /= a[k * n + k];
      for (int j = k + 1; j < n; ++j)
        a[i * n + j] -= a[i * n + k] * a[k * n + j];
    }
  }
  return 0;
}"""

SUBSTITUTE = """\
/* Solves for x with the factors of mdl_factor, in several directions at once. */
MDL_WIDE static void mdl_substitute(int n, const double *a, const int *order, const mdl_lanes *b, mdl_lanes *x) {
  for (int i = 0; i < n; ++i) {
    x[i] = b[order[i]];
    for (int j = 0; j < i; ++j)
      x[i] -= a[i * n + j] * x[j];
  }
  for (int i = n - 1; i >= 0; --i) {
    for (int j = i + 1; j < n; ++j)
      x[i] -= a[i * n + j] * x[j];
    x[i] /= a[i * n + i];
  }
}"""
