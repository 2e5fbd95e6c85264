/* What the parts of the runtime share: one session and the small structures that it is made of. */
#ifndef RT_SESSION_H
#define RT_SESSION_H

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>

#include "dense.h"
#include "fold.h"
#include "lacuna_runtime.h"
#include "linear.h"
#include "patience.h"
#include "result.h"

struct rt_model {
  void *library;
  const mdl_descriptor *descriptor;
};

/* One recorded input. `cursor` is the sample that holds from the start of the present step on; between the present time
 * and sample `ahead` nothing jumps or bends. */
typedef struct {
  const double *time, *values;
  int n, cursor, ahead;
  rt_interpolation interpolation;
  double from, span, until, base, rise; /* the line on which the input was last; until <= from: not known */
} rt_input;

/* Time events: the next tick of each sample(), the next time relation, and the grid of a fixed step. */
typedef struct {
  double *first, *interval; /* [n_sample] s */
  long *next;               /* [n_sample] number of the next tick */
  double next_relation, next_tick;
  double tolerance; /* instants closer than this are one (s) */
  long step;        /* number of the next point of the fixed-step grid */
} rt_clock;

typedef struct {
  mdl_storage storage;
  int index;
  double sign;
} rt_output;

typedef struct {
  int n;
  rt_output *outputs;
  bool needs_rhs;   /* some output is algebraic or a derivative */
  bool needs_point; /* or an input: something that changes inside a step and is no state */
  const double *grid;
  int n_grid;
  double interval;
  long next; /* first grid point not yet recorded */
  double *x, *xdot, *v;
} rt_recorder;

/* An integration method. A step starts from data.x, data.xdot at s->t and ends with x, xdot and v of the new s->t
 * there. */
typedef struct {
  const char *name;
  bool needs_step; /* has no step size control */
  bool multistep; /* remembers earlier steps: restarts where a linear input bends sharply, but steps over small kinks */
  void *(*create)(struct rt_session *);
  void (*destroy)(void *memory);
  rt_status (*begin)(struct rt_session *, void *memory);   /* a new run */
  rt_status (*restart)(struct rt_session *, void *memory); /* x, xdot or the equations have jumped */
  rt_status (*step)(struct rt_session *, void *memory, double limit);
  void (*dense)(struct rt_session *, void *memory, rt_dense *dense);
  void (*count)(struct rt_session *, void *memory);            /* add the method's own counters to the result */
  void (*errors)(struct rt_session *, void *memory, double *); /* [n_x] of the last step tried; NULL: not known */
  void (*blame)(struct rt_session *, void *memory);            /* name what failed more closely; NULL: it is named */
  bool (*sensitivities)(struct rt_session *, void *memory);    /* get ready for those of the session, or for none */
  void (*filter)(struct rt_session *, void *memory, double t, double *defect); /* [n_x] of x_trial, defect.c */
  void (*dense_tangent)(struct rt_session *, void *memory, rt_dense *dense);   /* as dense, of the states' tangents */
} rt_method;

extern const rt_method rt_method_ida, rt_method_dopri5, rt_method_rodas4, rt_method_rk4, rt_method_euler;

enum {
  RT_PENDING_STATE = 1,
  RT_PENDING_TIME = 2,
  RT_PENDING_SAMPLE = 4,
  RT_PENDING_JUMP = 8,    /* of a held input */
  RT_PENDING_KINK = 16,   /* of a linear input, where the method restarts at kinks */
  RT_PENDING_BRANCH = 32, /* algebraic unknowns have jumped: the branch that they followed has ended */
  RT_PENDING_INPUT = RT_PENDING_JUMP | RT_PENDING_KINK
};

typedef struct rt_sensitivities rt_sensitivities; /* sensitivity.h */

