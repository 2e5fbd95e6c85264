/* SUNDIALS IDA (variable-order BDF) on the residual form, with the model's analytic Jacobian.
 *
 * Events are located by the runtime on IDA's own interpolating polynomial, so IDA has no root functions. After an event
 * x' and z are known exactly from the explicit form: IDA restarts from them without solving for consistent values. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "ida.h"
#include "swings.h"
#include "vector.h"

static const double alike = 1.5e-8;           /* root of rounding */
static const double finest = 8 * DBL_EPSILON; /* relative tolerance that steps can still be tested by */
static const double relief =
    1.02; /* of the tolerances in a step: a guard that swings comes back before they are slack */
enum {
  STALLS = 4
};                      /* steps in a row that left a branch, vanished, or took Newton's method more than one attempt,
                         * by one more than those that did not: IDA does not get on by itself */
enum { RESOLVING = 3 }; /* order from which on polynomials bend as guards do; below, IDA is starting */
/* IDA doubles a step where that errs by its tolerance at most, and then keeps it: it gets half of what is allowed. */
static const double half = 0.5;
static const double newton = 0.03;              /* of the tolerances: error of a step by Newton's method */
static const double untested = 1 / DBL_EPSILON; /* of the tolerances: the steps of a start have been tested */
enum { MAX_ERROR_FAILS = 25 }; /* in one step: each divides it by four, and a first step may be far too long */

static void destroy(void *p) {
  rt_ida *m = p;
  rt_ida_tangent_free(m);
  if (m->ida) IDAFree(&m->ida);
  if (m->newton) SUNNonlinSolFree(m->newton);
  if (m->solver) SUNLinSolFree(m->solver);
  if (m->matrix) SUNMatDestroy(m->matrix);
  N_Vector vectors[] = {m->y, m->yp, m->work, m->filtered, m->broken};
  for (size_t i = 0; i < sizeof vectors / sizeof *vectors; i++)
    if (vectors[i]) N_VDestroy(vectors[i]);
  if (m->context) SUNContext_Free(&m->context);
  free(m->values);
  free(m->row);
  free(m->past);
  free(m->starts);
  if (m->starter) rt_method_dopri5.destroy(m->starter);
  free(m);
}

static bool create_vectors(rt_session *s, rt_ida *m) {
  sunindextype n = s->d->n_x + s->d->n_z;
  N_Vector *vectors[] = {&m->y, &m->yp, &m->work, &m->filtered, &m->broken};
  for (size_t i = 0; i < sizeof vectors / sizeof *vectors; i++)
    if (!(*vectors[i] = rt_vector_new(n, m->context))) return false;
  return true;
}

/* Weights of the error test, by tolerances that follow the sizes of the states. */
static int weights(N_Vector y, N_Vector weight, void *user) {
  const rt_session *s = user;
  const rt_ida *m = s->memory;
  const double *value = N_VGetArrayPointer(y);
  double *w = N_VGetArrayPointer(weight), share = m->known < RT_IDA_STARTS ? untested : half * m->share;
  for (int i = 0; i < s->d->n_x + s->d->n_z; i++)
    w[i] = 1 / (share * (s->options.rtol * fabs(value[i]) + s->atol[i]));
  return 0;
}

/* Algebraic unknowns are left out of the error test: their z' at a restart is only a difference quotient. */
static bool set_options(rt_session *s, rt_ida *m) {
  for (int i = 0; i < s->d->n_x; i++)
    N_VGetArrayPointer(m->work)[i] = 1;
  return rt_silence(m->context, m->ida) == 0 && IDASetUserData(m->ida, s) == IDA_SUCCESS &&
         IDAWFtolerances(m->ida, weights) == IDA_SUCCESS && IDASetId(m->ida, m->work) == IDA_SUCCESS &&
         IDASetSuppressAlg(m->ida, s->d->n_z > 0) == IDA_SUCCESS && IDASetMaxNumSteps(m->ida, -1) == IDA_SUCCESS &&
         IDASetMaxErrTestFails(m->ida, MAX_ERROR_FAILS) == IDA_SUCCESS &&
         IDASetNonlinConvCoef(m->ida, newton) == IDA_SUCCESS &&
         (!(s->options.max_step > 0) || IDASetMaxStep(m->ida, s->options.max_step) == IDA_SUCCESS);
}

static void *create(rt_session *s) {
  rt_ida *m = calloc(1, sizeof *m);
  if (!m) return NULL;
  m->values = calloc((size_t)s->d->jac_nnz + 1, sizeof *m->values);
  m->row = calloc((size_t)(s->d->n_x + s->d->n_z), sizeof *m->row);
  m->past = calloc(RT_IDA_POINTS * (size_t)s->d->n_x, sizeof *m->past);
  m->starts = calloc(RT_IDA_STARTS * (size_t)(s->d->n_x + s->d->n_z), sizeof *m->starts);
  m->starter = rt_method_dopri5.create(s);
  m->known = RT_IDA_STARTS;
  if (m->values && m->row && m->past && m->starts && m->starter && SUNContext_Create(SUN_COMM_NULL, &m->context) == 0 &&
      create_vectors(s, m) && (m->ida = IDACreate(m->context)) &&
      IDAInit(m->ida, rt_ida_residual, 0, m->y, m->yp) == IDA_SUCCESS && set_options(s, m) &&
      rt_ida_create_matrix(s, m))
    return m;
  destroy(m);
  return NULL;
}

