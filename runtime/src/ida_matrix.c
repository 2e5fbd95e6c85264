/* The matrix of IDA's Newton method: dense for a few unknowns, else sparse, for KLU; and what is held in it. */
#include <math.h>
#include <string.h>

#include "ida.h"
#include "sparse.h"
#include "undetermined.h"
#include "vector.h"

enum { DENSE_LIMIT = 10 }; /* unknowns up to which a dense matrix is faster than KLU */

static int check_jacobian(rt_session *s, const double *values) {
  for (int k = 0; k < s->d->jac_nnz; k++)
    if (!isfinite(values[k])) return rt_ida_not_finite(s, s->d->jac_rowidx[k], values[k]);
  return 0;
}

static int fill_sparse(const rt_session *s, rt_ida *m, SUNMatrix matrix) {
  sunindextype entries = rt_fill_columns(s, m->values, SUNSparseMatrix_IndexPointers(matrix),
                                         SUNSparseMatrix_IndexValues(matrix), SUNSparseMatrix_Data(matrix));
  long fails = 0;
  IDAGetNumNonlinSolvConvFails(m->ida, &fails);
  bool choose_pivots = fails != m->pivots_chosen_at || s->n_held != m->held;
  m->pivots_chosen_at = fails;
  m->held = s->n_held;
  return choose_pivots ? SUNLinSol_KLUReInit(m->solver, matrix, entries, SUNKLU_REINIT_PARTIAL) : 0;
}

/* With rows of size 1; the solver gives the right side the same factors. */
static void fill_dense(const rt_session *s, rt_ida *m, double *a) {
  const mdl_descriptor *d = s->d;
  int n = d->n_x + d->n_z;
  rt_row_factors(s, m->values, m->row);
  for (int j = 0; j < n; j++)
    for (int k = d->jac_colptr[j]; k < d->jac_colptr[j + 1]; k++)
      a[j * n + d->jac_rowidx[k]] = m->row[d->jac_rowidx[k]] * m->values[k];
  for (int k = 0; k < s->n_held; k++)
    a[s->held[k].column * n + s->held[k].row] += m->row[s->held[k].row] * s->held[k].value;
}

static int jacobian(sunrealtype t, sunrealtype cj, N_Vector y, N_Vector yp, N_Vector r, SUNMatrix matrix, void *user,
                    N_Vector t1, N_Vector t2, N_Vector t3) {
  (void)r, (void)t1, (void)t2, (void)t3;
  rt_session *s = user;
  rt_ida *m = s->memory;
  double *values = m->values;
  m->cj_of_matrix = cj;
  rt_inputs_at(s, t);
  int status = rt_jacobian(s, t, N_VGetArrayPointer(y), N_VGetArrayPointer(yp), cj, values);
  if (!status) status = check_jacobian(s, values);
  if (status) return status;
  if (SUNMatGetID(matrix) == SUNMATRIX_SPARSE) return fill_sparse(s, m, matrix);
  fill_dense(s, m, SUNDenseMatrix_Data(matrix));
  return 0;
}

bool rt_ida_create_matrix(rt_session *s, rt_ida *m) {
  sunindextype n = s->d->n_x + s->d->n_z;
  if (n > DENSE_LIMIT) {
    m->matrix = SUNSparseMatrix(n, n, s->d->jac_nnz + s->d->n_z, CSC_MAT, m->context);
    m->solver = m->matrix ? SUNLinSol_KLU(m->y, m->matrix, m->context) : NULL;
  } else {
    m->matrix = SUNDenseMatrix(n, n, m->context);
    m->solver = m->matrix ? rt_dense_solver_new((int)n, m->row, m->context) : NULL;
  }
  return m->solver && IDASetLinearSolver(m->ida, m->solver, m->matrix) == IDA_SUCCESS &&
         IDASetJacFn(m->ida, jacobian) == IDA_SUCCESS && (m->newton = rt_newton_new(s, m->context)) &&
         IDASetNonlinearSolver(m->ida, m->newton) == IDA_SUCCESS;
}