struct rt_session {
  const rt_model *model;
  const mdl_descriptor *d;
  mdl_data data;
  rt_options options;
  const rt_method *method;
  void *memory;
  double *numbers;               /* the block that all arrays of doubles here and in data are slices of */
  unsigned char *flags;          /* and that of all arrays of flags */
  size_t n_numbers, n_flags;     /* their lengths */
  double *p_run;                 /* [n_p] parameters of the next run, before dependent ones are computed */
  int n_initial, *initial_index; /* states set by the caller */
  double *initial_value;
  rt_input *inputs;  /* [n_u]; n = 0: constant at its start value */
  double input_time; /* where data.u was last computed */
  double *nominal;   /* [n_x + n_z + n_rel + n_delay] sizes, 0: not known */
  double *g_nominal, *delay_nominal;
  double *range;             /* [n_x + n_z] largest size so far, followed up to the nominal value */
  double *outgrown, *modest; /* [n_x] size from which on range is to be followed again; 1: as is the nominal value */
  bool growing;              /* some are */
  bool atol_given;           /* by the caller: it stays as it is */
  double *atol;              /* [n_x + n_z] */
  double *y, *yp;            /* [n_x + n_z] scratch for the residual form */

  double start, stop;
  double t_previous, t;             /* what is being looked at of the last step; data belongs to t */
  double t_uncrossed;               /* where the last event located has not happened yet */
  double t_end;                     /* end of the last step; later than t when an event cut it short, and then */
  double *x_end, *xdot_end, *v_end; /* the point there */
  long steps_taken, pieces_taken;   /* in this run, and looks inside steps */
  int tiny_steps;                   /* consecutive steps that hardly differ from none */
  bool in_pieces, resume;           /* the last step is longer; go on in it, for no state or slope has changed at t */
  double look, look_curved;         /* longest piece of the last step to be looked at at once, of any step (s) */
  double *phase, *phase_start, *shape, *rates; /* [n_phases] rad; [(RT_DENSE_DEGREE + 1) * n_rel] of swings.c */
  double *swing, *bound; /* [(RT_DENSE_DEGREE + 1) * n_rel], [n_rel] of guards that come near in a step that is tried */
  rt_clock clock;
  rt_dense dense;
  double *g, *g_previous;                          /* [n_rel] guards at t and t_previous */
  double *g_low, *g_trial;                         /* [n_rel] while locating a crossing */
  double *g_before, *g_oldest, t_before, t_oldest; /* [n_rel] guards one and two steps earlier; NAN after a restart */
  double *g_reach; /* [n_rel] swings.c: no affine guard moves further in the last step from where it was at its start */
  double *g_span, *g_travel, *g_floor; /* [n_rel] largest |g| in the run, since it switched; what rounding leaves */
  double *changed_at[2];               /* [n_rel] when the relation last became false, true (s) */
  double last_due_back;                /* the latest of */
  double *due_back; /* [n_rel] until when it must switch back, having been thrown back; else -INFINITY */
  double *x_trial, *xdot_trial, *v_trial;
  double *x_before, *xdot_before, *v_before, *v_agreed; /* v_agreed: v as it follows what an event sets (events.c) */
  double *d_before, *d_after;             /* discrete variables before an event; and aside while it is differentiated */
  double *declared;                       /* start values of `redundant` in the descriptor */
  double *x_start;                        /* what the states begin with: declared, or given by the caller */
  double *x_swept, *d_swept;              /* states after a sweep of an event, discrete variables before it */
  unsigned char *rel_swept, *when_before; /* relations before a sweep, when conditions before its pass */
  double *x_seen, *d_seen;                /* what an earlier pass of an event has led to (cycle.c), and its modes */
  unsigned char *rel_seen, *when_seen, *rel_before, *rel_trial; /* [n_rel], [n_when], [n_rel] */
  bool reinitialised, shaped; /* the last event did; shape is of the last step, with the present relations */
  bool far, quiet;            /* no affine guard comes near zero in the last step (reach.c), or crosses */
  bool all_affine;            /* all guards of state relations are affine */
  bool looks_inside;          /* steps are looked at in pieces where that is called for */
  unsigned char *flip;        /* [n_rel] relations that switch at t */
  int pending;
  double last_event;          /* time of the last event (s) */
  int futile_events;          /* consecutive events that got nowhere, see check_chattering */
  double *division;           /* [2 n_divisions] numerators and divisors */
  signed char *division_sign; /* [n_divisions] of their products when they were last looked at; 0 not known */
  int undetermined, n_held;   /* mdl_data.undetermined since the last event; terms that hold what it leaves open */
  int unsettled;              /* mdl_data.unsettled of the last evaluation at the session's own point */
  struct rt_slopes *slopes;   /* reach.c; NULL: there are none */
  struct rt_held *held;       /* [n_x + n_z], undetermined.h */
  rt_branches branches;
  rt_recorder recorder;
  struct rt_delays *delays;         /* delay.c; NULL: the model has none */
  struct rt_transports *transports; /* transport.c; NULL: the model has none */
  rt_sensitivities *sensitivities;  /* NULL: none are asked for */
  int (*interrupted)(double time);  /* asked now and then; NULL: never */
  rt_patience patient;
  rt_failure failure;
  rt_result *result;
};

