/* The interface of a generated model: what codegen/ writes and runtime/ calls. Nothing else connects the two.
 *
 * A model is one C file that exports `const mdl_descriptor *mdl_descriptor_get(void)`. It has no globals
 * that change: everything it computes goes through the mdl_data that it is given, so many runs of one model
 * may share it. Two independent paths lead through the same equations:
 *
 *   residual form   F(t, y, y') = 0 with y = [x; z]: states and the few algebraic unknowns (tearing
 *                   variables) that remain when everything explicit is computed in sequence. For IDA.
 *   explicit form   x' = f(t, x): matching, BLT and torn blocks solved inside. For one-step methods, for
 *                   event iteration, and to restart IDA with known derivatives.
 *
 * Callbacks return 0 (done), > 0 (recoverable: try a smaller step; m->failure says why) or < 0 (give up).
 * Booleans and Integers are stored as doubles (0/1, whole numbers). Units are SI throughout. */
#ifndef MDL_ABI_H
#define MDL_ABI_H

#ifdef __cplusplus
extern "C" {
#endif

#define MDL_ABI_VERSION 28

enum { MDL_FOLLOWS = 1, MDL_ARRIVAL = 2 }; /* bits of events_follow */

typedef enum {
  MDL_FAILURE_NONE = 0,
  MDL_FAILURE_SINGULAR,  /* linear equations contradict each other or make no step; `equation` is one of them */
  MDL_FAILURE_NEWTON,    /* a nonlinear block did not converge */
  MDL_FAILURE_NONFINITE, /* an equation gave NaN or infinity */
  MDL_FAILURE_DOMAIN,    /* argument outside a function's domain: sqrt, log, asin, division by zero ... */
  MDL_FAILURE_ASSERT,    /* assert(..., level = error) violated; `equation` indexes `asserts` */
  MDL_FAILURE_BOUND,     /* a parameter outside its min/max; `variable` says which */
  MDL_FAILURE_LOOP,      /* a function ran too long: loops and calls inside each other; `equation` as of an assert */
  MDL_FAILURE_STACK,     /* functions called each other too deep, or their arrays are too large; `equation` likewise */
  MDL_FAILURE_FOREIGN,   /* external C called ModelicaError, which has told why */
  MDL_FAILURE_RELATION   /* a side of a relation is no number; `equation` is a place as in `unsettled` */
} mdl_failure_kind;

typedef struct {
  mdl_failure_kind kind;
  int equation; /* index into `equations` (or `asserts`), -1 unknown */
  int variable; /* index into `variables`, -1 unknown */
  double value; /* offending value, where there is one */
  double bound; /* of a parameter: the one that it violates */
} mdl_failure;

/* How Newton's method came from the start values of nonlinear blocks to their roots: the largest ratio of one of its
 * steps to the one before, INFINITY where it took other ways, of the first block where that was more than
 * MDL_CONTRACTS; its first equation. `only`: 1 + that of the block to watch, 0: all. */
typedef struct {
  double ratio;
  int equation, only;
  int turned; /* 1 + the first equation of a block that came to a root that faces the other way; 0: none did */
} mdl_contraction;

/* Up to here the root is that of the start values' branch (P. Deuflhard, Newton Methods for Nonlinear Problems, 2004,
 * 2.1 and 5.1); towards a double root the ratio tends to 1/2. */
#define MDL_CONTRACTS 0.25
#define MDL_SOMEWHERE 0x7fffffff               /* of no equation that is known */
#define MDL_UNREAD    __builtin_nan("0x1acca") /* what has no value, and nobody reads: a NaN told by its bits */

/* All memory of one run of one model; allocated by the runtime from the counts of the descriptor. */
typedef struct mdl_data {
  double *p;             /* [n_p] constants and parameters */
  double *u;             /* [n_u] inputs at the current time; the runtime keeps them up to date */
  double *x;             /* [n_x] states, and */
  double *xdot;          /* [n_x] their derivatives, at the last accepted point */
  double *v;             /* [n_v] all other continuous variables there; also start values of nonlinear blocks */
  double *d;             /* [n_d] discrete variables */
  double *pre_d;         /* [n_d] their values before the current event */
  unsigned char *rel;    /* [n_rel] relations, frozen between events */
  unsigned char *tick;   /* [n_sample] 1 while an event at which this sample() fires is iterated */
  unsigned char *when;   /* [n_when] pre-value of each when condition (for its rising edge) */
  unsigned char *warned; /* [n_asserts] bit 0: a warning is violated; the runtime sets bit 1 when it has been told */
  int initial;           /* initial() */
  int terminal;          /* terminal() */
  int reinitialised;     /* set by event(): reinit changed x */
  int terminated;        /* set by event(): 1 + index into `messages` of the terminate() that fired; else 0 */
  mdl_failure failure;
  double start_time; /* of the run; parameters may depend on it */
  double homotopy;   /* in initial_system(): 1 what homotopy() actually is, 0 what it is simplified to */
  long stack;        /* bytes of the stack that functions of the model now hold, about; 0 outside of them */
  long rounds;       /* loops' rounds and calls since the outermost function was entered */
  int undetermined;  /* set by rhs(): 1 + an equation of a linear block that leaves unknowns open in this mode */
  int unsettled;     /* set where a relation that makes no event compares what is no number: 1 + the equation, or
                        -1 - the row of the function in `asserts`, or MDL_SOMEWHERE; 0: none did */
  void *transports;  /* the runtime's; what the model reads there by */
  double (*carried)(const struct mdl_data *m, int k, double end, double x, int order);
  int brief;    /* 1: rhs() may write no more of v than what it starts from at the next point */
  double shift; /* 0; by as many nominal values rhs() moves what is open away from the solution next to zero */
  mdl_contraction contraction; /* in rhs() and initial_system(), since the runtime set its ratio to zero */
  double *orientation;  /* [n_equations] of a nonlinear block, at its first: 1, -1: sign of det J there; 0 unknown */
  const double *facing; /* [n_equations] that on the branch that the run follows, 0: any. It changes nowhere on it */
} mdl_data;

typedef enum {
  MDL_STATE,     /* x[index] */
  MDL_ALGEBRAIC, /* v[index] */
  MDL_DISCRETE,  /* d[index] */
  MDL_PARAMETER, /* p[index] */
  MDL_INPUT,     /* u[index] */
  MDL_DERIVATIVE /* xdot[index]: a variable that equals the derivative of a state */
} mdl_storage;

typedef enum { MDL_REAL, MDL_INTEGER, MDL_BOOLEAN } mdl_type;

/* One row for each variable of the flat model, aliases included (an alias shares the index of what it equals). */
typedef struct {
  const char *name; /* full Modelica name */
  const char *unit;
  const char *description;
  const char *file;
  int line;
  mdl_type type;
  mdl_storage storage;
  int index;
  int sign;     /* -1: a negated alias */
  int settable; /* a parameter that may be given another value at run time (not dependent, structural or final) */
  int is_output;
  double start, min, max, nominal; /* min/max -/+INFINITY where not given; nominal 0 where not given */
  const char *inferred_unit;       /* what the equations say where no unit is declared; "" where they do not */
  int is_parameter; /* declared as a parameter or constant; 0: a variable, though parameters may decide it */
} mdl_variable;

typedef struct {
  const char *text; /* as written in the model */
  const char *file;
  int line;
  const char *origin; /* component path */
} mdl_equation;

typedef struct {
  mdl_equation source; /* `text` is the message */
  int n_values;
  const int *values; /* [n_values] rows of the variables that its condition compares, shown where it is violated */
} mdl_assert;

/* A relation of time, parameters and discretes only is switched by a time event, not by a root. A follower compares
 * what event() sets, without deciding about it: what event() does reads it as it is then. One that is asked stands in
 * no branch that may not hold. */
enum { MDL_OF_TIME = 1, MDL_FOLLOWER = 2, MDL_ASKED = 4 };

typedef struct {
  mdl_equation source;
  int kind; /* bits: MDL_OF_TIME, MDL_FOLLOWER, MDL_ASKED */
} mdl_relation;

/* What an equation gives, in the order in which it is computed: a dependent parameter, a derivative, an algebraic. */
typedef struct {
  mdl_storage storage; /* MDL_PARAMETER, MDL_DERIVATIVE or MDL_ALGEBRAIC */
  int index, equation;
} mdl_computed;

/* An algebraic variable, its derivative and an equation that was differentiated: it may bend at events, not jump. */
typedef struct {
  int index, rate, equation; /* v[index], v[rate] */
} mdl_lasting;

typedef struct {
  int stages;                    /* of an explicit Runge-Kutta scheme */
  const double *nodes, *weights; /* [stages], [stages * (stages - 1)] */
} mdl_scheme;

typedef struct mdl_descriptor {
  int abi_version;
  const char *name;
  const char *hash; /* of everything that decides the generated code */
  int n_p, n_u, n_x, n_z, n_v, n_d, n_rel, n_sample, n_when, n_variables, n_equations, n_asserts, n_messages;

  const mdl_variable *variables;                     /* [n_variables] in order of declaration */
  const mdl_equation *equations;                     /* [n_equations] */
  const mdl_assert *asserts;                         /* [n_asserts] */
  const mdl_relation *relations;                     /* [n_rel] */
  const char *const *messages;                       /* [n_messages] of terminate() */
  const int *z_index;                                /* [n_z] z[k] is v[z_index[k]] */
  const int *residual_equation;                      /* [n_x + n_z] which equation each residual row is */
  const double *p_start;                             /* [n_p] declared values of the settable parameters */
  double start_time, stop_time, tolerance, interval; /* annotation(experiment); interval 0 where not given */

  /* Pattern of dF/dy + cj dF/dy', compressed columns: n_x + n_z columns. */
  int jac_nnz;
  const int *jac_colptr; /* [n_x + n_z + 1] */
  const int *jac_rowidx; /* [jac_nnz] */

  /* Dependent parameters from the settable ones, then bounds, and the asserts that depend on parameters alone. Call
   * after every change of p. */
  int (*parameters)(mdl_data *m);

  /* Start times and intervals (s) of the sample() operators. */
  int (*samples)(const mdl_data *m, double *start, double *interval);

  /* Start attributes, which may depend on parameters: writes m->x, m->v, m->d and m->pre_d. Call once before
   * initial_system; event() then gives m->d its initial values, iterated as at any event with m->initial set. */
  int (*starts)(mdl_data *m);

  /* Solve the initial equations at time t with the present relations and discretes: writes m->x, m->xdot, m->v
   * (entry values are start values of nonlinear blocks). */
  int (*initial_system)(mdl_data *m, double t);

  /* Explicit form: xdot[n_x] and v[n_v] from x, inputs, discretes and frozen relations. v holds start values
   * of nonlinear blocks on entry. */
  int (*rhs)(mdl_data *m, double t, const double *x, double *xdot, double *v);

  /* Residual form. `values` [jac_nnz] in the pattern above. */
  int (*residual)(mdl_data *m, double t, const double *y, const double *yp, double *r);
  int (*jacobian)(mdl_data *m, double t, const double *y, const double *yp, double cj, double *values);

  /* g[n_rel]: left minus right side of each relation, which is true exactly where g > 0 (a >= b is kept as the
   * negation of b > a), at a complete point. Time relations give 0. */
  int (*roots)(mdl_data *m, double t, const double *x, const double *xdot, const double *v, double *g);

  /* Set m->rel of the time relations to their value just after time t. */
  int (*time_relations)(mdl_data *m, double t);
  /* Next instant later than t at which a time relation switches; INFINITY if there is none. */
  double (*next_time_event)(const mdl_data *m, double t);

  /* One pass of the discrete equations, when clauses and event algorithms, in sorted order: writes m->d from
   * m->pre_d, m->rel, m->tick and the given point; may reinit x in place. The runtime repeats
   * rhs / relations / event with pre_d := d until nothing changes. A when fires where its condition is
   * true and m->when (the condition before this pass) is false; event() updates m->when itself. */
  int (*event)(mdl_data *m, double t, double *x, const double *xdot, const double *v);

  /* Check the other asserts at an accepted point; not 0, with m->failure set: one is violated. NULL: no others. */
  int (*check)(mdl_data *m, double t, const double *x, const double *xdot, const double *v);

  const struct mdl_tangents *tangents; /* derivatives (mdl_tangent.h); NULL where they were not asked for */
  int n_computed;
  const mdl_computed *computed;  /* [n_computed] */
  const int *equation_first;     /* [n_equations + 1] where the variables of an equation begin in */
  const int *equation_variables; /* rows of `variables` */

  /* Sizes of the unknowns [n_x + n_z], of the guards [n_rel] and of what is delayed [n_delay] for the present
   * parameters, as far as the model tells; 0 where it does not. */
  int (*nominals)(mdl_data *m, double *nominal);

  /* value[2 k], value[2 k + 1]: numerator and divisor of division k, at a complete point; NAN where the division is in
   * a branch that does not hold. A divisor that passes through zero while the numerator does not is a division by
   * zero. */
  int n_divisions;
  const int *division_equation; /* [n_divisions] */
  int (*divisions)(mdl_data *m, double t, const double *x, const double *xdot, const double *v, double *value);

  /* How closely the guards of state relations have to be looked at inside a step. phase[n_phases] (rad): arguments of
   * sin and cos that guards follow, at a complete point. curved_guards: some guard follows the states in another way
   * that is not affine. */
  int n_phases, curved_guards;
  int (*phases)(mdl_data *m, double t, const double *x, const double *xdot, const double *v, double *phase);

  /* delay(e, T): input `delay_input[k]` is what value[k] was seconds[k] ago. `delays` gives e at a complete point,
   * `delay_times` the times T, which only parameters decide; equation `delay_equation[k]` is where it stands. */
  int n_delay;
  const int *delay_input, *delay_equation; /* [n_delay] */
  int (*delay_times)(const mdl_data *m, double *seconds);
  int (*delays)(mdl_data *m, double t, const double *x, const double *xdot, const double *v, double *value);

  /* spatialDistribution(): m->carried(m, k, end, x, order) is what transport k holds at `end` (0 or 1) when it is at
   * position x, or its derivative by x. `transports` gives in0, in1, x and whether it moves forward (0/1) of each at a
   * complete point; `transport_initial` the transport_points[k] initial points of each, each followed by their values.
   * u[transport_input[2 k]] and [2 k + 1] are positions x, above and below the present one, at which what comes to an
   * end jumps or bends: an event. */
  int n_transport;
  const int *transport_input;  /* [2 n_transport] */
  const int *transport_points; /* [n_transport] */
  int (*transport_initial)(const mdl_data *m, double *value);
  int (*transports)(mdl_data *m, double t, const double *x, const double *xdot, const double *v, double *value);

  /* [n_z] 0: unknown z follows from linear equations, so it has one value at a point; NULL: none does. */
  const unsigned char *z_branches;

  /* Bits: MDL_FOLLOWS event() reads v or xdot that follow, through equations, d that it sets; MDL_ARRIVAL it reads, in
   * m->v, what v was on arrival. */
  int events_follow;

  /* [n_rel] 1: between events the guard is an affine function of states and time; NULL: none is. guard_rates: g[r] of
   * those guards in a direction in which time moves by t and the states by x, whatever the point. Frozen is what m
   * holds, unknowns that are constant between events among it. */
  const unsigned char *affine_guards;
  int (*guard_rates)(mdl_data *m, double t, const double *x, double *g);

  int n_branches;
  const mdl_computed *branches; /* [n_branches] where nonlinear blocks start from, and the first equation of each */

  int n_lasting;
  const mdl_lasting *lasting; /* [n_lasting] NULL: the equations that were differentiated do not switch */

  const unsigned char *least_sizes; /* [n_x] 1: a state is as large as its size at least; NULL: none is told so */

  /* All stages of a step of h from (t, x), with its slopes in k[0 .. n_x): as rhs() gives, brief but for the last,
   * k[j n_x + i] = x'_i at x + h sum_l weights[j][l] k_l; x1 and v are those of the last. NULL: one by one. */
  int (*stages)(mdl_data *m, const mdl_scheme *, double t, double h, const double *x, double *k, double *x1, double *v);
  int n_redundant;
  const mdl_computed *redundant; /* [n_redundant] fixed start values that the other initial conditions have to give */
} mdl_descriptor;

typedef const mdl_descriptor *(*mdl_descriptor_fn)(void);

#ifdef __cplusplus
}
#endif
#endif
