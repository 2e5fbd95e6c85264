/* What ida.c and ida_tangent.c share: IDA's memory of one session. */
#ifndef RT_IDA_H
#define RT_IDA_H

#include "sensitivity.h"
#include "sundials_compat.h"

enum { RT_IDA_POINTS = RT_DENSE_DEGREE + 1, RT_IDA_STARTS = 5 };

typedef struct {
  SUNContext context;
  void *ida;
  N_Vector y, yp, work, filtered;
  N_Vector broken; /* where the residual was last no finite number, */
  double t_broken; /* and when (s) */
  SUNMatrix matrix;
  SUNLinearSolver solver;
  SUNNonlinearSolver newton;
  double *values, *row;  /* [jac_nnz]; [n_x + n_z] factors of the rows of a dense matrix */
  bool serves;           /* the matrix is of the present equations */
  double cj_of_matrix;   /* dF/dy + cj dF/dy' is in the matrix (1/s) */
  bool started;          /* IDA holds counters of this run that are not in the result yet */
  long pivots_chosen_at; /* failures of Newton's method when KLU last chose its pivots; -1: before the restart */
  double longest;        /* first step that guards allow (s) */
  double *past, past_t[RT_IDA_POINTS];    /* [RT_IDA_POINTS * n_x] states at the ends of the last steps (s), a ring */
  int latest, first;                      /* rows of the last of them, and of the start of the session's last step */
  int order;                              /* of the polynomial of that step */
  struct rt_onestep *starter;             /* ida_start.c: its method */
  double length, h_first;                 /* of the last start, and of the first step of IDA (s) */
  double *starts, start_t[RT_IDA_STARTS]; /* [RT_IDA_STARTS * (n_x + n_z)] points of a start */
  int start_steps;                        /* of IDA's, that were those of a start */
  bool fresh;                             /* restarted, no step yet */
  int stalls;                             /* steps that did not get on, less those that did */
  long newton_fails;                      /* of IDA's since the restart, up to the last step */
  int known;                              /* of those, IDA has taken so many */
  long taken;                             /* steps that IDA had taken there */
  double share;                           /* of the tolerances, that guards far smaller than the states leave of them */
  int held;                               /* terms of undetermined.c in the matrix that KLU has ordered */
  int columns;                            /* sensitivities that IDA is set up for */
  N_Vector *tangent_y, *tangent_yp, *tangent_atol; /* [columns] */
  double *rows_y, *rows_yp, *rows_r; /* the same as rows of a bundle, [(n_x + n_z) * columns of the bundle] */
} rt_ida;

/* newton.c; NULL without memory */
int rt_ida_residual(sunrealtype t, N_Vector y, N_Vector yp, N_Vector r, void *session);
int rt_ida_not_finite(rt_session *s, int row, double value);
SUNNonlinearSolver rt_newton_new(rt_session *s, SUNContext context);
void rt_newton_forget(SUNNonlinearSolver solver);

/* ida_matrix.c */
bool rt_ida_create_matrix(rt_session *s, rt_ida *m);
void rt_ida_filter(rt_session *s, void *memory, double t, double *defect);

/* ida_start.c */
double rt_ida_first_step(rt_session *s, double *zdot);
bool rt_ida_start(rt_session *s, rt_ida *m, double limit);
bool rt_ida_step_over(rt_session *s, rt_ida *m, double h, double limit);
int rt_ida_follow_start(rt_ida *m, double limit);

/* ida_dense.c */
void rt_ida_push(const rt_session *s, rt_ida *m, double t, const double *x);
void rt_ida_remember(const rt_session *s, rt_ida *m, double t, const double *x, bool begins);
void rt_ida_dense(rt_session *s, void *memory, rt_dense *out);

/* ida_failure.c */
rt_status rt_ida_fail_newton(rt_session *s, rt_ida *m, double h);

/* ida_tangent.c */
bool rt_ida_sensitivities(rt_session *s, void *memory);
rt_status rt_ida_tangent_restart(rt_session *s, rt_ida *m);
rt_status rt_ida_tangent_step(rt_session *s, rt_ida *m);
void rt_ida_dense_tangent(rt_session *s, void *memory, rt_dense *out);
void rt_ida_tangent_free(rt_ida *m);

#endif
