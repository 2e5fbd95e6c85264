/* Opening a generated model. */
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "session.h"

rt_model *rt_model_wrap(const mdl_descriptor *descriptor, char *message, size_t size) {
  if (!descriptor || descriptor->abi_version != MDL_ABI_VERSION) {
    snprintf(message, size, "model has ABI version %d, this runtime needs %d: translate the model again",
             descriptor ? descriptor->abi_version : 0, MDL_ABI_VERSION);
    return NULL;
  }
  rt_model *model = calloc(1, sizeof *model);
  if (model)
    model->descriptor = descriptor;
  else
    snprintf(message, size, "out of memory");
  return model;
}

rt_model *rt_model_open(const char *path, char *message, size_t size) {
  void *library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
  if (!library) {
    snprintf(message, size, "cannot open model: %s", dlerror());
    return NULL;
  }
  /* POSIX: a function pointer travels through dlsym's void * by copying its bits */
  void *symbol = dlsym(library, "mdl_descriptor_get");
  mdl_descriptor_fn get;
  memcpy(&get, &symbol, sizeof get);
  if (!symbol) snprintf(message, size, "%s is not a generated model: it has no mdl_descriptor_get", path);
  rt_model *model = symbol ? rt_model_wrap(get(), message, size) : NULL;
  if (model)
    model->library = library;
  else
    dlclose(library);
  return model;
}

void rt_model_close(rt_model *model) {
  if (!model) return;
  if (model->library) dlclose(model->library);
  free(model);
}

const mdl_descriptor *rt_model_descriptor(const rt_model *model) {
  return model->descriptor;
}

int rt_model_find(const rt_model *model, const char *name) {
  const mdl_descriptor *d = model->descriptor;
  for (int i = 0; i < d->n_variables; i++)
    if (strcmp(d->variables[i].name, name) == 0) return i;
  return -1;
}
