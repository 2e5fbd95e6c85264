/* One-step methods: a scheme computes one step of given size, the driver in onestep.c chooses the size. */
#ifndef RT_ONESTEP_H
#define RT_ONESTEP_H

#include "session.h"

enum { RT_MOST_STAGES = 8 }; /* of any scheme */

struct rt_onestep;

typedef struct {
  int stages;
  int order;                     /* the error estimate of a step goes as h^order; 0: there is none */
  double damping;                /* PI control: exponent of the last step's error (Hairer, Norsett & Wanner I, II.4) */
  double min_factor, max_factor; /* of the step size from step to step */
  bool ends_are_stages;          /* the first stage is f at the start of the step, the last f at its end */
  bool error_has_f1;             /* no error is a number unless all f at the end of the step are */
  size_t (*work_size)(const mdl_descriptor *d); /* bytes of work space; NULL: none */
  /* From (t0, x0, f0) a step h: x1, f1 = f(t0 + h, x1) and the local error, of no use where order is 0. */
  int (*attempt)(rt_session *s, struct rt_onestep *o, double h);
  void (*dense)(int n, const struct rt_onestep *o, rt_dense *dense); /* of a system of n equations */
  /* Coefficients of an explicit scheme whose variational equations can be integrated along: nodes [stages], rows of
   * weights [stages * (stages - 1)], weights of the error [stages]. NULL: they cannot. */
  const double *nodes, *weights, *error_weights;
} rt_scheme;

typedef struct rt_onestep {
  const rt_scheme *scheme;
  void *work;                    /* of the scheme, zero at first */
  double t0, h;                  /* the last step */
  double h_next, last_log_error; /* step size control */
  double *x0, *f0, *x1, *f1;     /* [n_x] */
  double *k;                     /* [stages * n_x] */
  double *error;                 /* [n_x] */
  struct rt_onestep *tangent;    /* the variational equations, a system of n_x * columns; NULL: none */
  double *stage_x, *stage_v;     /* [stages * n_x], [stages * n_v] points of the stages, kept for them */
} rt_onestep;

void *rt_onestep_create(rt_session *s, const rt_scheme *scheme);
void rt_onestep_destroy(void *memory);
rt_status rt_onestep_begin(rt_session *s, void *memory);
rt_status rt_onestep_restart(rt_session *s, void *memory);
rt_status rt_onestep_step(rt_session *s, void *memory, double limit);
void rt_onestep_dense(rt_session *s, void *memory, rt_dense *dense);
void rt_onestep_count(rt_session *s, void *memory);
void rt_onestep_errors(rt_session *s, void *memory, double *error);

/* onestep_tangent.c */
bool rt_onestep_sensitivities(rt_session *s, void *memory);
int rt_onestep_tangent_step(rt_session *s, rt_onestep *o, double h, double *square);
void rt_onestep_tangent_accept(rt_session *s, rt_onestep *o);
void rt_onestep_dense_tangent(rt_session *s, void *memory, rt_dense *dense);
void rt_onestep_tangent_free(rt_onestep *o);
void rt_onestep_keep_stage(rt_session *s, rt_onestep *o, int j) __attribute__((noinline));

/* States are taken in pairs, whose last one overlaps the one before where their number is odd. Arrays have room for one
 * more than n, so that a single state is a pair too; what is beyond n is computed from anything and used for nothing.
 */
typedef double rt_pair __attribute__((vector_size(2 * sizeof(double)), aligned(sizeof(double)), may_alias));

static inline int rt_pair_at(int n, int i) {
  return i + 2 > n && n > 1 ? n - 2 : i;
}

static inline rt_pair rt_load(const double *a) {
  return *(const rt_pair *)a;
}

/* The same, of two numbers that have just been written one by one: for both at once the processor would have to wait.
 */
static inline rt_pair rt_load_fresh(const double *a) {
  const volatile double *each = a;
  return (rt_pair){each[0], each[1]};
}

static inline void rt_store(double *a, rt_pair pair) {
  *(rt_pair *)a = pair;
}

/* x1 = x0 + sum_j (h a_j) k_j over the first n stages, of n_x states. Inline, so that a known n unrolls, and a known
 * n_x too; what o points to is taken out of it first, as for all that is known a pair may be written over it. */
static inline __attribute__((always_inline)) const double *rt_stage(rt_onestep *o, double h, int n_x, int n,
                                                                    const double *a) {
  const double *x0 = o->x0, *k = o->k;
  double *x1 = o->x1;
  rt_pair weight[RT_MOST_STAGES];
  for (int j = 0; j < n; j++)
    weight[j] = (rt_pair){h, h} * a[j];
  for (int next = 0; next < n_x; next += 2) {
    int i = rt_pair_at(n_x, next);
    rt_pair sum = rt_load(x0 + i);
    for (int j = 0; j < n - 1; j++)
      sum += weight[j] * rt_load(k + j * n_x + i);
    if (n > 0) sum += weight[n - 1] * rt_load_fresh(k + (n - 1) * n_x + i);
    rt_store(x1 + i, sum);
  }
  return x1;
}

/* Explicit stage j at t0 + c h: k_j = f(t0 + c h, x0 + h sum_l a_l k_l), l < j; v too of the last one, the end. */
static inline __attribute__((always_inline)) int rt_explicit_stage(rt_session *s, rt_onestep *o, double h, int n_x,
                                                                   int j, double c, const double *a, bool last) {
  const double *x = rt_stage(o, h, n_x, j, a);
  double t = o->t0 + c * h, *k = o->k + j * n_x;
  int status = last || o->tangent ? rt_rhs(s, t, x, k, s->data.v) : rt_derivatives(s, t, x, k, s->data.v);
  if (o->tangent) rt_onestep_keep_stage(s, o, j);
  return status;
}

/* All stages, of a model that computes them in one call. */
static inline int rt_stages_at_once(rt_session *s, rt_onestep *o, double h, const mdl_scheme *scheme) {
  s->result->counters.rhs += scheme->stages - 1;
  int status = s->d->stages(&s->data, scheme, o->t0, h, o->x0, o->k, o->x1, s->data.v);
  s->unsettled = s->data.unsettled;
  return status;
}

#endif