/* fmin and fmax without a call: neither argument is NaN here. */
static inline double rt_min(double a, double b) {
  return a < b ? a : b;
}
static inline double rt_max(double a, double b) {
  return a > b ? a : b;
}

#define RT_LARGEST_INTEGER 0x1.fffffffffffffp52 /* 2^53 - 1: what is 2^53 may be 2^53 + 1, rounded unseen */

/* A value that a variable of this type can have, finite for sure. */
static inline bool rt_has_type(const mdl_variable *v, double value) {
  return isfinite(value) && (v->type == MDL_REAL || (value == floor(value) && fabs(value) <= RT_LARGEST_INTEGER &&
                                                     (v->type == MDL_INTEGER || value == 0 || value == 1)));
}

static inline bool rt_finite(int n, const double *a) {
  double sum = 0, beside = 0; /* two, because each waits for its last addition */
  int i = 0;
  for (; i + 1 < n; i += 2) {
    sum += a[i] - a[i];
    beside += a[i + 1] - a[i + 1];
  }
  if (i < n) sum += a[i] - a[i];
  return sum + beside == 0;
}

/* Rounding of time in this run (s): the same for seconds since the start and for seconds since 1970. */
static inline double rt_time_resolution(const rt_session *s) {
  return 2 * DBL_EPSILON * rt_max(fabs(s->start), fabs(s->stop));
}

/* Steps smaller than this (s) are lost in the rounding of time. */
static inline double rt_smallest_step(const rt_session *s) {
  return 16 * DBL_EPSILON * rt_max(fabs(s->t), 1e-3 * (s->stop - s->start));
}

/* A relation that is switched by the root of its guard. */
static inline bool rt_is_state_relation(const rt_session *s, int r) {
  return !(s->d->relations[r].kind & MDL_OF_TIME);
}

/* In the unit of the guard: far above the rounding of what it compares, far below any play of it. As a tolerance does,
 * it follows the guard's largest size so far, from a thousandth of its nominal value (that of what it compares:
 * rounding is a thousandth of that hysteresis still) up to it. The second part covers guards that run over a larger
 * range. */
static inline double rt_hysteresis(const rt_session *s, int r) {
  double nominal = s->g_nominal[r], span = s->g_span[r];
  double size = nominal > 0 ? rt_min(nominal, rt_max(span, 1e-3 * nominal)) : span;
  return 1e-10 * size + 1e-12 * span;
}

/* The guard of relation r has had this size since the relation switched. */
static inline void rt_extend_guard(rt_session *s, int r, double size) {
  if (size > s->g_span[r]) s->g_span[r] = size;
  if (size > s->g_travel[r]) s->g_travel[r] = size;
}

