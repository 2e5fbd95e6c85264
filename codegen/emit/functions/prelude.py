"""Helper functions that a generated model carries along, each only where it is used."""

from __future__ import annotations

import re

from lacuna.codegen.emit.functions.function_body import ROUNDS, STACK
from lacuna.codegen.emit.functions.newton import NEWTON
from lacuna.codegen.emit.functions.random_numbers import NATIVE, WORDS
from lacuna.codegen.emit.text.expression import HELPERS

_FAIL = """\
static int mdl_fail(mdl_data *m, mdl_failure_kind kind, int equation, double value) {
  m->failure = (mdl_failure){kind, equation, -1, value, 0.0};
  return 1;
}"""

_INDEX = """\
/* 0-based offset of the 1-based subscript of a dimension; one outside is noted as a failure. */
static inline int mdl_index(const mdl_data *m, double subscript, int size) {
  if (subscript >= 1.0 && subscript <= size) return (int)subscript - 1;
  (void)mdl_fail((mdl_data *)m, MDL_FAILURE_DOMAIN, -1, subscript);
  return 0;
}"""

_ENTER = f"""\
/* A function begins, with about so many bytes on the stack: not below what the stack bears, nor without end. */
static int mdl_enter(const mdl_data *m, long bytes) {{
  mdl_data *own = (mdl_data *)m;
  if (own->stack == 0) own->rounds = 0;
  if (own->stack + bytes > {STACK}) return !mdl_fail(own, MDL_FAILURE_STACK, -1, (double)own->stack);
  if (++own->rounds > {ROUNDS}) return !mdl_fail(own, MDL_FAILURE_LOOP, -1, (double)own->rounds);
  own->stack += bytes;
  return 1;
}}"""

_SOLVE = """\
/* Solve a x = b in place (row-major, n x n) by Gaussian elimination with scaled partial pivoting; b becomes x. Where a
 * is singular to working precision, 1 + the unknown that it does not determine: rows and columns have no scale. */
static int mdl_solve(int n, double *a, double *b) {
  double size[n];
  for (int i = 0; i < n; ++i) {
    double largest = 0.0;
    for (int j = 0; j < n; ++j)
      if (fabs(a[i * n + j]) > largest) largest = fabs(a[i * n + j]);
    if (!(largest > 0.0) || !isfinite(largest)) return 1 + i;
    const double scale = 1.0 / largest;
    for (int j = 0; j < n; ++j) a[i * n + j] *= scale;
    b[i] *= scale;
  }
  for (int j = 0; j < n; ++j) {
    size[j] = 0.0;
    for (int i = 0; i < n; ++i)
      if (fabs(a[i * n + j]) > size[j]) size[j] = fabs(a[i * n + j]);
  }
  for (int k = 0; k < n; ++k) {
    int pivot = k;
    for (int i = k + 1; i < n; ++i)
      if (fabs(a[i * n + k]) > fabs(a[pivot * n + k])) pivot = i;
    if (!(fabs(a[pivot * n + k]) > 1e-14 * size[k])) return 1 + k;
    if (pivot != k) {
      for (int j = k; j < n; ++j) {
        const double swap = a[k * n + j];
        a[k * n + j] = a[pivot * n + j];
        a[pivot * n + j] = swap;
      }
      const double swap = b[k];
      b[k] = b[pivot];
      b[pivot] = swap;
    }
    for (int i = k + 1; i < n; ++i) {
      const double factor = a[i * n + k] / a[k * n + k];
      if (factor == 0.0) continue;
      for (int j = k + 1; j < n; ++j) a[i * n + j] -= factor * a[k * n + j];
      b[i] -= factor * b[k];
    }
  }
  for (int i = n - 1; i >= 0; --i) {
    for (int j = i + 1; j < n; ++j) b[i] -= a[i * n + j] * b[j];
    b[i] /= a[i * n + i];
  }
  return 0;
}"""

_FACTOR = """\
/* LU factors of a (row-major, n x n) in place, pivots chosen by their size against the largest of their row; row i of
 * the factors is row order[i] of a. Returns 1 where a is singular to working precision. */
static int mdl_factor(int n, double *a, int *order) {
  for (int i = 0; i < n; ++i)
    order[i] = i;
  for (int k = 0; k < n; ++k) {
    int pivot = k;
    double best = 0.0;
    for (int i = k; i < n; ++i) {
      double largest = 0.0;
      for (int j = k; j < n; ++j)
        if (fabs(a[i * n + j]) > largest) largest = fabs(a[i * n + j]);
      const double size = largest > 0.0 ? fabs(a[i * n + k]) / largest : 0.0;
      if (size > best) best = size, pivot = i;
    }
    if (!(best > 1e-14)) return 1;
    const int row = order[k];
    order[k] = order[pivot];
    order[pivot] = row;
    for (int j = 0; j < n && pivot != k; ++j) {
      const double swap = a[k * n + j];
      a[k * n + j] = a[pivot * n + j];
      a[pivot * n + j] = swap;
    }
    for (int i = k + 1; i < n; ++i) {
      a[i * n + k] /= a[k * n + k];
      for (int j = k + 1; j < n; ++j)
        a[i * n + j] -= a[i * n + k] * a[k * n + j];
    }
  }
  return 0;
}"""

_SUBSTITUTE = """\
/* Solves for x with the factors of mdl_factor, in several directions at once. */
MDL_WIDE static void mdl_substitute(int n, const double *a, const int *order, const mdl_lanes *b, mdl_lanes *x) {
  for (int i = 0; i < n; ++i) {
    x[i] = b[order[i]];
    for (int j = 0; j < i; ++j)
      x[i] -= a[i * n + j] * x[j];
  }
  for (int i = n - 1; i >= 0; --i) {
    for (int j = i + 1; j < n; ++j)
      x[i] -= a[i * n + j] * x[j];
    x[i] /= a[i * n + i];
  }
}"""

_TIME = """\
/* Value of a time relation just after t: g is left minus right at t, slope its derivative. */
static int mdl_time_relation(double g, double slope, double t) {
  const double tolerance = 4e-15 * fabs(t) * fabs(slope);
  return slope > 0.0 ? g >= -tolerance : g > tolerance;
}"""

_NEXT = """\
/* The earlier of `next` and the instant after t at which a time relation switches. */
static double mdl_next_switch(double g, double slope, double t, double next) {
  const double instant = t - g / slope;
  return instant > t + 4e-15 * fabs(t) && instant < next ? instant : next;
}"""

_HELPERS = {
    "mdl_word": WORDS,
    **NATIVE,
    **HELPERS,
    "mdl_fail": _FAIL,
    "mdl_index": _INDEX,
    "mdl_enter": _ENTER,
    "mdl_solve": _SOLVE,
    "mdl_factor": _FACTOR,
    "mdl_substitute": _SUBSTITUTE,
    "mdl_newton": NEWTON,
    "mdl_time_relation": _TIME,
    "mdl_next_switch": _NEXT,
}


def helpers(code: str) -> str:
    """The helpers that `code` calls."""
    code += "".join(text for name, text in (("mdl_index", _INDEX), ("mdl_enter", _ENTER)) if name in code)
    code += "".join(text for name, text in NATIVE.items() if name in code)
    return "\n\n".join(text for name, text in _HELPERS.items() if re.search(rf"\b{name}\b", code))
