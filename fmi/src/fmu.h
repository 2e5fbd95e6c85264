/* An instance of an FMU: a session of the runtime, driven from outside instead of by the runtime's own loop. The two
 * versions of the interface (fmi2.c, fmi3.c) are thin layers over these functions.
 *
 * Value references: 0 time; 1 + row, a row of the variable table; then the derivatives of the states; then the event
 * indicators; then the states. An array has that of its first element. All functions return false after a failure,
 * which has been said through `say`. */
#ifndef FMU_H
#define FMU_H

#include "mdl_tangent.h"
#include "session.h"

/* A variable of `n` values: those of this value reference and of the ones that follow it. */
typedef struct {
  unsigned reference, n;
} fmu_array;

/* Written with each FMU (fmu_config.c). */
typedef struct {
  const char *token, *solver;
  double rtol;
  double start_time, stop_time;
  int n_parameters; /* values other than declared: indices into p */
  const int *parameter;
  const double *value;
  int n_arrays;
  const fmu_array *array; /* [n_arrays] by ascending references; of FMI 2.0 there are none */
  int n_starting;         /* states that start at a number: others follow from the initial equations */
  const int *starting;    /* [n_starting] rows of the table of variables, ascending */
} fmu_config;
extern const fmu_config fmu_configuration;
const mdl_descriptor *mdl_descriptor_get(void);

typedef enum { FMU_SETUP, FMU_INITIALISATION, FMU_EVENT, FMU_CONTINUOUS, FMU_STEP, FMU_DONE } fmu_mode;

typedef struct fmu {
  rt_model model;
  rt_session *session;
  double *input;        /* [n_u] as set from outside */
  double *tangent_rows; /* of `tangent`, one vector of directions */
  mdl_tangent tangent;
  int n_indicators, *indicator; /* [n_indicators] relations that are switched by roots */
  fmu_mode mode;
  bool co_simulation;
  bool event_mode;   /* co-simulation: the importer wants to be present at events */
  bool early_return; /* and a step may end there */
  bool begun;        /* the initial equations are solved for what is set now */
  bool fresh;        /* xdot and v belong to t, x and u */
  bool retuned;      /* parameters were set since the last event */
  bool untuned;      /* and what depends on them is not computed yet */
  bool driven;       /* inputs were set since the last event */
  bool logging;
  void *environment;
  double last_stop;     /* the stop time that the importer has given; infinite: none */
  size_t warnings_said; /* of the session's */
  void (*say)(struct fmu *f, bool warning, const char *message);
  void (*logger)(void); /* of the importer, as its version of the interface has it */
  char *name;
} fmu;

/* What an importer is told after an event. */
typedef struct {
  bool terminate, states_changed, nominals_changed, next_defined;
  double next;
} fmu_news;

/* fmu.c: life */
bool fmu_create(fmu *f, const char *name, const char *token);
void fmu_destroy(fmu *f);
bool fmu_reset(fmu *f);
bool fmu_enter_initialisation(fmu *f, double start, double stop, double tolerance);
bool fmu_exit_initialisation(fmu *f);
bool fmu_terminate(fmu *f);

/* fmu_failure.c */
bool fmu_refuse(fmu *f, const char *format, ...) __attribute__((format(printf, 2, 3)));
bool fmu_done(fmu *f, rt_status status);

/* fmu_values.c */
bool fmu_refresh(fmu *f);
void fmu_follow(fmu *f);
typedef enum { FMU_DOUBLE, FMU_INT, FMU_BOOL } fmu_type; /* of the importer's arrays */
size_t fmu_count(size_t n, const unsigned *references);  /* values of n variables */
/* Values of n variables one after another, all of an array. */
bool fmu_get(fmu *f, size_t n, const unsigned *references, fmu_type type, void *values);
bool fmu_set(fmu *f, size_t n, const unsigned *references, fmu_type type, const void *values);
bool fmu_directional(fmu *f, size_t n_unknowns, const unsigned *unknowns, size_t n_knowns, const unsigned *knowns,
                     const double *seed, double *result);

/* fmu_events.c: model exchange, and the events of both */
bool fmu_enter_event(fmu *f);
bool fmu_retune(fmu *f);
bool fmu_happen(fmu *f, fmu_news *news);
bool fmu_set_time(fmu *f, double time);
/* Of the continuous states and the indicators; all refuse a count that is not theirs. */
bool fmu_set_states(fmu *f, size_t n, const double *x);
bool fmu_states(fmu *f, size_t n, double *x);
bool fmu_derivatives(fmu *f, size_t n, double *xdot);
bool fmu_nominals(fmu *f, size_t n, double *nominals);
bool fmu_indicators(fmu *f, size_t n, double *z);
bool fmu_completed_step(fmu *f, bool *event, bool *terminate);
bool fmu_leave_event(fmu *f);

/* fmu_step.c: co-simulation. `event`: stopped before an event that the importer is to let happen. */
bool fmu_step(fmu *f, double from, double size, bool may_stop, bool *event);

/* fmu_snapshot.c: the whole state of an instance in bytes. */
typedef struct {
  size_t size;
  unsigned char bytes[];
} fmu_snapshot;
bool fmu_save(fmu *f, void **snapshot); /* into *snapshot, or a new one where it is NULL */
bool fmu_load(fmu *f, const void *snapshot);
size_t fmu_packed_size(const void *snapshot);
bool fmu_pack(fmu *f, const void *snapshot, void *bytes, size_t size);
bool fmu_unpack(fmu *f, const void *bytes, size_t size, void **snapshot);

#endif
