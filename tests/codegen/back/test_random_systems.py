"""Random linear systems through the structural passes (explicit and residual form), against one dense solution."""

from __future__ import annotations

from functools import reduce

from hypothesis import assume, given, settings
from hypothesis import strategies as st
import numpy as np

from lacuna.codegen import flat
from lacuna.codegen.compile import Report, prepare
from lacuna.codegen.dae.prepared import Prepared
from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.structure.causal import Assignment, Division
from lacuna.codegen.structure.system import DeclaredValues
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.evaluate import evaluate

SPAN = Span("random.mo", 1, 1)
COEFFICIENTS = st.sampled_from([-3.0, -1.0, 1.0, 2.0, 5.0])
SWITCHES = st.sampled_from(["plain", "if", "product"])


@st.composite
def systems(draw: st.DrawFn) -> tuple[flat.FlatModel, np.ndarray, np.ndarray, int]:
    """(model, M, N, states) with M [x'; z] = N x + 1: sparse, every equation with one unknown of its own at least."""
    n_x, n_z = draw(st.integers(1, 3)), draw(st.integers(0, 5))
    n = n_x + n_z
    own = draw(st.permutations(range(n)))
    m, right = np.zeros((n, n)), np.zeros((n, n_x))
    names = [*(f"x{k}" for k in range(n_x)), *(f"z{k}" for k in range(n_z))]
    states = [ex.var(name) for name in names[:n_x]]
    unknowns = [*map(ex.der, states), *(ex.var(name) for name in names[n_x:])]
    equations = []
    for row in range(n):
        columns = {own[row], *draw(st.sets(st.integers(0, n - 1), max_size=3))}
        terms = []
        for column in sorted(columns):
            m[row, column] = draw(COEFFICIENTS)
            terms.append(_term(m[row, column], unknowns[column], draw(SWITCHES)))
        for k in draw(st.sets(st.integers(0, n_x - 1), max_size=2)):
            right[row, k] = draw(COEFFICIENTS)
        forcing = reduce(ex.add, [ex.mul(ex.const(right[row, k]), states[k]) for k in range(n_x)], ex.ONE)
        equations.append(flat.Equation(reduce(ex.add, terms), forcing, SPAN, text=f"equation {row}"))
    model = flat.FlatModel("Random", SPAN, equations=equations)
    for name in names:
        model.variables[name] = flat.Variable(name, SPAN, start=ex.ONE, fixed=ex.TRUE if name[0] == "x" else None)
    one, on = flat.Variable("one", SPAN, variability="parameter", binding=ex.ONE), ex.TRUE
    switch = flat.Variable("on", SPAN, "Boolean", variability="parameter", binding=on)
    model.variables |= {"one": one, "on": switch}
    return model, m, right, n_x


def _term(coefficient: float, unknown: ex.Expr, how: str) -> ex.Expr:
    """coefficient * unknown, written so that it is plain, behind a switch, or with a parameter in it."""
    c = ex.const(coefficient)
    if how == "if":
        return ex.if_else(ex.var("on", ex.BOOLEAN), ex.mul(c, unknown), ex.neg(unknown))
    return ex.mul(ex.mul(c, ex.var("one")), unknown) if how == "product" else ex.mul(c, unknown)


def solve_steps(p: Prepared, values: dict[ex.Expr, float]) -> dict[ex.Expr, float]:
    """Carry out the explicit form numerically."""

    declared = DeclaredValues(p.model)

    def value(e: ex.Expr) -> float:
        found = evaluate(e, lambda n: values[n] if n in values else declared.variable(str(n.value)))
        assert found is not None, e
        return float(found)

    for step in p.explicit:
        if isinstance(step, Division):
            values[step.unknown] = value(step.numerator) / value(step.denominator)
            continue
        if not isinstance(step, Assignment):
            matrix = np.array([[value(a) for a in line] for line in step.matrix])
            values.update(zip(step.tears, np.linalg.solve(matrix, [value(b) for b in step.right]), strict=True))
        for a in [step] if isinstance(step, Assignment) else step.assignments:
            values[a.unknown] = value(a.value)
    return values


@settings(max_examples=150, deadline=None)
@given(systems())
def test_explicit_form_is_the_solution(system: tuple[flat.FlatModel, np.ndarray, np.ndarray, int]) -> None:
    model, m, right, n_x = system
    assume(np.linalg.cond(m) < 1e6)
    try:
        p = prepare(model, Report())
    except Diagnostic as finding:
        assert finding.code in ("S002", "S020", "S022")  # aliases among states: not what is tested here
        return
    assume(p.system.states == [f"x{k}" for k in range(n_x)])
    x = np.linspace(0.5, 2.0, n_x)
    expected = np.linalg.solve(m, right @ x + 1)
    try:
        values = solve_steps(p, {ex.var(f"x{k}"): x[k] for k in range(n_x)})
    except np.linalg.LinAlgError:
        assume(False)
    found = [values[ex.der(ex.var(f"x{k}"))] for k in range(n_x)]
    np.testing.assert_allclose(found, expected[:n_x], rtol=1e-8, atol=1e-8)
    for k, exact in enumerate(expected[n_x:]):
        z = ex.var(f"z{k}")
        assert z not in values or abs(values[z] - exact) <= 1e-8 * (1 + abs(exact))


@settings(max_examples=100, deadline=None)
@given(systems())
def test_residual_form_is_square_and_vanishes_at_the_solution(
    system: tuple[flat.FlatModel, np.ndarray, np.ndarray, int],
) -> None:
    model, m, right, n_x = system
    assume(np.linalg.cond(m) < 1e6)
    try:
        p = prepare(model, Report())
    except Diagnostic:
        assume(False)
    assume(p.system.states == [f"x{k}" for k in range(n_x)])
    assert len(p.residual.residuals) == n_x + len(p.residual.tears)
    x = np.linspace(0.5, 2.0, n_x)
    exact = np.linalg.solve(m, right @ x + 1)
    values = {ex.var(f"x{k}"): x[k] for k in range(n_x)}
    values |= {ex.der(ex.var(f"x{k}")): exact[k] for k in range(n_x)}
    values |= {ex.var(f"z{k}"): v for k, v in enumerate(exact[n_x:])}

    declared = DeclaredValues(p.model)

    def value(e: ex.Expr) -> float:
        return float(evaluate(e, lambda n: values[n] if n in values else declared.variable(str(n.value))))

    for a in p.residual.assignments:
        assert abs(value(a.value) - values[a.unknown]) <= 1e-7 * (1 + abs(values[a.unknown]))
    for row in p.residual.residuals:
        assert abs(value(row.residual)) <= 1e-7 * (1 + np.max(np.abs(exact)))