static void count(rt_session *s, void *p) {
  rt_ida *m = p;
  if (!m->started) return;
  m->started = false;
  long steps = 0, residuals = 0, setups = 0, fails = 0, jacobians = 0, iterations = 0, newton_fails = 0;
  int order, next_order;
  sunrealtype h0, h, h_next, t;
  IDAGetIntegratorStats(m->ida, &steps, &residuals, &setups, &fails, &order, &next_order, &h0, &h, &h_next, &t);
  IDAGetNumJacEvals(m->ida, &jacobians);
  IDAGetNonlinSolvStats(m->ida, &iterations, &newton_fails);
  rt_counters *c = &s->result->counters;
  c->steps += steps - m->start_steps;
  c->error_test_fails += fails;
  c->jacobians += jacobians;
  c->newton_iterations += iterations;
  c->newton_fails += newton_fails;
}

static rt_status restart(rt_session *s, void *p) {
  rt_ida *m = p;
  size_t n = (size_t)(s->d->n_x + s->d->n_z);
  count(s, m);
  rt_residual_point(s);
  double h = m->h_first = rt_min(rt_ida_first_step(s, s->yp + s->d->n_x), m->longest);
  memcpy(N_VGetArrayPointer(m->y), s->y, n * sizeof *s->y);
  memcpy(N_VGetArrayPointer(m->yp), s->yp, n * sizeof *s->yp);
  if (IDAReInit(m->ida, s->t, m->y, m->yp) != IDA_SUCCESS || IDASetInitStep(m->ida, h) != IDA_SUCCESS)
    return rt_fail(s, RT_STEP_COLLAPSE, s->t, -1, NULL, "IDA refuses to restart at time %.9g s", s->t);
  rt_ida_remember(s, m, s->t, s->data.x, true);
  m->started = m->fresh = true;
  m->known = RT_IDA_STARTS;
  m->start_steps = 0;
  m->newton_fails = 0;
  rt_newton_forget(m->newton);
  m->serves = false;
  m->pivots_chosen_at = -1; /* other equations hold, and the old pivots may have become tiny */
  return rt_ida_tangent_restart(s, m);
}

static rt_status begin(rt_session *s, void *p) {
  rt_ida *m = p;
  m->share = 1;
  m->longest = INFINITY;
  m->length = 0;
  rt_status status = rt_check_forms(s);
  return status ? status : restart(s, m);
}

static void errors(rt_session *s, void *p, double *error) {
  rt_ida *m = p;
  if (IDAGetEstLocalErrors(m->ida, m->work) == IDA_SUCCESS)
    memcpy(error, N_VGetArrayPointer(m->work), (size_t)s->d->n_x * sizeof *error);
}

/* The residual that is no finite number may be that of another equation, which is in it: the explicit form says which.
 */
static void blame(rt_session *s, void *p) {
  rt_ida *m = p;
  mdl_failure told = s->data.failure;
  if (told.kind != MDL_FAILURE_NONFINITE || !s->d->rhs) return;
  memcpy(s->v_trial, s->data.v, (size_t)s->d->n_v * sizeof *s->v_trial);
  rt_rhs(s, m->t_broken, N_VGetArrayPointer(m->broken), s->xdot_trial, s->v_trial);
  if (!rt_blame(s, MDL_DERIVATIVE, s->xdot_trial, s->v_trial)) s->data.failure = told;
}

static rt_status fail(rt_session *s, rt_ida *m, int flag) {
  sunrealtype h = 0;
  IDAGetCurrentStep(m->ida, &h);
  if (flag == IDA_CONV_FAIL && s->data.failure.kind == MDL_FAILURE_NONE) return rt_ida_fail_newton(s, m, h);
  return rt_fail_collapse(s, h, flag == IDA_ERR_FAIL ? "the error test fails" : "it gave up");
}

/* Whether algebraic unknowns z of the residual form are others than those in v, which the explicit form gives: by more
 * than ten times their tolerance. Values of linear equations differ by rounding alone, however tight the tolerance; and
 * so do those of nonlinear ones, up to the root of rounding where two branches meet. */
static bool differ(const rt_session *s, const double *z, const double *v) {
  const double *nominal = s->nominal + s->d->n_x, *atol = s->atol + s->d->n_x;
  for (int k = 0; k < s->d->n_z && !s->undetermined; k++) {
    if (s->d->z_branches && !s->d->z_branches[k]) continue;
    double least = rt_max(10 * (s->options.rtol * fabs(z[k]) + atol[k]), alike * rt_max(fabs(z[k]), nominal[k]));
    if (fabs(v[s->d->z_index[k]] - z[k]) > least) return true;
  }
  return false;
}

/* How much too large the step to `end` is for the guards (swings.c): up to 1 it is not. The tolerances of the next
 * steps follow it. */