/* blame.c and failure.c */
int rt_find_row(const rt_session *s, mdl_storage storage, int index);
int rt_state_variable(const rt_session *s, int state), rt_unknown_variable(const rt_session *s, int k);
void rt_append_name(char *text, size_t size, const char *name);
void rt_append_changed(const rt_session *s, char *text, size_t size);
bool rt_blame(rt_session *s, mdl_storage storage, const double *xdot, const double *v);
bool rt_has_values(rt_session *s, const double *xdot, const double *v);
rt_status rt_fail(rt_session *s, rt_status status, double time, int variable, const mdl_equation *where,
                  const char *format, ...) __attribute__((format(printf, 6, 7)));
rt_status rt_fail_model(rt_session *s, double time, const char *doing);
void rt_tell_warnings(rt_session *s);
rt_status rt_fail_bound(rt_session *s, double time, int variable, double value, double min, double max);
rt_status rt_fail_collapse(rt_session *s, double h, const char *why);
void rt_append_equation(rt_session *s, int equation);

/* evaluate.c: the model's functions, counted and guarded; > 0 recoverable, < 0 not, m->failure says why */
int rt_rhs(rt_session *s, double t, const double *x, double *xdot, double *v);
int rt_derivatives(rt_session *s, double t, const double *x, double *xdot, double *v);
int rt_check_finite(rt_session *s, const double *x);
int rt_evaluate(rt_session *s), rt_evaluate_into(rt_session *s, double *v);
int rt_check_settled(rt_session *s, int place);
void rt_residual_point(rt_session *s);
int rt_jacobian(rt_session *s, double t, double *y, double *yp, double cj, double *values);
rt_status rt_check_forms(rt_session *s);

/* scale.c and check.c */
rt_status rt_scale_parameters(rt_session *s);
void rt_scale_start(rt_session *s), rt_scale_grow(rt_session *s);
double rt_least_share(double tolerance);
rt_status rt_check_parameters(rt_session *s);
rt_status rt_check_values(rt_session *s, double t, const double *x, const double *xdot, const double *v);
rt_status rt_check_point(rt_session *s, bool fresh);
rt_status rt_check_lasting(rt_session *s);

/* inputs.c and clock.c */
void rt_inputs_reset(rt_session *s);
void rt_inputs_begin(rt_session *s, double t);
void rt_inputs_at(rt_session *s, double t);
double rt_inputs_next_break(rt_session *s);
int rt_inputs_due(rt_session *s);
double rt_input_slope(const rt_session *s, int i);
rt_status rt_clock_begin(rt_session *s);
void rt_clock_tick(rt_session *s);
void rt_clock_look(rt_session *s);
bool rt_clock_relations(rt_session *s);

/* guards.c, roots.c and dips.c */
double rt_margin(const rt_session *s, int r, double g);
int rt_guards_at(rt_session *s, double t, double *g);
rt_status rt_find_state_event(rt_session *s);
void rt_resume_step(rt_session *s);
bool rt_may_dip(const rt_session *s, double end);
int rt_find_dip(rt_session *s, double *inside);
int rt_follow_switches(rt_session *s, double since);

/* simulate.c: the hybrid loop, a piece at a time */
rt_status rt_begin(rt_session *s);
rt_status rt_advance(rt_session *s);
rt_status rt_happen(rt_session *s);
rt_status rt_check_asserts(rt_session *s);

/* settings.c, events.c, cycle.c, initialise.c */
void rt_session_declared(rt_session *s); /* every parameter back to its declared value */
rt_status rt_event(rt_session *s), rt_iterate_event(rt_session *s);
bool rt_event_circles(rt_session *s, int k);
rt_status rt_initialise(rt_session *s);

/* record.c */
void rt_record_begin(rt_session *s);
rt_status rt_record_end(rt_session *s), rt_record_step(rt_session *s), rt_record_event_row(rt_session *s);

#endif
