"""Random expression trees over three variables, for property tests."""

from __future__ import annotations

from hypothesis import strategies as st

from lacuna.codegen.symbolic import expr as ex

NAMES = ("a", "b", "c")
VARIABLES = [ex.var(n) for n in NAMES]
POINTS = st.tuples(*[st.floats(-3, 3).filter(lambda v: abs(v) > 1e-3)] * 3)

_NUMBERS = st.sampled_from([-2.5, -1.0, 0.5, 2.0, 3.0, 1e-3, 7.0]).map(ex.const)
_LEAVES = st.one_of(st.sampled_from(VARIABLES), _NUMBERS)


def _extend(inner: st.SearchStrategy) -> st.SearchStrategy:
    def conditions(a: ex.Expr, b: ex.Expr, c: ex.Expr, d: ex.Expr, how: int) -> ex.Expr:
        first, second = ex.relation("<", a, b), ex.relation(">=", c, d)
        return [ex.logical_and(first, second), ex.logical_or(first, ex.logical_not(second)),
                ex.logical_not(ex.logical_or(first, second))][how]  # fmt: skip

    boolean = st.builds(conditions, inner, inner, inner, inner, st.integers(0, 2))
    binary = st.sampled_from([ex.add, ex.sub, ex.mul, ex.div, ex.minimum, ex.maximum])
    return st.one_of(
        st.builds(lambda f, a, b: f(a, b), binary, inner, inner),
        st.builds(ex.neg, inner),
        st.builds(lambda f, a: ex.call(f, a), st.sampled_from(["sin", "cos", "atan", "tanh", "abs"]), inner),
        st.builds(lambda a, n: ex.power(a, ex.const(n)), inner, st.sampled_from([2, 3, -1, 2.0])),
        st.builds(ex.if_else, boolean, inner, inner),
    )


EXPRESSIONS = st.recursive(_LEAVES, _extend, max_leaves=12)
SMOOTH = st.recursive(
    _LEAVES,
    lambda inner: st.one_of(
        st.builds(lambda f, a, b: f(a, b), st.sampled_from([ex.add, ex.sub, ex.mul]), inner, inner),
        st.builds(lambda a, b: ex.div(a, ex.add(ex.const(2.0), ex.mul(b, b))), inner, inner),
        st.builds(lambda f, a: ex.call(f, a), st.sampled_from(["sin", "cos", "atan", "tanh", "exp"]), inner),
        st.builds(lambda a, n: ex.power(a, ex.const(n)), inner, st.sampled_from([2, 3])),
    ),
    max_leaves=6,
)
