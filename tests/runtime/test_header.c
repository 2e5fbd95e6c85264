/* The public header is C as well as C++: this file only has to compile. */
#include "lacuna_runtime.h"

int rt_header_compiles_as_c(const rt_result *result);
int rt_header_compiles_as_c(const rt_result *result) {
  return rt_result_failure(result)->status == RT_OK;
}
