/* IDA's interpolating polynomial, from the points that it goes through: as many of the last ends of steps as the order
 * of the last step, and one more (P. N. Brown, A. C. Hindmarsh, L. R. Petzold, SIAM J. Sci. Comput. 15 (1994)
 * 1467-1488). IDA itself gives it one derivative a call, which takes ten times as long. */
#include <string.h>

#include "ida.h"
#include "onestep.h"

void rt_ida_push(const rt_session *s, rt_ida *m, double t, const double *x) {
  m->latest = (m->latest + 1) % RT_IDA_POINTS;
  m->past_t[m->latest] = t;
  memcpy(m->past + m->latest * s->d->n_x, x, (size_t)s->d->n_x * sizeof *x);
}

/* The states x are at t, where a step has ended; `begins`: where IDA has been started. */
void rt_ida_remember(const rt_session *s, rt_ida *m, double t, const double *x, bool begins) {
  long taken = 0;
  if (!begins) IDAGetNumSteps(m->ida, &taken);
  if (!begins && taken == m->taken) return; /* to an end that is there already, within rounding */
  m->taken = taken;
  m->first = m->latest;
  if (!begins) IDAGetLastOrder(m->ida, &m->order);
  rt_ida_push(s, m, t, x);
}

/* Polynomials of degree k through n values at each of the nodes z [k + 1], by divided differences: coefficients of
 * powers c [(k + 1) * n]. Values are taken in pairs. Inline, so that a known k unrolls. */
static inline void interpolate(int k, int n, const double *z, const double *const *value, double *c) {
  double per[RT_IDA_POINTS * (RT_IDA_POINTS - 1) / 2], *next = per;
  for (int order = 1; order <= k; order++)
    for (int j = k; j >= order; j--)
      *next++ = 1 / (z[j] - z[j - order]);
  for (int i = 0; i < n; i += 2) {
    bool single = i + 1 == n;
    rt_pair row[RT_IDA_POINTS];
    for (int j = 0; j <= k; j++)
      row[j] = single ? (rt_pair){value[j][i], 0} : rt_load(value[j] + i);
    next = per;
    for (int order = 1; order <= k; order++)
      for (int j = k; j >= order; j--)
        row[j] = (row[j] - row[j - 1]) * *next++;
    for (int j = k - 1; j > 0; j--)
      for (int l = j; l < k; l++)
        row[l] -= z[j] * row[l + 1];
    for (int j = 0; j <= k; j++)
      if (single)
        c[j * n + i] = row[j][0];
      else
        rt_store(c + j * n + i, row[j]);
  }
}

/* The last step in s = (t - t0) / h from its start on, which is the first node, so that no power of it is left. */
void rt_ida_dense(rt_session *s, void *memory, rt_dense *out) {
  const rt_ida *m = memory;
  int n = s->d->n_x, end = m->latest, start = m->first, row = end;
  double z[RT_IDA_POINTS];
  const double *value[RT_IDA_POINTS];
  out->degree = m->order;
  out->t0 = m->past_t[start];
  out->h = m->past_t[end] - out->t0;
  for (int j = 0; j <= out->degree; j++) {
    if (j == 0) row = start;
    if (j == 1) row = end;
    for (bool next = j > 1; next; next = row == start)
      row = (row + RT_IDA_POINTS - 1) % RT_IDA_POINTS;
    z[j] = (m->past_t[row] - out->t0) / out->h;
    value[j] = m->past + row * n;
  }
  switch (out->degree) {
  case 1:
    interpolate(1, n, z, value, out->c);
    break;
  case 2:
    interpolate(2, n, z, value, out->c);
    break;
  case 3:
    interpolate(3, n, z, value, out->c);
    break;
  case 4:
    interpolate(4, n, z, value, out->c);
    break;
  case RT_DENSE_DEGREE:
    interpolate(RT_DENSE_DEGREE, n, z, value, out->c);
    break;
  }
}
