/* FMI 2.0 over an instance (fmu.h): types and status only, nothing is computed here. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fmi2Functions.h"
#include "fmu.h"

/* What fmi2SetupExperiment has said, until initialisation begins. */
typedef struct {
  fmu base;
  double start, stop, tolerance;
} component;

static fmi2Status status(bool done) {
  return done ? fmi2OK : fmi2Error;
}

static void say(fmu *f, bool warning, const char *message) {
  fmi2CallbackLogger log = (fmi2CallbackLogger)f->logger;
  if (log)
    log(f->environment, f->name ? f->name : "", warning ? fmi2Warning : fmi2Error,
        warning ? "logStatusWarning" : "logStatusError", "%s", message);
}

const char *fmi2GetTypesPlatform(void) {
  return fmi2TypesPlatform;
}

const char *fmi2GetVersion(void) {
  return fmi2Version;
}

fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, size_t n, const fmi2String categories[]) {
  (void)n, (void)categories;
  ((fmu *)c)->logging = on;
  return fmi2OK;
}

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                              const fmi2CallbackFunctions *callbacks, fmi2Boolean visible, fmi2Boolean logging) {
  (void)resources, (void)visible;
  component *c = calloc(1, sizeof *c);
  if (!c) return NULL;
  fmu *f = &c->base;
  if (callbacks) { /* copied: an importer may reuse its struct, as fmusim does */
    f->logger = (void (*)(void))callbacks->logger;
    f->environment = callbacks->componentEnvironment;
  }
  f->say = say;
  f->logging = logging;
  f->co_simulation = type == fmi2CoSimulation;
  c->start = fmu_configuration.start_time;
  c->stop = NAN;
  if (fmu_create(f, name, guid)) return c;
  fmu_destroy(f);
  return NULL;
}

void fmi2FreeInstance(fmi2Component c) {
  fmu_destroy(c);
}

fmi2Status fmi2SetupExperiment(fmi2Component instance, fmi2Boolean tolerance_given, fmi2Real tolerance, fmi2Real start,
                               fmi2Boolean stop_given, fmi2Real stop) {
  component *c = instance;
  c->start = start;
  c->stop = stop_given ? stop : NAN;
  c->tolerance = tolerance_given ? tolerance : 0;
  return fmi2OK;
}

fmi2Status fmi2EnterInitializationMode(fmi2Component instance) {
  component *c = instance;
  return status(fmu_enter_initialisation(&c->base, c->start, c->stop, c->tolerance));
}

fmi2Status fmi2ExitInitializationMode(fmi2Component c) {
  return status(fmu_exit_initialisation(c));
}

fmi2Status fmi2Terminate(fmi2Component c) {
  return status(fmu_terminate(c));
}

fmi2Status fmi2Reset(fmi2Component c) {
  return status(fmu_reset(c));
}

#define VALUES(Name, type)                                                                                             \
  fmi2Status fmi2Get##Name(fmi2Component c, const fmi2ValueReference references[], size_t n, fmi2##Name values[]) {    \
    return status(fmu_get(c, n, references, type, values));                                                            \
  }                                                                                                                    \
  fmi2Status fmi2Set##Name(fmi2Component c, const fmi2ValueReference references[], size_t n,                           \
                           const fmi2##Name values[]) {                                                                \
    return status(fmu_set(c, n, references, type, values));                                                            \
  }
VALUES(Real, FMU_DOUBLE)
VALUES(Integer, FMU_INT)
VALUES(Boolean, FMU_INT)

fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference references[], size_t n, fmi2String values[]) {
  (void)references, (void)values;
  return n == 0 ? fmi2OK : status(fmu_refuse(c, "this FMU has no variables of type String"));
}

fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference references[], size_t n, const fmi2String values[]) {
  (void)references, (void)values;
  return n == 0 ? fmi2OK : status(fmu_refuse(c, "this FMU has no variables of type String"));
}

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *state) {
  return status(fmu_save(c, state));
}

fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state) {
  return status(fmu_load(c, state));
}

fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *state) {
  (void)c;
  free(*state);
  *state = NULL;
  return fmi2OK;
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate state, size_t *size) {
  (void)c;
  *size = fmu_packed_size(state);
  return fmi2OK;
}

fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[], size_t size) {
  return status(fmu_pack(c, state, bytes, size));
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte bytes[], size_t size, fmi2FMUstate *state) {
  return status(fmu_unpack(c, bytes, size, state));
}

fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference unknowns[], size_t n_unknowns,
                                        const fmi2ValueReference knowns[], size_t n_knowns, const fmi2Real seed[],
                                        fmi2Real result[]) {
  return status(fmu_directional(c, n_unknowns, unknowns, n_knowns, knowns, seed, result));
}

fmi2Status fmi2EnterEventMode(fmi2Component c) {
  fmu *f = c;
  return f->mode == FMU_EVENT ? fmi2OK : status(fmu_enter_event(f)); /* allowed straight after initialisation */
}

fmi2Status fmi2NewDiscreteStates(fmi2Component c, fmi2EventInfo *info) {
  fmu_news news;
  if (!fmu_happen(c, &news)) return fmi2Error;
  *info = (fmi2EventInfo){.terminateSimulation = news.terminate,
                          .nominalsOfContinuousStatesChanged = news.nominals_changed,
                          .valuesOfContinuousStatesChanged = news.states_changed,
                          .nextEventTimeDefined = news.next_defined,
                          .nextEventTime = news.next};
  return fmi2OK;
}

fmi2Status fmi2EnterContinuousTimeMode(fmi2Component c) {
  return status(fmu_leave_event(c));
}

fmi2Status fmi2CompletedIntegratorStep(fmi2Component c, fmi2Boolean no_return, fmi2Boolean *enter_event,
                                       fmi2Boolean *terminate) {
  (void)no_return;
  bool event, end = false;
  bool done = fmu_completed_step(c, &event, &end);
  *enter_event = event;
  *terminate = end;
  return status(done);
}

fmi2Status fmi2SetTime(fmi2Component c, fmi2Real time) {
  return status(fmu_set_time(c, time));
}

fmi2Status fmi2SetContinuousStates(fmi2Component c, const fmi2Real x[], size_t n) {
  return status(fmu_set_states(c, n, x));
}

fmi2Status fmi2GetDerivatives(fmi2Component c, fmi2Real xdot[], size_t n) {
  return status(fmu_derivatives(c, n, xdot));
}

fmi2Status fmi2GetEventIndicators(fmi2Component c, fmi2Real z[], size_t n) {
  return status(fmu_indicators(c, n, z));
}

fmi2Status fmi2GetContinuousStates(fmi2Component c, fmi2Real x[], size_t n) {
  return status(fmu_states(c, n, x));
}

fmi2Status fmi2GetNominalsOfContinuousStates(fmi2Component c, fmi2Real nominals[], size_t n) {
  return status(fmu_nominals(c, n, nominals));
}

fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference references[], size_t n,
                                       const fmi2Integer orders[], const fmi2Real values[]) {
  (void)references, (void)orders, (void)values;
  return n == 0 ? fmi2OK : status(fmu_refuse(c, "inputs hold from one communication point to the next"));
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference references[], size_t n,
                                        const fmi2Integer orders[], fmi2Real values[]) {
  (void)references, (void)orders, (void)values;
  return n == 0 ? fmi2OK : status(fmu_refuse(c, "this FMU has no derivatives of outputs by time"));
}

/* A model that terminates ends its step early, which is fmi2Discard. */
fmi2Status fmi2DoStep(fmi2Component c, fmi2Real from, fmi2Real size, fmi2Boolean no_return) {
  (void)no_return;
  fmu *f = c;
  bool event;
  if (!fmu_step(f, from, size, false, &event)) return fmi2Error;
  return f->session->data.terminated ? fmi2Discard : fmi2OK;
}

fmi2Status fmi2CancelStep(fmi2Component c) {
  return status(fmu_refuse(c, "steps are not asynchronous"));
}

fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Status *value) {
  (void)kind, (void)value;
  return fmu_refuse(c, "steps are not asynchronous") ? fmi2OK : fmi2Discard;
}

fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Real *value) {
  if (kind != fmi2LastSuccessfulTime) return fmi2Discard;
  *value = ((fmu *)c)->session->t;
  return fmi2OK;
}

fmi2Status fmi2GetIntegerStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Integer *value) {
  (void)c, (void)kind, (void)value;
  return fmi2Discard;
}

fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Boolean *value) {
  if (kind != fmi2Terminated) return fmi2Discard;
  *value = ((fmu *)c)->session->data.terminated != 0;
  return fmi2OK;
}

fmi2Status fmi2GetStringStatus(fmi2Component c, const fmi2StatusKind kind, fmi2String *value) {
  (void)c, (void)kind, (void)value;
  return fmi2Discard;
}
