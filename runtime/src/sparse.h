/* Sparse linear systems with the pattern of the model's Jacobian and what is held in it, by KLU. */
#ifndef RT_SPARSE_H
#define RT_SPARSE_H

#include "session.h"
#ifndef RT_OWN_METHODS
#include "sundials_compat.h"
#endif

typedef struct rt_sparse rt_sparse;

#ifdef RT_OWN_METHODS /* a model that carries its methods as source has no KLU: all its matrices are dense */
static const bool rt_has_sparse = false;
static inline rt_sparse *rt_sparse_new(const rt_session *s) {
  (void)s;
  return NULL;
}
static inline void rt_sparse_free(rt_sparse *m) {
  (void)m;
}
static inline int rt_sparse_factor(const rt_session *s, rt_sparse *m, const double *values, const double *weight) {
  (void)s, (void)m, (void)values, (void)weight;
  return 1;
}
static inline void rt_sparse_solve(rt_sparse *m, double *b) {
  (void)m, (void)b;
}
#else
static const bool rt_has_sparse = true;
/* Columns of the Jacobian's values with what is held, in its place or behind the others. first[n + 1], row
 * and data[jac_nnz + n_z], n = n_x + n_z; how many there are. */
sunindextype rt_fill_columns(const rt_session *s, const double *values, sunindextype *first, sunindextype *row,
                             double *data);
rt_sparse *rt_sparse_new(const rt_session *s);
void rt_sparse_free(rt_sparse *m);
/* Factor; 0, or 1 + a column that has no pivot. `weight[n]`: the rows are multiplied by it, and so are right sides. */
int rt_sparse_factor(const rt_session *s, rt_sparse *m, const double *values, const double *weight);
void rt_sparse_solve(rt_sparse *m, double *b);
#endif

#endif
