/* Failures: one complete sentence with time, variable or equation, and the line of the model. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

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
    return "linear equations have no solution, or no unique one";
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
    return "a loop or a function ran too long";
  case MDL_FAILURE_STACK:
    return "functions called each other too deep, or their arrays are too large";
  case MDL_FAILURE_FOREIGN:
    return "external C ended in an error, which it told above";
  case MDL_FAILURE_RELATION:
    return "one side of a relation is not a number (a root or logarithm of what has none, 0/0, Integers from 2^53 on)";
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
  case MDL_FAILURE_RELATION:
  case MDL_FAILURE_LOOP:
  case MDL_FAILURE_STACK:
    return RT_DOMAIN;
  case MDL_FAILURE_ASSERT:
  case MDL_FAILURE_FOREIGN:
    return RT_ASSERT;
  case MDL_FAILURE_BOUND:
    return RT_BOUND;
  default:
    return RT_SINGULAR;
  }
}

rt_status rt_fail_bound(rt_session *s, double time, int variable, double value, double min, double max) {
  const mdl_variable *v = &s->d->variables[variable];
  return rt_fail(s, RT_BOUND, time, variable, NULL, "parameter %s = %.9g is outside its bounds [%.9g, %.9g] %s",
                 v->name, value, min, max, v->unit);
}

/* A bound that follows other parameters is not in the table: the model says what it was. */
static rt_status fail_bound(rt_session *s, double time, const mdl_failure *f) {
  const mdl_variable *v = &s->d->variables[f->variable];
  double min = f->value < f->bound ? f->bound : v->min, max = f->value > f->bound ? f->bound : v->max;
  return rt_fail_bound(s, time, f->variable, f->value, min, max);
}

static double present_value(const rt_session *s, const mdl_variable *v) {
  const mdl_data *m = &s->data;
  const double *const arrays[] = {[MDL_STATE] = m->x,     [MDL_ALGEBRAIC] = m->v, [MDL_DISCRETE] = m->d,
                                  [MDL_PARAMETER] = m->p, [MDL_INPUT] = m->u,     [MDL_DERIVATIVE] = m->xdot};
  return v->sign * arrays[v->storage][v->index];
}

/* Append the values of variables: ` (a.y_min = 3 V, a.y_max = 1 V)`. */
static void append_values(rt_session *s, int n_values, const int *rows) {
  char *message = s->failure.message;
  size_t size = sizeof s->failure.message, n = strlen(message);
  for (int k = 0; k < n_values && n < size; k++) {
    const mdl_variable *v = &s->d->variables[rows[k]];
    int written = snprintf(message + n, size - n, "%s%s = %.9g%s%s", k ? ", " : " (", v->name, present_value(s, v),
                           v->unit[0] ? " " : "", v->unit);
    n += written > 0 ? (size_t)written : 0;
  }
  if (n_values && n < size) snprintf(message + n, size - n, ")");
}

/* The values of the variables of an equation. */
void rt_append_equation(rt_session *s, int equation) {
  const int *first = s->d->equation_first + equation;
  append_values(s, first[1] - first[0], s->d->equation_variables + first[0]);
}

static rt_status fail_assert(rt_session *s, double time, const mdl_assert *rule) {
  const mdl_equation *where = &rule->source;
  const char *component = where->origin;
  rt_fail(s, RT_ASSERT, time, -1, NULL, "%s:%d: %s%sassertion violated at time %.9g s: %s", where->file, where->line,
          component, component[0] ? ": " : "", time, where->text);
  append_values(s, rule->n_values, rule->values);
  s->failure.file = where->file;
  s->failure.line = where->line;
  return RT_ASSERT;
}

/* Warnings that are violated for the first time in the run. */
void rt_tell_warnings(rt_session *s) {
  for (int k = 0; k < s->d->n_asserts; k++) {
    if (s->data.warned[k] != 1) continue;
    s->data.warned[k] |= 2;
    (void)fail_assert(s, s->t, &s->d->asserts[k]);
    rt_result_warn(s->result, s->failure.message);
    s->failure = (rt_failure){0};
  }
}

