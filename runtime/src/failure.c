/* Failures: one complete sentence with time, variable or equation, and the line of the model. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>

#include "session.h"

rt_status rt_fail(rt_session *s, rt_status status, double time, int variable, const mdl_equation *where,
                  const char *format, ...) {
  rt_failure *f = &s->failure;
  *f = (rt_failure){.status = status, .time = time, .variable = variable};
  if (where) {
    f->file = where->file;
    f->line = where->line;
  } else if (variable >= 0) {
    f->file = s->d->variables[variable].file;
    f->line = s->d->variables[variable].line;
  }
  size_t size = sizeof f->message;
  int n = f->file && f->line ? snprintf(f->message, size, "%s:%d: ", f->file, f->line) : 0;
  va_list arguments;
  va_start(arguments, format);
  if (n >= 0 && (size_t)n < size) n += vsnprintf(f->message + n, size - (size_t)n, format, arguments);
  va_end(arguments);
  const char *origin = where && where->origin && where->origin[0] ? where->origin : NULL;
  if (where && n >= 0 && (size_t)n < size)
    snprintf(f->message + n, size - (size_t)n, "; in%s%s: %s", origin ? " " : "", origin ? origin : "", where->text);
  return status;
}

static const char *describe(mdl_failure_kind kind) {
  switch (kind) {
  case MDL_FAILURE_SINGULAR:
    return "a block of linear equations has no unique solution";
  case MDL_FAILURE_NEWTON:
    return "a block of nonlinear equations did not converge";
  case MDL_FAILURE_NONFINITE:
    return "the result is not a finite number";
  case MDL_FAILURE_DOMAIN:
    return "argument outside the function's domain";
  case MDL_FAILURE_ASSERT:
    return "assertion violated";
  case MDL_FAILURE_BOUND:
    return "parameter outside its bounds";
  case MDL_FAILURE_LOOP:
    return "a loop in a function ran too long";
  case MDL_FAILURE_NONE:
    break;
  }
  return "the model reported a failure without a reason";
}

static rt_status status_of(mdl_failure_kind kind) {
  switch (kind) {
  case MDL_FAILURE_NONFINITE:
    return RT_NONFINITE;
  case MDL_FAILURE_DOMAIN:
    return RT_DOMAIN;
  case MDL_FAILURE_ASSERT:
    return RT_ASSERT;
  case MDL_FAILURE_BOUND:
    return RT_BOUND;
  default:
    return RT_SINGULAR;
  }
}

static rt_status fail_bound(rt_session *s, double time, const mdl_failure *f) {
  const mdl_variable *v = &s->d->variables[f->variable];
  return rt_fail(s, RT_BOUND, time, f->variable, NULL, "parameter %s = %.9g is outside its bounds [%.9g, %.9g] %s",
                 v->name, f->value, v->min, v->max, v->unit);
}

static rt_status fail_assert(rt_session *s, double time, const mdl_equation *where) {
  const char *component = where->origin;
  rt_fail(s, RT_ASSERT, time, -1, NULL, "%s:%d: %s%sassertion violated at time %.9g s: %s", where->file, where->line,
          component, component[0] ? ": " : "", time, where->text);
  s->failure.file = where->file;
  s->failure.line = where->line;
  return RT_ASSERT;
}

/* Turn the failure that a model function has left in m->failure into the session's. `doing` says what for. */
rt_status rt_fail_model(rt_session *s, double time, const char *doing) {
  const mdl_descriptor *d = s->d;
  const mdl_failure *f = &s->data.failure;
  bool is_assert = f->kind == MDL_FAILURE_ASSERT;
  const mdl_equation *table = is_assert ? d->asserts : d->equations;
  int size = is_assert ? d->n_asserts : d->n_equations;
  const mdl_equation *where = f->equation >= 0 && f->equation < size ? &table[f->equation] : NULL;
  bool named = f->variable >= 0 && f->variable < d->n_variables;
  int variable = named ? f->variable : -1;
  if (f->kind == MDL_FAILURE_BOUND && named) return fail_bound(s, time, f);
  if (is_assert && where) return fail_assert(s, time, where);
  return rt_fail(s, status_of(f->kind), time, variable, where, "%s at time %.9g s: %s%s%s (value %.9g)", doing, time,
                 describe(f->kind), named ? ", variable " : "", named ? d->variables[variable].name : "", f->value);
}

/* The solver asks for steps of h seconds, too small to get anywhere: the fault is in the state that changes fastest. */
rt_status rt_fail_collapse(rt_session *s, double h, const char *why) {
  const mdl_data *m = &s->data;
  if (m->failure.kind != MDL_FAILURE_NONE) return rt_fail_model(s, s->t, "integrating");
  int worst = 0;
  double largest = 0;
  for (int i = 0; i < s->d->n_x; i++) {
    double speed = fabs(m->xdot[i]) / (s->atol[i] + s->options.rtol * fabs(m->x[i]));
    if (speed > largest) worst = i;
    largest = fmax(largest, speed);
  }
  int variable = rt_state_variable(s, worst);
  const char *name = variable >= 0 ? s->d->variables[variable].name : "a state";
  return rt_fail(s, RT_STEP_COLLAPSE, s->t, variable, NULL,
                 "solver %s makes no progress at time %.9g s: %s (step %.3g s); %s changes fastest", s->method->name,
                 s->t, why, h, name);
}
