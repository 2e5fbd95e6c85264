/* Results: one array for each column, grown by doubling; the event log; counters. */
#include <stdlib.h>
#include <string.h>

#include "session.h"

rt_result *rt_result_new(int columns, int sensitivities, int parameters, size_t capacity) {
  rt_result *r = calloc(1, sizeof *r);
  if (!r) return NULL;
  r->n = columns * (1 + sensitivities);
  r->n_sensitivities = sensitivities;
  r->columns = calloc((size_t)r->n + 1, sizeof *r->columns);
  r->parameters = calloc((size_t)parameters + 1, sizeof *r->parameters);
  r->margins = calloc((size_t)sensitivities + 1, sizeof *r->margins);
  if (r->columns && r->parameters && r->margins && rt_result_reserve(r, capacity)) return r;
  rt_result_free(r);
  return NULL;
}

void rt_result_free(rt_result *r) {
  if (!r) return;
  for (int j = 0; r->columns && j < r->n; j++)
    free(r->columns[j]);
  free(r->columns);
  free(r->time);
  free(r->event);
  free(r->events);
  free(r->parameters);
  free(r->margins);
  free(r->flags);
  for (size_t k = 0; k < r->n_warnings; k++)
    free(r->warnings[k]);
  free(r->warnings);
  free(r);
}

static bool grow(void *array, size_t bytes) {
  void **place = array, *larger = realloc(*place, bytes);
  if (larger) *place = larger;
  return larger != NULL;
}

/* Room for `rows` rows in all; false without memory. */
bool rt_result_reserve(rt_result *r, size_t rows) {
  if (rows <= r->capacity) return true;
  size_t capacity = rows > 2 * r->capacity ? rows : 2 * r->capacity;
  bool done = grow(&r->time, capacity * sizeof *r->time) && grow(&r->event, capacity);
  for (int j = 0; done && j < r->n; j++)
    done = grow(&r->columns[j], capacity * sizeof **r->columns);
  if (done) r->capacity = capacity;
  return done;
}

void rt_result_log(rt_result *r, double time, int kind, int index, int direction, double reach) {
  if (r->n_events == r->events_capacity) {
    size_t capacity = r->events_capacity ? 2 * r->events_capacity : 64;
    if (!grow(&r->events, capacity * sizeof *r->events)) {
      r->lost = true;
      return;
    }
    r->events_capacity = capacity;
  }
  r->events[r->n_events++] =
      (rt_event_entry){.time = time, .kind = kind, .index = index, .direction = direction, .reach = reach};
}

void rt_result_flag(rt_result *r, double time, rt_flag_kind kind, int relation, int other) {
  if (r->n_flags == r->flags_capacity) {
    size_t capacity = r->flags_capacity ? 2 * r->flags_capacity : 16;
    if (!grow(&r->flags, capacity * sizeof *r->flags)) {
      r->lost = true;
      return;
    }
    r->flags_capacity = capacity;
  }
  r->flags[r->n_flags++] = (rt_flag){.time = time, .kind = kind, .relation = relation, .other = other};
}

/* A copy of the message. */
void rt_result_warn(rt_result *r, const char *message) {
  size_t size = strlen(message) + 1;
  char *copy = malloc(size);
  if (!copy || !grow(&r->warnings, (r->n_warnings + 1) * sizeof *r->warnings)) {
    free(copy);
    r->lost = true;
    return;
  }
  memcpy(copy, message, size);
  r->warnings[r->n_warnings++] = copy;
}

const rt_failure *rt_result_failure(const rt_result *r) {
  return &r->failure;
}
const char *rt_result_terminated(const rt_result *r) {
  return r->terminated;
}
const rt_counters *rt_result_counters(const rt_result *r) {
  return &r->counters;
}
size_t rt_result_rows(const rt_result *r) {
  return r->rows;
}
const double *rt_result_time(const rt_result *r) {
  return r->time;
}
const unsigned char *rt_result_event_flags(const rt_result *r) {
  return r->event;
}
const double *rt_result_column(const rt_result *r, int column) {
  return column >= 0 && column < r->n / (1 + r->n_sensitivities) ? r->columns[column] : NULL;
}

const double *rt_result_sensitivity(const rt_result *r, int column, int k) {
  int outputs = r->n / (1 + r->n_sensitivities);
  bool valid = column >= 0 && column < outputs && k >= 0 && k < r->n_sensitivities;
  return valid ? r->columns[outputs + column * r->n_sensitivities + k] : NULL;
}
const double *rt_result_margins(const rt_result *r) {
  return r->margins;
}
const rt_flag *rt_result_flags(const rt_result *r, size_t *count) {
  *count = r->n_flags;
  return r->flags;
}

const char *const *rt_result_warnings(const rt_result *r, size_t *count) {
  *count = r->n_warnings;
  return (const char *const *)r->warnings;
}

const double *rt_result_parameters(const rt_result *r) {
  return r->parameters;
}

const rt_event_entry *rt_result_events(const rt_result *r, size_t *count) {
  *count = r->n_events;
  return r->events;
}
