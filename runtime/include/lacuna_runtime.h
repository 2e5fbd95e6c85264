/* Public interface of the runtime: open a generated model, set up a session, run it, read the result.
 *
 *   rt_model    a generated shared object; read-only, may serve many sessions and threads at once
 *   rt_session  memory, solver, inputs and choice of outputs of one model; runs again and again; one thread at a time
 *   rt_result   what one run recorded; independent of the session that made it
 *
 * SI units and seconds throughout. Variables are named by their row in the descriptor's variable table.
 * Functions that can fail return rt_status, and the message is in the session's or result's rt_failure. */
#ifndef LACUNA_RUNTIME_H
#define LACUNA_RUNTIME_H

#include <stddef.h>

#include "mdl_abi.h"

#ifdef __cplusplus
extern "C" {
#endif

#define RT_API __attribute__((visibility("default")))

typedef struct rt_model rt_model;
typedef struct rt_session rt_session;
typedef struct rt_result rt_result;

typedef enum {
  RT_OK = 0,
  RT_MODEL,          /* the shared object cannot be opened, or speaks another ABI */
  RT_ARGUMENT,       /* unknown solver, index out of range, step missing, times not increasing ... */
  RT_BOUND,          /* a parameter outside its min/max */
  RT_INITIALISATION, /* the initial equations have no solution that the solver finds */
  RT_INCONSISTENT,   /* residual form and explicit form of the model disagree at the start */
  RT_EVENT_CYCLE,    /* event iteration never comes to rest */
  RT_CHATTERING,     /* a relation switches to and fro without time passing */
  RT_STEP_COLLAPSE,  /* the solver needs steps too small to make progress */
  RT_NONFINITE,      /* NaN or infinity */
  RT_SINGULAR,       /* a block of equations has no unique solution, or none that Newton's method finds */
  RT_DOMAIN,         /* an argument outside a function's domain */
  RT_ASSERT,         /* assert(..., level = error) violated */
  RT_MEMORY,         /* none left, or more results than fit */
  RT_INTERRUPTED     /* the caller asked for it, see rt_session_watch */
} rt_status;

/* Why a run ended early. `message` is complete: it names time, variable or equation, and the line of the model. */
typedef struct {
  rt_status status;
  double time;
  int variable; /* row in the variable table, -1 where none is to blame */
  int line;     /* in `file`, 0 where unknown */
  const char *file;
  char message[600];
} rt_failure;

typedef struct {
  long steps, error_test_fails, rhs, residuals, jacobians, root_evaluations;
  long newton_iterations, newton_fails;
  long state_events, time_events, sample_events, input_jumps, event_passes, restarts;
  long tangents; /* evaluations of the model's derivatives, all columns at once */
} rt_counters;

typedef enum { RT_EVENT_STATE, RT_EVENT_TIME, RT_EVENT_SAMPLE, RT_EVENT_TERMINATE } rt_event_kind;

typedef struct {
  double time;
  int kind;      /* rt_event_kind */
  int index;     /* relation, relation, sample or message */
  int direction; /* of a relation: +1 it became true, -1 false */
  double reach;  /* of a state event: how far the guard had been from zero since it last switched, by its nominal value
                    (else of its range); of others 1 */
} rt_event_entry;

/* Where sensitivities are not what they seem, because the order of events is about to change. */
typedef enum {
  RT_FLAG_GRAZING,   /* `relation` only touches its threshold: from here on there are no sensitivities */
  RT_FLAG_ORDER,     /* two events at one instant, as far as it is known, that move differently with a parameter */
  RT_FLAG_NONFINITE, /* a derivative is infinite or overflows: from here on there are no sensitivities */
  RT_FLAG_ROUNDING,  /* the model rounds values at events: their derivative is that between two steps, which is zero */
  RT_FLAG_FOLD,   /* the branch that algebraic unknowns followed has ended: from here on there are no sensitivities */
  RT_FLAG_ARRIVAL /* pre(y) was read where y follows what the event sets: from here on there are no sensitivities */
} rt_flag_kind;

typedef struct {
  double time;
  int kind;            /* rt_flag_kind */
  int relation, other; /* -1: none, or an event that is no relation's */
} rt_flag;

typedef struct {
  const char *solver; /* "ida", "dopri5", "rodas4", "rk4", "euler" */
  double rtol, atol;  /* <= 0: the model's tolerance, and 0.01 of it; atol is per nominal value of a variable */
  double step;        /* fixed step (s); <= 0: step size control (not for rk4 and euler) */
  double max_step;    /* <= 0: none */
  int locate_events;  /* 0: state and time events are taken at the end of the step in which they fall */
  int record_events;  /* 1: a row before and a row after each event */
  long max_steps;     /* <= 0: none; a run that needs more ends as RT_STEP_COLLAPSE */
  int unchecked;      /* 1: accepted points are not looked at for numbers that are not finite and divisors at zero */
  double patience;    /* s of computing in which at least a millionth of the run is to be done, in steps of which 1e10
                         are enough for all of it, else it ends as RT_STEP_COLLAPSE; <= 0: 60 */
} rt_options;

typedef enum { RT_LINEAR, RT_HOLD } rt_interpolation;

/* The model at `path`, or NULL with the reason in `message`. */
RT_API rt_model *rt_model_open(const char *path, char *message, size_t size);
/* Wrap a descriptor that is linked in (hand-written models); it must outlive the model. */
RT_API rt_model *rt_model_wrap(const mdl_descriptor *descriptor, char *message, size_t size);
RT_API void rt_model_close(rt_model *model);
RT_API const mdl_descriptor *rt_model_descriptor(const rt_model *model);
/* Row of the variable called `name`, -1 if there is none. */
RT_API int rt_model_find(const rt_model *model, const char *name);

/* A session, or NULL with the reason in `message`. The model must outlive it. */
RT_API rt_session *rt_session_new(const rt_model *model, const rt_options *options, char *message, size_t size);
RT_API void rt_session_free(rt_session *session);
RT_API const rt_failure *rt_session_failure(const rt_session *session);

/* The next runs use the declared parameters, replaced by these: n rows and values. */
RT_API rt_status rt_session_parameters(rt_session *session, int n, const int *variables, const double *values);
/* The next runs start from these states instead of what the initial equations give. */
RT_API rt_status rt_session_initial(rt_session *session, int n, const int *variables, const double *values);
/* Drive an input by n >= 1 samples; first and last value hold outside. Borrowed: keep both arrays alive. */
RT_API rt_status rt_session_input(rt_session *session, int variable, int n, const double *time, const double *values,
                                  rt_interpolation interpolation);
/* Columns to record, in this order. A new session records none. */
RT_API rt_status rt_session_outputs(rt_session *session, int n, const int *variables);
/* Record at these instants (borrowed, not decreasing). n = 0: every `interval` seconds from the start,
 * and at the stop; interval <= 0 too: at the end of every step. */
RT_API rt_status rt_session_grid(rt_session *session, int n, const double *times, double interval);

/* The tolerances in force: of the options, else of the model's experiment, else the runtime's own. */
RT_API void rt_session_tolerances(const rt_session *session, double *rtol, double *atol);

/* The next runs also give the derivatives of all outputs by these: rows of parameters, or of states for their initial
 * values. n = 0: none. Refused, with the variable's name, where nothing depends on one of them smoothly. */
RT_API rt_status rt_session_sensitivities(rt_session *session, int n, const int *variables);

/* While a run goes on, `interrupted` is called about ten times a second with the time (s) that it has reached, in the
 * thread of the run; where it gives a number other than 0 the run ends with what it has. NULL: it is not asked. */
RT_API void rt_session_watch(rt_session *session, int (*interrupted)(double time));

/* Run from `start` to `stop`. Always gives a result (NULL only without memory): see rt_result_failure. */
RT_API rt_result *rt_session_run(rt_session *session, double start, double stop);

RT_API void rt_result_free(rt_result *result);
RT_API const rt_failure *rt_result_failure(const rt_result *result); /* status RT_OK: complete */
RT_API const char *rt_result_terminated(const rt_result *result);    /* message of terminate(), or NULL */
RT_API const rt_counters *rt_result_counters(const rt_result *result);
RT_API size_t rt_result_rows(const rt_result *result);
RT_API const double *rt_result_time(const rt_result *result);               /* [rows] */
RT_API const unsigned char *rt_result_event_flags(const rt_result *result); /* [rows] 1: row at an event */
RT_API const double *rt_result_column(const rt_result *result, int column); /* [rows] of the column-th output */
/* [rows] derivative of the column-th output by the k-th of the variables asked for, at fixed time; not a number where
 * it does not exist any more (see the flags). */
RT_API const double *rt_result_sensitivity(const rt_result *result, int column, int k);
/* [n] how far each may change, to first order, before two events of the run meet. */
RT_API const double *rt_result_margins(const rt_result *result);
RT_API const rt_flag *rt_result_flags(const rt_result *result, size_t *count);
/* Asserts of level warning that were violated, each where it was for the first time. */
RT_API const char *const *rt_result_warnings(const rt_result *result, size_t *count);
RT_API const double *rt_result_parameters(const rt_result *result); /* [n_p] values used, dependent ones computed */
RT_API const rt_event_entry *rt_result_events(const rt_result *result, size_t *count);

#ifdef __cplusplus
}
#endif
#endif
