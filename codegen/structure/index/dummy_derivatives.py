"""Static choice of states: for every equation that was differentiated one derivative becomes algebraic.

S. Mattsson, G. Soderlind, Index reduction in DAEs using dummy derivatives, SIAM J. Sci. Comput. 14 (1993) 677-692.
The pivots are evaluated at the start values, so the choice holds as long as they stay away from zero: where a pivot
varies an assert watches it, and the structure report names the choice. Among good pivots stateSelect decides, then the
order of derivative.
"""

from __future__ import annotations

from dataclasses import replace
from functools import reduce
import heapq

from lacuna.codegen import flat
from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.structure.aliases import STATE_SELECT
from lacuna.codegen.structure.constants import is_parametric
from lacuna.codegen.structure.system import DeclaredValues, DefinedValues, GenericValues, Row, System
from lacuna.codegen.symbolic.differentiate import partial
from lacuna.codegen.symbolic.expr import Expr, add, const, der, mul, relation, var
from lacuna.codegen.symbolic.rewrite import Rewriter, all_statements

PIVOT = 1e-6  # smallest pivot accepted, relative to the largest entry of its equation
ROUNDING = 1e-10  # of the largest number that entered a sum: at generic values what is smaller is a zero
WATCHED = 0.1  # smallest pivot tolerated during a run, relative to those of the states that it stands beside


def choose_states(model: flat.FlatModel, rows: list[Row], names: list[str]) -> System:
    """Select dummy derivatives among `rows` and return the system in the remaining states."""
    variables = _variables(rows, names)
    dummies, watches = _first_choice(model, rows, variables)
    model = replace(model, asserts=[*model.asserts, *watches])
    replacement, model, extra = _rename(model, variables, dummies)
    rewriter = Rewriter(replacement.get)
    new_rows: dict[Row, Row] = {}
    for row in rows:
        integral = new_rows[row.integral] if row.integral else None
        new_rows[row] = Row(rewriter.expression(row.lhs), rewriter.expression(row.rhs), row.source, integral)
    states = [str(s.value) for v in variables if der(v) in variables and der(v) not in dummies
              for s in [replacement.get(v, v)]]  # fmt: skip
    all_names = [*names, *(str(n.value) for n in replacement.values() if n.op == "var")]
    state_set = set(states)
    return System(
        rewriter.model(model),
        [*new_rows.values(), *extra],
        states,
        [n for n in all_names if n not in state_set],
        [text_of(d) for d in variables if d in dummies],
        rewriter,
    )


def _first_choice(
    model: flat.FlatModel, rows: list[Row], variables: dict[Expr, int]
) -> tuple[set[Expr], list[flat.Assert]]:
    """Dummies and watches at the start values as far as they tell; else at those of their neighbourhood."""
    for values in (DeclaredValues(model), DefinedValues(model, rows)):
        try:
            return _choose_dummies(model, rows, variables, values)
        except Diagnostic:
            continue
    return _choose_dummies(model, rows, variables, GenericValues(model, rows))


def text_of(n: Expr) -> str:
    return f"der({text_of(n.args[0])})" if n.op == "der" else str(n.value)


def _variables(rows: list[Row], names: list[str]) -> dict[Expr, int]:
    """Every unknown and derivative of one that occurs, with its order of differentiation; in declaration order."""
    highest: dict[str, int] = {}
    for row in rows:
        for n in row.leaves:
            if n.op == "der":
                base, order = n, 0
                while base.op == "der":
                    base, order = base.args[0], order + 1
                highest[str(base.value)] = max(order, highest.get(str(base.value), 0))
    found: dict[Expr, int] = {}
    for name in names:
        n = var(name)
        found[n] = 0
        for order in range(1, highest.get(name, 0) + 1):
            n = der(n)
            found[n] = order
    return found


def _choose_dummies(
    model: flat.FlatModel, rows: list[Row], variables: dict[Expr, int], values: DeclaredValues
) -> tuple[set[Expr], list[flat.Assert]]:
    differentiated = {row.integral for row in rows if row.integral}
    constraints = [row for row in rows if row.integral and row not in differentiated]
    candidates = [v for v in variables if variables[v] and der(v) not in variables]
    dummies: set[Expr] = set()
    watches: list[flat.Assert] = []
    reset = _reinitialised(model)
    while constraints:
        pivots = _pivots(model, constraints, candidates, variables, values, reset)
        chosen = set(pivots.values())
        dummies.update(chosen)
        watches += _watches(pivots, [v for v in candidates if v not in chosen], model)
        candidates = [v.args[0] for v in variables if v in chosen and variables[v] > 1]
        constraints = [row.integral for row in constraints if row.integral.integral]
    return dummies, watches


def _watches(pivots: dict[Row, Expr], states: list[Expr], model: flat.FlatModel) -> list[flat.Assert]:
    """Asserts that the pivots which vary stay large enough beside those of the derivatives of states."""
    found = []
    position = {v: k for k, v in enumerate(states)}
    for row, dummy in pivots.items():
        pivot = partial(row.residual, dummy)
        beside = sorted((v for v in row.leaves if v in position), key=position.__getitem__)
        if is_parametric(pivot, model.variables) or not beside:
            continue
        squares = [mul(slope, slope) for slope in (partial(row.residual, v) for v in beside)]
        condition = relation(">=", mul(pivot, pivot), mul(const(WATCHED**2), reduce(add, squares)))
        names = ", ".join(text_of(v.args[0]) for v in beside)
        message = f"{names} cannot be the state here: write stateSelect=StateSelect.prefer for {text_of(dummy.args[0])}"
        found.append(flat.Assert(condition, f"{message} ({row.source.text})", row.source.span))
    return found


