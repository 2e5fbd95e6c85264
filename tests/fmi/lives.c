/* Instances that are made, run for a few steps, kept, restored and freed, again and again; for the address sanitizer.
 * usage: lives TOKEN COUNT [cs], which leaves out model exchange */
#include <stdio.h>
#include <stdlib.h>

#include "fmi3Functions.h"

static void say(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category, fmi3String message) {
  (void)environment, (void)status, (void)category;
  fprintf(stderr, "%s\n", message);
}

static int steps(const char *token) {
  fmi3Instance f =
      fmi3InstantiateCoSimulation("life", token, NULL, false, true, false, false, NULL, 0, NULL, say, NULL);
  if (!f) return 1;
  fmi3FMUState state = NULL;
  bool event, end = false, early;
  double reached = 0, step = 1e-3;
  int failed = fmi3EnterInitializationMode(f, false, 0, 0, false, 0) || fmi3ExitInitializationMode(f);
  for (int k = 0; k < 6 && !failed && !end; k++) {
    failed = fmi3DoStep(f, k * step, step, true, &event, &end, &early, &reached);
    if (k == 2 && !failed) failed = fmi3GetFMUState(f, &state);
  }
  if (state) failed |= fmi3SetFMUState(f, state) || fmi3FreeFMUState(f, &state);
  failed |= fmi3DoStep(f, 3 * step, step, true, &event, &end, &early, &reached) || fmi3Terminate(f);
  fmi3FreeInstance(f);
  return failed;
}

static int derivatives(const char *token) {
  fmi3Instance f = fmi3InstantiateModelExchange("life", token, NULL, false, true, NULL, say);
  if (!f) return 1;
  size_t n = 0, events = 0;
  bool again, end, nominals, states, next;
  double time;
  int failed = fmi3EnterInitializationMode(f, false, 0, 0, false, 0) || fmi3ExitInitializationMode(f) ||
               fmi3UpdateDiscreteStates(f, &again, &end, &nominals, &states, &next, &time) ||
               fmi3EnterContinuousTimeMode(f) || fmi3GetNumberOfContinuousStates(f, &n) ||
               fmi3GetNumberOfEventIndicators(f, &events);
  double *x = calloc(n + events + 1, sizeof *x);
  failed |= fmi3GetContinuousStateDerivatives(f, x, n) || fmi3GetEventIndicators(f, x, events);
  failed |= fmi3Reset(f);
  free(x);
  fmi3FreeInstance(f);
  return failed;
}

int main(int argc, char **argv) {
  int count = argc > 2 ? atoi(argv[2]) : 1;
  for (int k = 0; k < count; k++)
    if (steps(argv[1]) || (argc < 4 && derivatives(argv[1]))) return 1;
  printf("%d lives\n", count);
  return 0;
}
