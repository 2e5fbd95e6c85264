/* Why an instance says no: its message, and the failure of the run below it; what the run warns of. */
#include <stdarg.h>
#include <stdio.h>

#include "fmu.h"

bool fmu_refuse(fmu *f, const char *format, ...) {
  char message[700];
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(message, sizeof message, format, arguments);
  va_end(arguments);
  f->say(f, false, message);
  return false;
}

/* Asserts of level warning that have been violated since. */
static void say_warnings(fmu *f) {
  rt_result *r = f->session->result;
  for (; f->warnings_said < r->n_warnings; f->warnings_said++)
    f->say(f, true, r->warnings[f->warnings_said]);
}

bool fmu_done(fmu *f, rt_status status) {
  say_warnings(f);
  return status ? fmu_refuse(f, "%s", f->session->failure.message) : true;
}