def _reinitialised(model: flat.FlatModel) -> set[str]:
    """Targets of reinit: they must be states."""
    return {s.target for s in all_statements([*model.whens, *(s for a in model.algorithms for s in a.statements)])
            if isinstance(s, flat.Reinit)}  # fmt: skip


def _pivots(
    model: flat.FlatModel,
    rows: list[Row],
    candidates: list[Expr],
    variables: dict[Expr, int],
    values: DeclaredValues,
    reset: set[str],
) -> dict[Row, Expr]:
    """For each row one of the candidates, with a regular Jacobian at the start values (Gaussian elimination)."""
    column = {v: k for k, v in enumerate(candidates)}
    matrix = [_scaled({column[n]: _entry(row, n, values) for n in row.leaves if n in column}) for row in rows]
    summed = [{c: abs(a) for c, a in line.items()} for line in matrix]  # the largest number that entered each entry
    generic = isinstance(values, GenericValues)
    users: list[set[int]] = [set() for _ in candidates]
    for r, line in enumerate(matrix):
        for c in line:
            users[c].add(r)
    keys = [_keep(model, v, variables[v], reset) for v in candidates]

    def entry(r: int, c: int) -> tuple:
        """Sorts first: the weakest candidate, of those the largest pivot, of those the last declared."""
        return keys[c], -abs(matrix[r][c]), -c, r

    def is_pivot(r: int, c: int) -> bool:
        return abs(matrix[r][c]) > (ROUNDING * summed[r][c] if generic else PIVOT)

    queue = [entry(r, c) for r, line in enumerate(matrix) for c in line if is_pivot(r, c)]
    heapq.heapify(queue)
    chosen: dict[Row, Expr] = {}
    while queue:
        found = heapq.heappop(queue)
        c, r = -found[2], found[3]
        if rows[r] in chosen or c not in matrix[r] or entry(r, c) != found:
            continue  # eliminated, or another number by now
        chosen[rows[r]] = candidates[c]
        pivot = matrix[r].pop(c)
        for other in sorted(o for o in users[c] if rows[o] not in chosen):
            factor = matrix[other].pop(c) / pivot
            for k, a in matrix[r].items():
                matrix[other][k] = matrix[other].get(k, 0.0) - factor * a
                summed[other][k] = max(summed[other].get(k, 0.0), abs(factor * a))
                users[k].add(other)
                if is_pivot(other, k):
                    heapq.heappush(queue, entry(other, k))
    if len(chosen) < len(rows):
        _refuse(rows, candidates)
    return chosen


def _scaled(line: dict[int, float]) -> dict[int, float]:
    scale = max(map(abs, line.values()), default=0.0) or 1.0
    return {c: a / scale for c, a in line.items()}


def _entry(row: Row, v: Expr, values: DeclaredValues) -> float:
    value = values(partial(row.residual, v))
    return 1.0 if value is None else float(value)


def _keep(model: flat.FlatModel, derivative: Expr, order: int, reset: set[str]) -> tuple:
    """Derivatives with the smallest key become dummies first."""
    base = derivative
    while base.op == "der":
        base = base.args[0]
    v = model.variables[str(base.value)]
    fixed = v.fixed is not None and v.fixed.op == "const" and bool(v.fixed.value)
    return v.name in reset, STATE_SELECT.index(v.state_select), -order, fixed


def _refuse(rows: list[Row], candidates: list[Expr]) -> None:
    raise Diagnostic(
        "S005", "these constraints between states do not determine any of them at the start values",
        rows[0].source.span, "give start values at which the constraint is regular: "
        + ", ".join(text_of(c.args[0]) for c in candidates),
        [(row.source.span, row.text) for row in rows],
    )  # fmt: skip


def _rename(
    model: flat.FlatModel, variables: dict[Expr, int], dummies: set[Expr]
) -> tuple[dict[Expr, Expr], flat.FlatModel, list[Row]]:
    """Derivatives that are dummies or states themselves become variables named "der(x)"."""
    replacement: dict[Expr, Expr] = {}
    extra: list[Row] = []
    declared = dict(model.variables)
    for n, order in variables.items():
        if not order:
            continue
        inner = replacement.get(n.args[0], n.args[0])
        is_state = der(n) in variables and der(n) not in dummies
        if n not in dummies and not is_state:
            if inner is not n.args[0]:
                replacement[n] = der(inner)
            continue
        name = text_of(n)
        replacement[n] = var(name)
        base = model.variables[str(_base(n).value)]
        unit = f"{base.unit}/s{order if order > 1 else ''}" if base.unit else ""
        declared[name] = flat.Variable(name, base.span, unit=unit, description=f"derivative of {base.name}")
        if n not in dummies:
            source = flat.Equation(der(inner), var(name), base.span, "", f"{text_of(der(inner))} = {name}")
            extra.append(Row(der(inner), var(name), source))
    return replacement, replace(model, variables=declared), extra


def _base(n: Expr) -> Expr:
    while n.op == "der":
        n = n.args[0]
    return n
