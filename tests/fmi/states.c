/* States as bytes that were changed, their checksum made right again, as somebody would who means harm; for the address
 * sanitizer. What is refused is refused; what is taken must not lead out of memory, whatever its numbers are.
 * usage: states TOKEN COUNT SEED */
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include "fmi3Functions.h"

static void silent(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category, fmi3String message) {
  (void)environment, (void)status, (void)category, (void)message;
}

static uint64_t next(uint64_t *seed) {
  *seed ^= *seed << 13, *seed ^= *seed >> 7, *seed ^= *seed << 17;
  return *seed;
}

static void sign(const char *token, unsigned char *bytes, size_t size) {
  uint64_t sum = 0xcbf29ce484222325u;
  for (const char *c = token; *c; c++)
    sum = (sum ^ (unsigned char)*c) * 0x100000001b3u;
  for (size_t i = 0; i < size - sizeof sum; i++)
    sum = (sum ^ bytes[i]) * 0x100000001b3u;
  memcpy(bytes + size - sizeof sum, &sum, sizeof sum);
}

/* Runs of the same byte, or one bit: small, huge, negative and not a number all come up. */
static void change(unsigned char *bytes, size_t size, uint64_t *seed) {
  static const unsigned char values[] = {0, 1, 2, 127, 128, 255};
  for (uint64_t many = 1 + next(seed) % 3; many; many--) {
    size_t at = next(seed) % size, length = 1 + next(seed) % 8;
    if (next(seed) % 2)
      bytes[at] ^= (unsigned char)(1u << next(seed) % 8);
    else
      memset(bytes + at, values[next(seed) % sizeof values], length < size - at ? length : size - at);
  }
}

static fmi3Instance begun(const char *token) {
  fmi3Instance f =
      fmi3InstantiateCoSimulation("s", token, NULL, false, false, false, false, NULL, 0, NULL, silent, NULL);
  bool event, end, early;
  double reached = 0;
  if (!f || fmi3EnterInitializationMode(f, false, 0, 0, false, 0) || fmi3ExitInitializationMode(f)) return NULL;
  for (int k = 0; k < 5; k++)
    fmi3DoStep(f, k * 1e-3, 1e-3, true, &event, &end, &early, &reached);
  return f;
}

/* In a process of its own. Its numbers may ask for any number of steps: that it has taken some is enough. */
static void go_on(fmi3Instance f, fmi3FMUState state) {
  struct itimerval some = {.it_value = {.tv_usec = 50000}};
  bool event, end, early;
  double reached;
  setitimer(ITIMER_VIRTUAL, &some, NULL);
  if (!fmi3SetFMUState(f, state)) fmi3DoStep(f, 5e-3, 1e-3, true, &event, &end, &early, &reached);
  _exit(0);
}

int main(int argc, char **argv) {
  if (argc < 4) return 2;
  uint64_t seed = strtoull(argv[3], NULL, 10);
  size_t size = 0;
  int taken = 0, count = atoi(argv[2]);
  fmi3Instance f = begun(argv[1]);
  fmi3FMUState state = NULL;
  if (!f || fmi3GetFMUState(f, &state) || fmi3SerializedFMUStateSize(f, state, &size)) return 1;
  unsigned char *bytes = malloc(size), *changed = malloc(size);
  if (fmi3SerializeFMUState(f, state, bytes, size)) return 1;
  memcpy(changed, bytes, size);
  changed[size / 2] ^= 1;
  fmi3FMUState other = NULL;
  if (!fmi3DeserializeFMUState(f, changed, size, &other)) return 3; /* without its checksum */
  for (int k = 0; k < count; k++) {
    memcpy(changed, bytes, size);
    change(changed, size - sizeof(uint64_t), &seed);
    sign(argv[1], changed, size);
    if (fmi3DeserializeFMUState(f, changed, size, &other)) continue;
    taken++;
    int status = 0;
    pid_t child = fork();
    if (child == 0) go_on(f, other);
    if (waitpid(child, &status, 0) < 0) return 1;
    if (!(WIFEXITED(status) && WEXITSTATUS(status) == 0) && !(WIFSIGNALED(status) && WTERMSIG(status) == SIGVTALRM))
      return 4;
    fmi3FreeFMUState(f, &other);
  }
  printf("%d of %d taken\n", taken, count);
  fmi3FreeFMUState(f, &state);
  fmi3FreeInstance(f);
  free(bytes), free(changed);
  return 0;
}
