/* Large sparse problems by hand: see sparse.c. */
#ifndef LACUNA_BENCH_SPARSE_H
#define LACUNA_BENCH_SPARSE_H

/* The ladder (chain = 0) or the chain with n states from rest to `stop` (s), its states on a grid of `points` rows of
 * n; returns 0 or the status of IDA. */
int solve_sparse(int chain, int n, double stop, int points, double rtol, double atol, double *rows, long *steps);

#endif