/* A call that does not end, told at its function. */
static rt_status fail_endless(rt_session *s, double time, const char *doing, const mdl_equation *function) {
  mdl_failure_kind kind = s->data.failure.kind;
  return rt_fail(s, status_of(kind), time, -1, function, "%s at time %.9g s: %s", doing, time, describe(kind));
}

/* Row of the variable that an equation of the explicit form is solved for, -1 where it is none. */
static int unknown_of(const rt_session *s, int equation) {
  for (int k = 0; k < s->d->n_computed; k++) {
    const mdl_computed *c = &s->d->computed[k];
    if (c->equation == equation && c->storage != MDL_PARAMETER)
      return rt_find_row(s, c->storage == MDL_DERIVATIVE ? MDL_STATE : c->storage, c->index);
  }
  return -1;
}

/* A relation that compares what is no number, told at its equation or its function. */
static rt_status fail_relation(rt_session *s, double time, const char *doing) {
  const mdl_descriptor *d = s->d;
  mdl_failure_kind kind = s->data.failure.kind;
  int place = s->data.failure.equation;
  const mdl_equation *where = place < 0 ? &d->asserts[-1 - place].source : NULL;
  bool in_equation = place > 0 && place <= d->n_equations;
  if (in_equation) where = &d->equations[place - 1];
  rt_fail(s, status_of(kind), time, -1, where, "%s at time %.9g s: %s", doing, time, describe(kind));
  if (in_equation && d->equation_first) rt_append_equation(s, place - 1);
  return s->failure.status;
}

/* Nonlinear equations may have no solution behind a relation before that has switched, nor the relation a value there
 * that would tell (z^2 = abs(x)): the first that is as near to it as a tolerance tells. */
static void append_relation(rt_session *s) {
  char *message = s->failure.message;
  size_t size = sizeof s->failure.message, n = strlen(message);
  for (int r = 0; r < s->d->n_rel && n < size; r++) {
    if (!rt_is_state_relation(s, r) || !(s->g_span[r] > 0) || fabs(s->g[r]) > s->options.rtol * s->g_span[r]) continue;
    snprintf(
        message + n, size - n,
        "; the relation %s is at zero there, and until it switches the equations may have no solution behind: where "
        "nothing jumps, noEvent(...) goes over it",
        s->d->relations[r].source.text);
    return;
  }
}

/* Linear equations are ordered for all values of parameters: where one is zero they may lack what another order has
 * (i = C*der(v) at C = 0 gives i, not v). */
static void append_zeros(rt_session *s, int equation) {
  const mdl_descriptor *d = s->d;
  char names[200] = "", *message = s->failure.message;
  size_t size = sizeof s->failure.message, n = strlen(message);
  for (int k = d->equation_first[equation]; k < d->equation_first[equation + 1]; k++) {
    const mdl_variable *v = &d->variables[d->equation_variables[k]];
    if (v->is_parameter && v->type == MDL_REAL && v->storage == MDL_PARAMETER && s->data.p[v->index] == 0)
      rt_append_name(names, sizeof names, v->name);
  }
  if (names[0] && n < size)
    snprintf(message + n, size - n,
             "; that may come of what is zero: %s; annotation(Evaluate = true) at its declaration orders the equations "
             "for that value; else give it, or what it follows from, a small value",
             names);
}

