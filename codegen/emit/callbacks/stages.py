"""The stages of an explicit scheme in one call, of models whose explicit form costs hardly more than calling it.

The compiler sees the loop over the stages with the explicit form inside of it: what parameters and discrete variables
decide it computes once a step, and the sums over stages are written out for the number of states.
"""

from __future__ import annotations

from lacuna.codegen.dae.prepared import Prepared
from lacuna.codegen.emit.callbacks.continuous import RHS
from lacuna.codegen.structure.causal import NonlinearBlock, unknowns_of

# Unknowns of the explicit form, about five instructions each: with more of them the call is no longer much beside it.
SHORT = 100
MOST_STATES = 16  # as many sums are kept in registers and beside them

_INLINE = RHS.replace("static int mdl_rhs", "static inline __attribute__((always_inline)) int mdl_explicit")

_STAGES = """\
static int mdl_stages(mdl_data *m, const mdl_scheme *scheme, double t, double h, const double *x, double *restrict k,
                      double *restrict end, double *restrict v) {
  enum { N = %d };
  const int last = scheme->stages - 1;
  for (int j = 1; j <= last; ++j) {
    const double *a = scheme->weights + j * last;
    double at[N];
    for (int i = 0; i < N; ++i)
      at[i] = x[i];
    for (int l = 0; l < j; ++l) {
      const double weight = h * a[l];
      for (int i = 0; i < N; ++i)
        at[i] += weight * k[l * N + i];
    }
    for (int i = 0; i < N; ++i)
      end[i] = at[i];
    m->undetermined = m->unsettled = 0;
    m->brief = j < last;
    const int status = mdl_explicit(m, t + scheme->nodes[j] * h, at, k + j * N, v);
    m->brief = 0;
    if (status) return status;
  }
  return 0;
}"""


def has_stages(p: Prepared) -> bool:
    """Inputs are the runtime's to bring to the time of a stage; nonlinear blocks cost far more than a call."""
    unknowns = sum(len(unknowns_of(step)) for step in p.explicit)
    iterates = any(isinstance(step, NonlinearBlock) for step in p.explicit)
    return 0 < len(p.storage.states) <= MOST_STATES and unknowns <= SHORT and not (iterates or p.storage.inputs)


def with_stages(p: Prepared, rhs: str) -> list[str]:
    """`rhs`, the C of the explicit form, as two callbacks around one body."""
    call = f"{RHS} {{\n  return mdl_explicit(m, t, x, xdot, v);\n}}"
    return [rhs.replace(RHS, _INLINE, 1), call, _STAGES % len(p.storage.states)]
