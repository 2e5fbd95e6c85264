/* Checks of accepted points: every variable is a finite number, and no divisor has passed through zero unseen.
 *
 * What is wrong is told at the first equation, in the order in which they are computed, that gives no finite number:
 * the others only pass it on. */
#include <math.h>
#include <string.h>

#include "session.h"

enum { HALVINGS = 45 };             /* of a step, to find where a divisor is zero */
static const double pole = 1e6;     /* growth of a quotient on the way there that tells a pole from 0/0 */
static const double shrunk = 1e3;   /* by what a divisor does so at least, or the quotient grows with its numerator */
static const double impulse = 1e-6; /* of a size: far above the 1e-10 to which the instant is known */
static const double bend = 8;       /* most that a divisor may change by where it is zero, of what it does elsewhere */

rt_status rt_check_parameters(rt_session *s) {
  if (!rt_finite(s->d->n_p, s->data.p) && rt_blame(s, MDL_PARAMETER, NULL, NULL))
    return rt_fail_model(s, s->start, "computing parameters");
  for (int i = 0; i < s->d->n_variables; i++) {
    const mdl_variable *v = &s->d->variables[i];
    if (v->storage != MDL_PARAMETER || v->type != MDL_INTEGER || !(fabs(s->data.p[v->index]) > RT_LARGEST_INTEGER))
      continue;
    return rt_fail(s, RT_DOMAIN, s->start, i, NULL, "the Integer %s is %.17g: from 2^53 on not all are told apart",
                   v->name, s->data.p[v->index]);
  }
  return RT_OK;
}

/* Finite numbers in v [n_v], at a point at time t. */
rt_status rt_check_values(rt_session *s, double t, const double *x, const double *xdot, const double *v) {
  if (s->options.unchecked || rt_finite(s->d->n_v, v) || !rt_blame(s, MDL_ALGEBRAIC, xdot, v)) return RT_OK;
  memmove(s->data.x, x, (size_t)s->d->n_x * sizeof *x); /* what the message shows */
  memmove(s->data.v, v, (size_t)s->d->n_v * sizeof *v);
  return rt_fail_model(s, t, "computing variables");
}

/* A guard that is no number: it matters where every evaluation asks for it, and where it was one and no event lies
 * between then and now. */
static rt_status check_guards(rt_session *s, bool fresh) {
  for (int r = 0; r < s->d->n_rel; r++)
    if (isnan(s->g[r]) && ((s->d->relations[r].kind & MDL_ASKED) || (!fresh && isfinite(s->g_previous[r]))))
      return rt_fail(s, RT_NONFINITE, s->t, -1, &s->d->relations[r].source,
                     "at time %.9g s one side of this relation is not a number", s->t);
  return RT_OK;
}

static const double no_boolean = -1; /* what generated code gives a Boolean without a value */

/* An Integer that grew to where not all are exact, as by overflow in other tools; a Boolean without a value: an element
 * of an array by a subscript outside of it. */
static rt_status check_integers(rt_session *s) {
  for (int i = 0; i < s->d->n_d; i++) {
    bool nothing = s->data.d[i] == no_boolean;
    if (!nothing && !(fabs(s->data.d[i]) > RT_LARGEST_INTEGER)) continue;
    int row = rt_find_row(s, MDL_DISCRETE, i);
    if (nothing && row >= 0 && s->d->variables[row].type == MDL_BOOLEAN)
      return rt_fail(s, RT_NONFINITE, s->t, row, NULL, "at time %.9g s the Boolean %s has no value", s->t,
                     s->d->variables[row].name);
    if (nothing) continue;
    if (row >= 0 && s->d->variables[row].type == MDL_INTEGER)
      return rt_fail(s, RT_DOMAIN, s->t, row, NULL,
                     "at time %.9g s the Integer %s is %.17g: from 2^53 on not all are told apart", s->t,
                     s->d->variables[row].name, s->data.d[i]);
  }
  return RT_OK;
}

static rt_status check_discrete(rt_session *s) {
  if (rt_finite(s->d->n_d, s->data.d)) return check_integers(s);
  int i = 0;
  while (isfinite(s->data.d[i]))
    i++;
  int row = rt_find_row(s, MDL_DISCRETE, i);
  const char *name = row >= 0 ? s->d->variables[row].name : "without a name";
  if (row >= 0 && s->d->variables[row].type == MDL_INTEGER && isnan(s->data.d[i]))
    return rt_fail(
        s, RT_DOMAIN, s->t, row, NULL,
        "at time %.9g s the Integer %s has no value: a sum or product on the way to it reaches 2^53, from where "
        "not all are told apart, a divisor is zero, or no literal of its enumeration has that number",
        s->t, name);
  return rt_fail(s, RT_NONFINITE, s->t, row, NULL, "at time %.9g s the discrete variable %s is %.9g", s->t, name,
                 s->data.d[i]);
}

static int sign(double a) {
  return (a > 0) - (a < 0);
}

/* Numerators and divisors at time t inside the last step. */
static int divisions_at(rt_session *s, double t) {
  rt_dense_eval(&s->dense, s->d->n_x, t, s->x_trial);
  int status = rt_rhs(s, t, s->x_trial, s->xdot_trial, s->v_trial);
  return status ? status : s->d->divisions(&s->data, t, s->x_trial, s->xdot_trial, s->v_trial, s->division);
}

/* The divisor of division k has changed its sign against the numerator's in the last step: it is a pole where the
 * quotient grows without bound on the way there, beyond what it is at both ends, as its divisor vanishes. Where the
 * rounding of time ends the way before that tells, it is one unless the divisor jumps: unless it changes by far more
 * than its share of the step's change in what is left. */