/* Turn the failure that a model function has left in m->failure into the session's. `doing` says what for. */
rt_status rt_fail_model(rt_session *s, double time, const char *doing) {
  const mdl_descriptor *d = s->d;
  const mdl_failure *f = &s->data.failure;
  bool is_assert = f->kind == MDL_FAILURE_ASSERT, endless = f->kind == MDL_FAILURE_LOOP || f->kind == MDL_FAILURE_STACK;
  bool placed = f->equation >= 0 && f->equation < (is_assert || endless ? d->n_asserts : d->n_equations);
  if (f->kind == MDL_FAILURE_RELATION) return fail_relation(s, time, doing);
  if (endless && placed) return fail_endless(s, time, doing, &d->asserts[f->equation].source);
  if (is_assert && placed) return fail_assert(s, time, &d->asserts[f->equation]);
  const mdl_equation *where = placed && !is_assert ? &d->equations[f->equation] : NULL;
  int variable = f->kind == MDL_FAILURE_SINGULAR && placed ? unknown_of(s, f->equation) : f->variable;
  bool named = variable >= 0 && variable < d->n_variables;
  if (!named) variable = -1;
  if (f->kind == MDL_FAILURE_BOUND && named) return fail_bound(s, time, f);
  char value[40] = "";
  if (f->kind != MDL_FAILURE_SINGULAR && f->kind != MDL_FAILURE_NEWTON)
    snprintf(value, sizeof value, " (value %.9g)", isnan(f->value) ? fabs(f->value) : f->value);
  rt_fail(s, status_of(f->kind), time, variable, where, "%s at time %.9g s: %s%s%s%s", doing, time, describe(f->kind),
          named ? ", variable " : "", named ? d->variables[variable].name : "", value);
  if (where && d->equation_first) rt_append_equation(s, f->equation);
  if (f->kind == MDL_FAILURE_NEWTON) append_relation(s);
  if (f->kind == MDL_FAILURE_SINGULAR && where && d->equation_first) append_zeros(s, f->equation);
  return s->failure.status;
}

/* The state with the largest of `amounts` [n_x], in tolerances. */
static int largest_in_tolerances(const rt_session *s, const double *amounts, double *largest) {
  int worst = 0;
  *largest = 0;
  for (int i = 0; i < s->d->n_x; i++) {
    double size = fabs(amounts[i]) / (s->atol[i] + s->options.rtol * fabs(s->data.x[i]));
    if (!(size > *largest)) continue;
    worst = i;
    *largest = size;
  }
  return worst;
}

/* The equation that gives the derivative of a state, NULL where none does. */
static const mdl_equation *derivative_of(const rt_session *s, int state) {
  for (int k = 0; k < s->d->n_computed; k++) {
    const mdl_computed *c = &s->d->computed[k];
    if (c->storage == MDL_DERIVATIVE && c->index == state) return &s->d->equations[c->equation];
  }
  return NULL;
}

/* The solver asks for steps of h seconds, too small to get anywhere: the fault is in the state with the largest error
 * of the last step that was tried, or, where that tells nothing, in the one that changes fastest. */
rt_status rt_fail_collapse(rt_session *s, double h, const char *why) {
  if (s->method->blame) s->method->blame(s, s->memory);
  if (s->data.failure.kind != MDL_FAILURE_NONE) return rt_fail_model(s, s->t, "integrating");
  const char *reason = "has the largest error: does its derivative jump without an event, or grow without bound?";
  double *error = s->x_trial, largest = 0;
  memset(error, 0, (size_t)s->d->n_x * sizeof *error);
  if (s->method->errors) s->method->errors(s, s->memory, error);
  int worst = largest_in_tolerances(s, error, &largest);
  if (largest < 0.01) {
    worst = largest_in_tolerances(s, s->data.xdot, &largest);
    reason = "changes fastest";
  }
  int variable = rt_state_variable(s, worst);
  const char *name = variable >= 0 ? s->d->variables[variable].name : "a state";
  return rt_fail(s, RT_STEP_COLLAPSE, s->t, variable, derivative_of(s, worst),
                 "solver %s makes no progress at time %.9g s: %s (step %.3g s); %s %s", s->method->name, s->t, why, h,
                 name, reason);
}
