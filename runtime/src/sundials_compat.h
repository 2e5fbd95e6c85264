/* One source for SUNDIALS 6.4 to 7.x: what was renamed or changed its arguments between them. */
#ifndef RT_SUNDIALS_COMPAT_H
#define RT_SUNDIALS_COMPAT_H

#include <idas/idas.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_version.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunlinsol/sunlinsol_klu.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunmatrix/sunmatrix_sparse.h>

#if SUNDIALS_VERSION_MAJOR < 7
#define SUN_COMM_NULL NULL
static inline void rt_ignore_error(int code, const char *module, const char *function, char *message, void *data) {
  (void)code, (void)module, (void)function, (void)message, (void)data;
}
/* The runtime reports failures itself; SUNDIALS must not write to the terminal. */
static inline int rt_silence(SUNContext context, void *ida) {
  (void)context;
  return IDASetErrHandlerFn(ida, rt_ignore_error, NULL);
}
#else
static inline int rt_silence(SUNContext context, void *ida) {
  (void)ida;
  return SUNContext_ClearErrHandlers(context);
}
#endif

#endif
