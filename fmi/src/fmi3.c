/* FMI 3.0 over an instance (fmu.h): types and status only, nothing is computed here. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fmi3Functions.h"
#include "fmu.h"

static fmi3Status status(bool done) {
  return done ? fmi3OK : fmi3Error;
}

static void say(fmu *f, bool warning, const char *message) {
  fmi3LogMessageCallback log = (fmi3LogMessageCallback)f->logger;
  const char *category = warning ? "logStatusWarning" : "logStatusError";
  if (log) log(f->environment, warning ? fmi3Warning : fmi3Error, category, message);
}

const char *fmi3GetVersion(void) {
  return fmi3Version;
}

fmi3Status fmi3SetDebugLogging(fmi3Instance instance, fmi3Boolean on, size_t n, const fmi3String categories[]) {
  (void)n, (void)categories;
  ((fmu *)instance)->logging = on;
  return fmi3OK;
}

static fmi3Instance instantiate(const char *name, const char *token, bool logging, void *environment,
                                fmi3LogMessageCallback log, bool co_simulation, bool event_mode, bool early_return) {
  fmu *f = calloc(1, sizeof *f);
  if (!f) return NULL;
  f->environment = environment;
  f->logger = (void (*)(void))log;
  f->say = say;
  f->logging = logging;
  f->co_simulation = co_simulation;
  f->event_mode = event_mode;
  f->early_return = early_return;
  if (fmu_create(f, name, token)) return f;
  fmu_destroy(f);
  return NULL;
}

fmi3Instance fmi3InstantiateModelExchange(fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible,
                                          fmi3Boolean logging, fmi3InstanceEnvironment environment,
                                          fmi3LogMessageCallback log) {
  (void)resources, (void)visible;
  return instantiate(name, token, logging, environment, log, false, true, false);
}

fmi3Instance fmi3InstantiateCoSimulation(fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible,
                                         fmi3Boolean logging, fmi3Boolean event_mode, fmi3Boolean early_return,
                                         const fmi3ValueReference required[], size_t n,
                                         fmi3InstanceEnvironment environment, fmi3LogMessageCallback log,
                                         fmi3IntermediateUpdateCallback update) {
  (void)resources, (void)visible, (void)required, (void)update;
  if (n == 0) return instantiate(name, token, logging, environment, log, true, event_mode, early_return);
  if (log) log(environment, fmi3Error, "logStatusError", "there are no intermediate variables");
  return NULL;
}

void fmi3FreeInstance(fmi3Instance instance) {
  fmu_destroy(instance);
}

fmi3Status fmi3EnterInitializationMode(fmi3Instance instance, fmi3Boolean tolerance_given, fmi3Float64 tolerance,
                                       fmi3Float64 start, fmi3Boolean stop_given, fmi3Float64 stop) {
  return status(fmu_enter_initialisation(instance, start, stop_given ? stop : NAN, tolerance_given ? tolerance : 0));
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance instance) {
  return status(fmu_exit_initialisation(instance));
}

fmi3Status fmi3EnterEventMode(fmi3Instance instance) {
  return status(fmu_enter_event(instance));
}

fmi3Status fmi3Terminate(fmi3Instance instance) {
  return status(fmu_terminate(instance));
}

fmi3Status fmi3Reset(fmi3Instance instance) {
  return status(fmu_reset(instance));
}

static bool counts(fmu *f, size_t n, const fmi3ValueReference references[], size_t values) {
  size_t wanted = fmu_count(n, references);
  return values == wanted || fmu_refuse(f, "%zu values for %zu variables, which have %zu", values, n, wanted);
}

/* Getters and setters of the types that variables have; those of all other types refuse. */
#define VALUES(Name, type)                                                                                             \
  fmi3Status fmi3Get##Name(fmi3Instance instance, const fmi3ValueReference references[], size_t n,                     \
                           fmi3##Name values[], size_t n_values) {                                                     \
    return status(counts(instance, n, references, n_values) && fmu_get(instance, n, references, type, values));        \
  }                                                                                                                    \
  fmi3Status fmi3Set##Name(fmi3Instance instance, const fmi3ValueReference references[], size_t n,                     \
                           const fmi3##Name values[], size_t n_values) {                                               \
    return status(counts(instance, n, references, n_values) && fmu_set(instance, n, references, type, values));        \
  }
VALUES(Float64, FMU_DOUBLE)
VALUES(Int32, FMU_INT)
VALUES(Boolean, FMU_BOOL)

fmi3Status fmi3GetFMUState(fmi3Instance instance, fmi3FMUState *state) {
  return status(fmu_save(instance, state));
}

