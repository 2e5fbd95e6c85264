/* What a run has recorded (result.c). */
#ifndef RT_RESULT_H
#define RT_RESULT_H

#include <stdbool.h>

#include "lacuna_runtime.h"

#define RT_MOST_VALUES 5e8 /* that a result may hold: 4 GiB */

struct rt_result {
  rt_failure failure;
  rt_counters counters;
  const char *terminated;
  size_t rows, capacity;
  int n;
  double *time;
  double **columns;
  unsigned char *event;
  double *parameters; /* [n_p] */
  size_t n_events, events_capacity;
  rt_event_entry *events;
  int n_sensitivities; /* of each output; their columns follow those of the outputs */
  double *margins;     /* [n_sensitivities] */
  size_t n_flags, flags_capacity;
  rt_flag *flags;
  size_t n_warnings;
  char **warnings;
  bool told_open; /* which unknowns the equations do not determine */
  bool lost;      /* an event, a flag or a warning that there was no memory for */
};
rt_result *rt_result_new(int columns, int sensitivities, int parameters, size_t capacity);
bool rt_result_reserve(rt_result *r, size_t rows);
void rt_result_log(rt_result *r, double time, int kind, int index, int direction, double reach);
void rt_result_warn(rt_result *r, const char *message);
void rt_result_flag(rt_result *r, double time, rt_flag_kind kind, int relation, int other);

#endif
