"""Helper functions that a generated model carries along, each only where it is used."""

from __future__ import annotations

import re

from lacuna.codegen.emit.functions.endless import ROUNDS, STACK
from lacuna.codegen.emit.functions.linear import FACTOR, LEAST, SOLVES, SUBSTITUTE
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
static int mdl_enter(const mdl_data *m, long bytes, int end) {{
  mdl_data *own = (mdl_data *)m;
  if (own->stack == 0) own->rounds = 0;
  if (own->stack + bytes > {STACK}) return !mdl_fail(own, MDL_FAILURE_STACK, end, (double)own->stack);
  if (++own->rounds > {ROUNDS}) return !mdl_fail(own, MDL_FAILURE_LOOP, end, (double)own->rounds);
  own->stack += bytes;
  return 1;
}}"""

_TIME = """\
/* Value of a time relation just after t, while the initial equations are solved at t: g is left minus right at t, slope
 * its derivative. */
static int mdl_time_relation(const mdl_data *m, double g, double slope, double t) {
  const double tolerance = 4e-15 * fabs(t) * fabs(slope);
  return slope > 0.0 && !m->initial ? g >= -tolerance : g > tolerance;
}"""

_NEXT = """\
/* The earlier of `next` and the instant after t at which a time relation switches: half the tolerance of its value is
 * after t, so that no instant is between what has switched and what will. */
static double mdl_next_switch(double g, double slope, double t, double next) {
  const double instant = t - g / slope;
  return instant > t + 2e-15 * fabs(t) && instant < next ? instant : next;
}"""

_HELPERS = {
    "mdl_word": WORDS,
    **NATIVE,
    "mdl_fail": _FAIL,
    **HELPERS,
    "mdl_index": _INDEX,
    "mdl_enter": _ENTER,
    **SOLVES,
    "mdl_least": LEAST,
    "mdl_factor": FACTOR,
    "mdl_substitute": SUBSTITUTE,
    "mdl_newton": NEWTON,
    "mdl_time_relation": _TIME,
    "mdl_next_switch": _NEXT,
}


_NAME = re.compile(r"mdl_\w+")  # begins with its letters, which is how they are found quickly
_CALL = re.compile(r"(mdl_\w+)\(")


def helpers(code: str) -> str:
    """The helpers that `code` names, and those that they call; one look at the code, which may be long."""
    wanted = {m[0] for m in _NAME.finditer(code) if not (code[m.start() - 1].isalnum() or code[m.start() - 1] == "_")}
    waiting = [name for name in wanted if name in _HELPERS]
    while waiting:
        inside = set(_CALL.findall(_HELPERS[waiting.pop()])) & _HELPERS.keys() - wanted
        wanted |= inside
        waiting += inside
    return "\n\n".join(text for name, text in _HELPERS.items() if name in wanted)