static rt_status look_for_pole(rt_session *s, int k) {
  double *value = s->division + 2 * k, a = s->t_previous, b = s->t;
  int before = s->division_sign[k];
  double ordinary = fabs(value[0] / value[1]), divisor = fabs(value[1]), nearest, at_a = NAN, at_b = value[1];
  rt_dense_prepare(s);
  memcpy(s->v_trial, s->data.v, (size_t)s->d->n_v * sizeof *s->v_trial); /* nonlinear blocks start near their roots */
  if (!divisions_at(s, a)) {
    ordinary = fmax(ordinary, fabs(value[0] / value[1]));
    divisor = fmax(divisor, fabs(value[1]));
    at_a = value[1];
  }
  double at = NAN, numerator = 0;
  for (int i = 0; i < HALVINGS; i++) {
    double middle = 0.5 * (a + b);
    if (!(middle > a && middle < b)) break;
    if (divisions_at(s, middle)) return rt_fail_model(s, middle, "looking for a division by zero");
    nearest = fabs(value[0] / value[1]);
    if (isnan(nearest)) { /* 0/0, or a branch that does not hold there */
      at_a = NAN;
      break;
    }
    bool short_of = sign(value[0] * value[1]) == before;
    *(short_of ? &a : &b) = middle;
    *(short_of ? &at_a : &at_b) = value[1];
    if (nearest > pole * ordinary && fabs(value[1]) * shrunk < divisor) {
      at = middle;
      numerator = value[0];
    }
  }
  double change = fabs(at_b - at_a) * (s->t - s->t_previous); /* over b - a, of the step's */
  if (isnan(at) && change <= bend * divisor * (b - a) && sign(at_a) != sign(at_b)) at = b, numerator = value[0];
  if (isnan(at)) return RT_OK;
  return rt_fail(s, RT_DOMAIN, at, -1, &s->d->equations[s->d->division_equation[k]],
                 "division by zero: a divisor passes through zero at time %.9g s (numerator %.3g)", at, numerator);
}

/* Divisors on their way since the last accepted point; `fresh`: there is none, an event lies between. */
static rt_status check_divisions(rt_session *s, bool fresh) {
  const mdl_descriptor *d = s->d;
  if (!d->n_divisions) return RT_OK;
  if (d->divisions(&s->data, s->t, s->data.x, s->data.xdot, s->data.v, s->division))
    return rt_fail_model(s, s->t, "checking divisors");
  for (int k = 0; k < d->n_divisions; k++) {
    double numerator = s->division[2 * k], divisor = s->division[2 * k + 1], product = numerator * divisor;
    if (divisor == 0 && fabs(numerator) > 0) /* what is infinite may be finite again: atan(1/x) */
      return rt_fail(s, RT_DOMAIN, s->t, -1, &d->equations[d->division_equation[k]],
                     "division by zero at time %.9g s (numerator %.3g)", s->t, numerator);
    int now = sign(product), before = s->division_sign[k];
    if (isnan(product) || fresh || now) s->division_sign[k] = (signed char)now;
    if (fresh || isnan(product) || now * before >= 0) continue;
    s->division_sign[k] = (signed char)before;
    rt_status status = look_for_pole(s, k);
    if (status) return status;
    s->division_sign[k] = (signed char)now;
    d->divisions(&s->data, s->t, s->data.x, s->data.xdot, s->data.v, s->division);
  }
  return RT_OK;
}

/* After an event that has set no state: what has a derivative must not have jumped, or that would be an impulse. Where
 * a guard is located to 1e-10 of its size, branches that meet differ by as little. */
rt_status rt_check_lasting(rt_session *s) {
  const double *now = s->data.v, *before = s->v_before;
  for (int k = 0; k < s->d->n_lasting && !s->reinitialised; k++) {
    const mdl_lasting *l = &s->d->lasting[k];
    int i = l->index, row;
    double size = rt_max(fabs(now[i]), fabs(before[i]));
    size = rt_max(size, rt_max(fabs(now[l->rate]), fabs(before[l->rate])) * (s->stop - s->start));
    if (!(fabs(now[i] - before[i]) > impulse * size)) continue;
    row = rt_find_row(s, MDL_ALGEBRAIC, i);
    return rt_fail(s, RT_SINGULAR, s->t, row, &s->d->equations[l->equation],
                   "at time %.9g s an event makes %s jump from %.9g to %.9g, of which the model has the derivative: "
                   "that would be an impulse; let it go on in all branches, or set a state by reinit",
                   s->t, row < 0 ? "a variable" : s->d->variables[row].name, before[i], now[i]);
  }
  return RT_OK;
}

/* The accepted point; `fresh`: after an event or at the start. Where an event is about to happen, what is no number
 * may come from the branch that it leaves. */
rt_status rt_check_point(rt_session *s, bool fresh) {
  const mdl_descriptor *d = s->d;
  if (s->options.unchecked) return RT_OK;
  if (!fresh && !d->n_divisions && !s->unsettled && rt_finite(d->n_v, s->data.v) && rt_finite(d->n_rel, s->g))
    return RT_OK;
  bool leaving = s->pending & RT_PENDING_STATE;
  rt_status status = leaving ? RT_OK : rt_check_values(s, s->t, s->data.x, s->data.xdot, s->data.v);
  if (!status && !leaving) status = check_guards(s, fresh);
  if (!status && !leaving && rt_check_settled(s, s->unsettled)) status = rt_fail_model(s, s->t, "evaluating");
  if (!status && !leaving && fresh) status = check_discrete(s);
  return status ? status : check_divisions(s, fresh);
}
