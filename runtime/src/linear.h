/* Factors of rows; dense n x n systems by LU with partial pivoting, column-major (linear.c). */
#ifndef RT_LINEAR_H
#define RT_LINEAR_H

#include "lacuna_runtime.h"

void rt_row_factors(const rt_session *s, const double *values, double *row);
int rt_lu_factor(int n, double *a, int *pivot);
void rt_lu_solve(int n, const double *a, const int *pivot, double *b);

#endif
