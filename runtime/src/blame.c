/* Who is to blame: the rows of the table of variables, lists of their names, and the first equation that gives no
 * finite number. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "session.h"

int rt_find_row(const rt_session *s, mdl_storage storage, int index) {
  for (int i = 0; i < s->d->n_variables; i++)
    if (s->d->variables[i].storage == storage && s->d->variables[i].index == index) return i;
  return -1;
}

/* Row in the variable table of a state, and of an unknown of the residual form; -1 where it has no name. */
int rt_state_variable(const rt_session *s, int state) {
  return rt_find_row(s, MDL_STATE, state);
}

int rt_unknown_variable(const rt_session *s, int k) {
  return k < s->d->n_x ? rt_state_variable(s, k) : rt_find_row(s, MDL_ALGEBRAIC, s->d->z_index[k - s->d->n_x]);
}

/* What has no value, which nobody reads. Its sign may be another: of an alias. */
static bool is_unread(double value) {
  double unread = MDL_UNREAD;
  unsigned long long bits = 0, wanted = 0;
  memcpy(&bits, &value, sizeof bits);
  memcpy(&wanted, &unread, sizeof wanted);
  return bits << 1 == wanted << 1;
}

/* The first equation that gives no finite number, as failure; false where all do. */
bool rt_blame(rt_session *s, mdl_storage storage, const double *xdot, const double *v) {
  for (int k = 0; k < s->d->n_computed; k++) {
    const mdl_computed *c = &s->d->computed[k];
    if ((c->storage == MDL_PARAMETER) != (storage == MDL_PARAMETER)) continue;
    double value = (c->storage == MDL_PARAMETER ? s->data.p : c->storage == MDL_DERIVATIVE ? xdot : v)[c->index];
    if (isfinite(value) || is_unread(value)) continue;
    int row = rt_find_row(s, c->storage == MDL_DERIVATIVE ? MDL_STATE : c->storage, c->index);
    if (c->storage == MDL_PARAMETER && row < 0) continue; /* an inverse that may not be used */
    s->data.failure = (mdl_failure){MDL_FAILURE_NONFINITE, c->equation, row, value, 0};
    return true;
  }
  return false;
}

/* Numbers in v [n_v], but for what nobody reads. */
bool rt_has_values(rt_session *s, const double *xdot, const double *v) {
  if (rt_finite(s->d->n_v, v)) return true;
  mdl_failure told = s->data.failure;
  bool blamed = rt_blame(s, MDL_ALGEBRAIC, xdot, v);
  s->data.failure = told;
  return !blamed;
}

static bool lists(const char *text, const char *name) {
  size_t length = strlen(name);
  for (const char *at = strstr(text, name); at; at = strstr(at + 1, name))
    if ((at == text || at[-1] == ' ') && (!at[length] || at[length] == ',')) return true;
  return false;
}

/* Add a name to the list in `text`, once. */
void rt_append_name(char *text, size_t size, const char *name) {
  size_t used = strlen(text);
  if (lists(text, name) || used + 3 >= size) return;
  snprintf(text + used, size - used, "%s%s", used ? ", " : "", name);
}

/* Add the discrete variables that the last pass changed to the list in `text`. */
void rt_append_changed(const rt_session *s, char *text, size_t size) {
  for (int i = 0; i < s->d->n_variables; i++) {
    const mdl_variable *v = &s->d->variables[i];
    if (v->storage == MDL_DISCRETE && s->data.d[v->index] != s->data.pre_d[v->index])
      rt_append_name(text, size, v->name);
  }
}
