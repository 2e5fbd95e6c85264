/* One-step methods: a scheme computes one step of given size, the driver in onestep.c chooses the size. */
#ifndef RT_ONESTEP_H
#define RT_ONESTEP_H

#include "session.h"

struct rt_onestep;

typedef struct {
  int stages;
  int order;  /* the error estimate of a step goes as h^order; 0: there is none */
  double damping; /* PI control: exponent of the last step's error (Hairer, Norsett & Wanner I, II.4) */
  double min_factor, max_factor; /* of the step size from step to step */
  size_t (*work_size)(const mdl_descriptor *d); /* bytes of work space; NULL: none */
  /* From (t0, x0, f0) a step h: x1, f1 = f(t0 + h, x1) and the error in units of the tolerance. */
  int (*attempt)(rt_session *s, struct rt_onestep *o, double h, double *error);
  void (*dense)(const rt_session *s, const struct rt_onestep *o, rt_dense *dense);
} rt_scheme;

typedef struct rt_onestep {
  const rt_scheme *scheme;
  void *work;                /* of the scheme, zero at first */
  double t0, h;              /* the last step */
  double h_next, last_error; /* step size control */
  double *x0, *f0, *x1, *f1; /* [n_x] */
  double *k;                 /* [stages * n_x] */
  double *x_stage;           /* [n_x] */
} rt_onestep;

void *rt_onestep_create(rt_session *s, const rt_scheme *scheme);
void rt_onestep_destroy(void *memory);
rt_status rt_onestep_begin(rt_session *s, void *memory);
rt_status rt_onestep_restart(rt_session *s, void *memory);
rt_status rt_onestep_step(rt_session *s, void *memory, double limit);
void rt_onestep_dense(rt_session *s, void *memory, rt_dense *dense);
void rt_onestep_count(rt_session *s, void *memory);

/* Root mean square of e_i / (atol_i + rtol max(|x0_i|, |x1_i|)). */
double rt_error_norm(const rt_session *s, const rt_onestep *o, const double *e);
/* x_stage = x0 + sum_j (h a_j) k_j over the first n stages. */
const double *rt_stage(const rt_session *s, rt_onestep *o, double h, int n, const double *a);

#endif
