/* KLU (Davis & Palamadai Natarajan, ACM Trans. Math. Softw. 37 (2010) 36) for the matrix of a one-step method. */
#include "sparse.h"

#include <klu.h>
#include <stdlib.h>

#include "undetermined.h"

_Static_assert(sizeof(sunindextype) == sizeof(SuiteSparse_long), "KLU's long indices are those of SUNDIALS");

struct rt_sparse {
  sunindextype n, *first, *row;
  double *data;
  int n_held; /* terms in the pattern that was analysed */
  klu_l_common common;
  klu_l_symbolic *symbolic;
  klu_l_numeric *numeric;
};

/* The value of `held` in row `row` of column j, 0 where it is none. */
static double held_at(const rt_session *s, int row, int j) {
  double value = 0;
  for (int k = 0; k < s->n_held; k++)
    if (s->held[k].column == j && s->held[k].row == row) value = s->held[k].value;
  return value;
}

sunindextype rt_fill_columns(const rt_session *s, const double *values, sunindextype *first, sunindextype *row,
                             double *data) {
  const mdl_descriptor *d = s->d;
  sunindextype next = 0;
  for (int j = 0; j < d->n_x + d->n_z; j++) {
    first[j] = next;
    for (int k = d->jac_colptr[j]; k < d->jac_colptr[j + 1]; k++) {
      row[next] = d->jac_rowidx[k];
      data[next++] = values[k] + (s->n_held ? held_at(s, d->jac_rowidx[k], j) : 0);
    }
    for (int k = 0; k < s->n_held; k++) {
      bool found = s->held[k].column != j;
      for (sunindextype l = first[j]; l < next; l++)
        found |= row[l] == s->held[k].row;
      if (found) continue;
      row[next] = s->held[k].row;
      data[next++] = s->held[k].value;
    }
  }
  return first[d->n_x + d->n_z] = next;
}

rt_sparse *rt_sparse_new(const rt_session *s) {
  size_t n = (size_t)(s->d->n_x + s->d->n_z), entries = (size_t)(s->d->jac_nnz + s->d->n_z);
  rt_sparse *m = calloc(1, sizeof *m);
  if (!m) return NULL;
  m->n = (sunindextype)n;
  m->first = calloc(n + 1, sizeof *m->first);
  m->row = calloc(entries + 1, sizeof *m->row);
  m->data = calloc(entries + 1, sizeof *m->data);
  klu_l_defaults(&m->common);
  m->common.scale = 0; /* rows come with weights */
  if (m->first && m->row && m->data) return m;
  rt_sparse_free(m);
  return NULL;
}

void rt_sparse_free(rt_sparse *m) {
  if (!m) return;
  klu_l_free_numeric(&m->numeric, &m->common);
  klu_l_free_symbolic(&m->symbolic, &m->common);
  free(m->first);
  free(m->row);
  free(m->data);
  free(m);
}

int rt_sparse_factor(const rt_session *s, rt_sparse *m, const double *values, const double *weight) {
  sunindextype entries = rt_fill_columns(s, values, m->first, m->row, m->data);
  for (sunindextype k = 0; k < entries; k++)
    m->data[k] *= weight[m->row[k]];
  klu_l_free_numeric(&m->numeric, &m->common);
  if (m->n_held != s->n_held || s->n_held > 0) klu_l_free_symbolic(&m->symbolic, &m->common);
  m->n_held = s->n_held;
  if (!m->symbolic) m->symbolic = klu_l_analyze(m->n, m->first, m->row, &m->common);
  if (!m->symbolic) return 1; /* structurally singular, or no memory */
  m->numeric = klu_l_factor(m->first, m->row, m->data, m->symbolic, &m->common);
  if (m->numeric && m->common.status == KLU_OK) return 0;
  sunindextype column = m->common.singular_col;
  return column >= 0 && column < m->n ? 1 + (int)column : 1;
}

void rt_sparse_solve(rt_sparse *m, double *b) {
  klu_l_solve(m->symbolic, m->numeric, m->n, 1, b, &m->common);
}
