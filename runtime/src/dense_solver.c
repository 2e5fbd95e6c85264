/* A linear solver for IDA on small dense matrices, by the decomposition of linear.c: of a system of a few unknowns
 * SUNDIALS' own spends most of its time on the way to the loops. */
#include <stdlib.h>

#include "session.h"
#include "vector.h"

typedef struct {
  int n;
  const double *row;     /* [n] factors of the rows */
  const double *factors; /* in the matrix of the last set-up */
  int pivot[];
} content;

static SUNLinearSolver_Type type(SUNLinearSolver solver) {
  (void)solver;
  return SUNLINEARSOLVER_DIRECT;
}

static int setup(SUNLinearSolver solver, SUNMatrix matrix) {
  content *c = solver->content;
  double *a = SUNDenseMatrix_Data(matrix);
  c->factors = a;
  return rt_lu_factor(c->n, a, c->pivot) ? 1 : 0; /* singular: IDA tries a shorter step */
}

static int solve(SUNLinearSolver solver, SUNMatrix matrix, N_Vector x, N_Vector b, sunrealtype tolerance) {
  (void)matrix, (void)tolerance;
  const content *c = solver->content;
  double *values = NV_DATA_S(x);
  const double *right = NV_DATA_S(b);
  for (int i = 0; i < c->n; i++)
    values[i] = c->row[i] * right[i];
  rt_lu_solve(c->n, c->factors, c->pivot, values);
  return 0;
}

static int destroy(SUNLinearSolver solver) {
  free(solver->content);
  solver->content = NULL;
  SUNLinSolFreeEmpty(solver);
  return 0;
}

SUNLinearSolver rt_dense_solver_new(int n, const double *row, SUNContext context) {
  SUNLinearSolver solver = SUNLinSolNewEmpty(context);
  content *c = calloc(1, sizeof *c + (size_t)n * sizeof *c->pivot);
  if (!solver || !c) {
    if (solver) SUNLinSolFreeEmpty(solver);
    free(c);
    return NULL;
  }
  c->n = n;
  c->row = row;
  solver->content = c;
  solver->ops->gettype = type;
  solver->ops->setup = setup;
  solver->ops->solve = solve;
  solver->ops->free = destroy;
  return solver;
}
