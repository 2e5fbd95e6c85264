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
  m->serves = true;
  rt_inputs_at(s, t);
  int status = rt_jacobian(s, t, N_VGetArrayPointer(y), N_VGetArrayPointer(yp), cj, values);
  if (!status) status = check_jacobian(s, values);
  if (status) return status;
  if (SUNMatGetID(matrix) == SUNMATRIX_SPARSE) return fill_sparse(s, m, matrix);
  fill_dense(s, m, SUNDenseMatrix_Data(matrix));
  return 0;
}

/* The residual at the polynomial's slope is F_x' times the defect, so that cj (F_y + cj F_y')^-1 filters it. A start by
 * an explicit method has no matrix, and needs none. */
void rt_ida_filter(rt_session *s, void *memory, double t, double *defect) {
  const rt_ida *m = memory;
  const mdl_descriptor *d = s->d;
  if (!m->serves) return;
  memcpy(s->y, s->x_trial, (size_t)d->n_x * sizeof *s->y);
  for (int k = 0; k < d->n_z; k++) {
    s->y[d->n_x + k] = s->v_trial[d->z_index[k]];
    s->yp[d->n_x + k] = 0;
  }
  const double *solution = N_VGetArrayPointer(m->filtered);
  if (d->residual(&s->data, t, s->y, s->yp, N_VGetArrayPointer(m->work)) ||
      SUNLinSolSolve(m->solver, m->matrix, m->filtered, m->work, 0))
    return;
  for (int i = 0; i < d->n_x; i++)
    defect[i] = m->cj_of_matrix * solution[i];
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