fmi3Status fmi3SetFMUState(fmi3Instance instance, fmi3FMUState state) {
  return status(fmu_load(instance, state));
}

fmi3Status fmi3FreeFMUState(fmi3Instance instance, fmi3FMUState *state) {
  (void)instance;
  free(*state);
  *state = NULL;
  return fmi3OK;
}

fmi3Status fmi3SerializedFMUStateSize(fmi3Instance instance, fmi3FMUState state, size_t *size) {
  (void)instance;
  *size = fmu_packed_size(state);
  return fmi3OK;
}

fmi3Status fmi3SerializeFMUState(fmi3Instance instance, fmi3FMUState state, fmi3Byte bytes[], size_t size) {
  return status(fmu_pack(instance, state, bytes, size));
}

fmi3Status fmi3DeserializeFMUState(fmi3Instance instance, const fmi3Byte bytes[], size_t size, fmi3FMUState *state) {
  return status(fmu_unpack(instance, bytes, size, state));
}

fmi3Status fmi3GetDirectionalDerivative(fmi3Instance instance, const fmi3ValueReference unknowns[], size_t n_unknowns,
                                        const fmi3ValueReference knowns[], size_t n_knowns, const fmi3Float64 seed[],
                                        size_t n_seed, fmi3Float64 sensitivity[], size_t n_sensitivity) {
  return status(counts(instance, n_knowns, knowns, n_seed) && counts(instance, n_unknowns, unknowns, n_sensitivity) &&
                fmu_directional(instance, n_unknowns, unknowns, n_knowns, knowns, seed, sensitivity));
}

fmi3Status fmi3UpdateDiscreteStates(fmi3Instance instance, fmi3Boolean *again, fmi3Boolean *terminate,
                                    fmi3Boolean *nominals_changed, fmi3Boolean *states_changed,
                                    fmi3Boolean *next_defined, fmi3Float64 *next) {
  fmu_news news;
  if (!fmu_happen(instance, &news)) return fmi3Error;
  *again = false;
  *terminate = news.terminate;
  *nominals_changed = news.nominals_changed;
  *states_changed = news.states_changed;
  *next_defined = news.next_defined;
  *next = news.next;
  return fmi3OK;
}

fmi3Status fmi3EnterContinuousTimeMode(fmi3Instance instance) {
  return status(fmu_leave_event(instance));
}

fmi3Status fmi3CompletedIntegratorStep(fmi3Instance instance, fmi3Boolean no_return, fmi3Boolean *event,
                                       fmi3Boolean *terminate) {
  (void)no_return;
  return status(fmu_completed_step(instance, event, terminate));
}

fmi3Status fmi3SetTime(fmi3Instance instance, fmi3Float64 time) {
  return status(fmu_set_time(instance, time));
}

fmi3Status fmi3SetContinuousStates(fmi3Instance instance, const fmi3Float64 x[], size_t n) {
  return status(fmu_set_states(instance, n, x));
}

fmi3Status fmi3GetContinuousStateDerivatives(fmi3Instance instance, fmi3Float64 xdot[], size_t n) {
  return status(fmu_derivatives(instance, n, xdot));
}

fmi3Status fmi3GetEventIndicators(fmi3Instance instance, fmi3Float64 z[], size_t n) {
  return status(fmu_indicators(instance, n, z));
}

fmi3Status fmi3GetContinuousStates(fmi3Instance instance, fmi3Float64 x[], size_t n) {
  return status(fmu_states(instance, n, x));
}

fmi3Status fmi3GetNominalsOfContinuousStates(fmi3Instance instance, fmi3Float64 nominals[], size_t n) {
  return status(fmu_nominals(instance, n, nominals));
}

fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance instance, size_t *n) {
  *n = (size_t)((fmu *)instance)->n_indicators;
  return fmi3OK;
}

fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance instance, size_t *n) {
  *n = (size_t)((fmu *)instance)->session->d->n_x;
  return fmi3OK;
}

fmi3Status fmi3EnterStepMode(fmi3Instance instance) {
  return status(fmu_leave_event(instance));
}

fmi3Status fmi3DoStep(fmi3Instance instance, fmi3Float64 from, fmi3Float64 size, fmi3Boolean no_return,
                      fmi3Boolean *event, fmi3Boolean *terminate, fmi3Boolean *early, fmi3Float64 *reached) {
  (void)no_return;
  fmu *f = instance;
  bool done = fmu_step(f, from, size, f->event_mode && f->early_return, event);
  *terminate = f->session->data.terminated != 0;
  *early = f->early_return && done && (*event || *terminate) && f->session->t < from + size;
  *reached = f->session->t;
  return status(done);
}
