/* Vectors and linear solver for IDA, see vector.c and dense_solver.c. */
#ifndef RT_VECTOR_H
#define RT_VECTOR_H

#include "sundials_compat.h"

/* n zeros; NULL without memory. Clones of it have the same operations. */
N_Vector rt_vector_new(long n, SUNContext context);

/* A solver for dense n x n matrices whose rows have been multiplied by the factors row [n], see dense_solver.c; NULL
 * without memory. */
SUNLinearSolver rt_dense_solver_new(int n, const double *row, SUNContext context);

#endif
