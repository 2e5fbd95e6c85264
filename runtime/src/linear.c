/* Linear systems of the residual form: factors of their rows; and small dense ones by LU decomposition with partial
 * pivoting (Golub & Van Loan, Matrix Computations, 3.4), whose diagonal is kept as its inverses, so that a solution
 * costs no division. */
#include <math.h>
#include <string.h>

#include "undetermined.h"

/* Powers of two that give the rows of a matrix size 1, where unknowns are measured in their nominal values, so that the
 * choice of pivots has no units: row [n_x + n_z], of values [jac_nnz] and what is held. */
void rt_row_factors(const rt_session *s, const double *values, double *row) {
  const mdl_descriptor *m = s->d;
  int n = m->n_x + m->n_z;
  memset(row, 0, (size_t)n * sizeof *row);
  for (int j = 0; j < n; j++)
    for (int k = m->jac_colptr[j]; k < m->jac_colptr[j + 1]; k++) {
      double *size = &row[m->jac_rowidx[k]];
      *size = rt_max(*size, fabs(values[k]) * s->nominal[j]);
    }
  for (int k = 0; k < s->n_held; k++) {
    double *size = &row[s->held[k].row];
    *size = rt_max(*size, fabs(s->held[k].value) * s->nominal[s->held[k].column]);
  }
  for (int i = 0; i < n; i++) {
    int exponent = 0;
    if (row[i] > 0 && isfinite(row[i])) frexp(row[i], &exponent);
    row[i] = ldexp(1, -exponent);
  }
}

static void swap(double *a, double *b) {
  double t = *a;
  *a = *b;
  *b = t;
}

/* Factor the column-major n x n matrix in place; 1 + the column that has no pivot, or 0. */
int rt_lu_factor(int n, double *a, int *pivot) {
  for (int k = 0; k < n; k++) {
    int p = k;
    for (int i = k + 1; i < n; i++)
      if (fabs(a[k * n + i]) > fabs(a[k * n + p])) p = i;
    pivot[k] = p;
    if (!(fabs(a[k * n + p]) > 0)) return k + 1;
    if (p != k)
      for (int j = 0; j < n; j++)
        swap(&a[j * n + k], &a[j * n + p]);
    double inverse = a[k * n + k] = 1 / a[k * n + k];
    for (int i = k + 1; i < n; i++)
      a[k * n + i] *= inverse;
    for (int j = k + 1; j < n; j++) {
      double factor = a[j * n + k];
      if (factor != 0)
        for (int i = k + 1; i < n; i++)
          a[j * n + i] -= a[k * n + i] * factor;
    }
  }
  return 0;
}

void rt_lu_solve(int n, const double *a, const int *pivot, double *b) {
  for (int k = 0; k < n; k++)
    if (pivot[k] != k) swap(&b[k], &b[pivot[k]]);
  for (int k = 0; k < n; k++)
    for (int i = k + 1; i < n; i++)
      b[i] -= a[k * n + i] * b[k];
  for (int k = n - 1; k >= 0; k--) {
    b[k] *= a[k * n + k];
    for (int i = 0; i < k; i++)
      b[i] -= a[k * n + i] * b[k];
  }
}
