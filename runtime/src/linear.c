/* Small dense linear systems: LU decomposition with partial pivoting (Golub & Van Loan, Matrix Computations, 3.4). The
 * diagonal is kept as its inverses: a solution costs no division. */
#include <math.h>

#include "session.h"

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