static double test_guards(rt_session *s, rt_ida *m, double end) {
  if (!s->d->guard_rates) return 0;
  int order = 1;
  double *error = s->xdot_trial;
  memset(error, 0, (size_t)s->d->n_x * sizeof *error);
  errors(s, m, error);
  s->dense.valid = false;
  IDAGetLastOrder(m->ida, &order);
  double excess = order < RESOLVING ? rt_swing_roughness(s, end, error) : rt_swing_error(s, end, error);
  if (excess > 1)
    m->share *= rt_min(0.5, rt_max(0.1, 0.3 / excess));
  else if (order >= RESOLVING)
    m->share = rt_min(1, m->share * rt_min(relief, 0.5 / rt_max(excess, 0.25)));
  return excess;
}

/* One step, again from its start while it strays, or with smaller tolerances while guards ask for it. */
static int attempt(rt_session *s, rt_ida *m, double limit, sunrealtype *t, rt_status *status) {
  IDASetStopTime(m->ida, limit);
  if (m->known < RT_IDA_STARTS) {
    m->start_steps = RT_IDA_STARTS;
    int flag = rt_ida_follow_start(m, limit);
    if (flag < 0) return flag;
  }
  for (;;) {
    int flag = IDASolve(m->ida, limit, t, m->y, m->yp, IDA_ONE_STEP);
    double end = flag == IDA_TSTOP_RETURN ? limit : *t;
    if (flag >= 0) rt_ida_remember(s, m, end, N_VGetArrayPointer(m->y), false);
    if (flag < 0) return flag;
    bool rough = test_guards(s, m, end) > 1;
    if (!rough && !rt_branch_strays(s, end, NV_DATA_S(m->y), NV_DATA_S(m->yp), false, status)) return flag;
    s->result->counters.error_test_fails++;
    if (rough && m->share * s->options.rtol < finest) *status = rt_swing_fail(s, end);
    m->longest = 0.25 * (end - s->t);
    if (*status || (*status = restart(s, m))) return flag;
    m->longest = INFINITY;
    m->fresh = false;
    IDASetStopTime(m->ida, limit);
  }
}

/* From the algebraic unknowns that IDA has found, which near the end of where an equation has values may lie behind it
 * by less than the tolerance; else from those of the branch. */
static int evaluate(rt_session *s) {
  mdl_data *m = &s->data;
  int status = rt_rhs(s, s->t, m->x, m->xdot, m->v);
  if (status && rt_branch_take(s)) status = rt_rhs(s, s->t, m->x, m->xdot, m->v);
  return status ? status : rt_check_finite(s, m->xdot);
}

/* A step that Newton's method has failed in counts twice: IDA takes two steps from failure to failure where it tries
 * twice the length at every second one, in vain. */
static void count_stalls(rt_ida *m, bool apart) {
  long fails = 0;
  IDAGetNumNonlinSolvConvFails(m->ida, &fails);
  if (apart || fails > m->newton_fails)
    m->stalls += apart ? 1 : 2;
  else if (m->stalls > 0)
    m->stalls--;
  m->newton_fails = fails;
}

static bool steps_over(rt_session *s, rt_ida *m, double limit) {
  sunrealtype h = 0;
  m->stalls = STALLS / 2;
  return IDAGetCurrentStep(m->ida, &h) == IDA_SUCCESS && rt_ida_step_over(s, m, fabs(h), limit);
}

static rt_status step(rt_session *s, void *p, double limit) {
  rt_ida *m = p;
  sunrealtype t = s->t;
  rt_status status = RT_OK;
  bool fresh = m->fresh;
  m->fresh = false;
  if ((m->stalls > STALLS || s->tiny_steps > STALLS) && steps_over(s, m, limit)) return RT_OK;
  if (fresh && rt_ida_start(s, m, limit)) return RT_OK;
  int flag = attempt(s, m, limit, &t, &status);
  if (status) return status;
  if (flag < 0 && steps_over(s, m, limit)) return RT_OK;
  if (flag < 0) return fail(s, m, flag);
  const double *y = N_VGetArrayPointer(m->y), *z = y + s->d->n_x;
  memcpy(s->data.x, y, (size_t)s->d->n_x * sizeof *y);
  for (int k = 0; k < s->d->n_z; k++)
    s->data.v[s->d->z_index[k]] = z[k];
  s->t = flag == IDA_TSTOP_RETURN ? limit : t;
  if (evaluate(s)) return rt_fail_model(s, s->t, "evaluating the explicit form");
  bool apart = differ(s, z, s->data.v);
  if (apart) s->pending |= RT_PENDING_BRANCH;
  count_stalls(m, apart);
  return rt_ida_tangent_step(s, m);
}

const rt_method rt_method_ida = {
    .name = "ida",
    .multistep = true,
    .create = create,
    .destroy = destroy,
    .begin = begin,
    .restart = restart,
    .step = step,
    .dense = rt_ida_dense,
    .count = count,
    .errors = errors,
    .blame = blame,
    .filter = rt_ida_filter,
    .sensitivities = rt_ida_sensitivities,
    .dense_tangent = rt_ida_dense_tangent,
};
