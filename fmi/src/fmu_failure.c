/* Why an instance says no: its message, and the failure of the run below it. */
#include <stdarg.h>
#include <stdio.h>

#include "fmu.h"

bool fmu_refuse(fmu *f, const char *format, ...) {
  char message[700];
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(message, sizeof message, format, arguments);
  va_end(arguments);
  f->say(f, message);
  return false;
}

bool fmu_done(fmu *f, rt_status status) {
  return status ? fmu_refuse(f, "%s", f->session->failure.message) : true;
}
