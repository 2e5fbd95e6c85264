"""Initial equations of discrete variables.

n = e with e of parameters is a start value. Any other e is computed at the start: `if initial() then n := e` stands
before what sets n at events, and the start is iterated until nothing changes any more (Modelica 3.6, 8.6). Where an
equation defines n at all times, pre(n) = e says what is read for pre(n) while initial() is true.
"""

from __future__ import annotations

from dataclasses import replace

from lacuna.codegen import flat
from lacuna.codegen.dae.discrete.events import sorted_body
from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.structure.constants import is_parametric
from lacuna.codegen.symbolic.expr import TRUE, Expr, if_else, special, transform
from lacuna.codegen.symbolic.leaves import leaves
from lacuna.codegen.symbolic.rewrite import Rewriter, assigned
from lacuna.codegen.symbolic.union_find import UnionFind

Assigns = dict[str, flat.Assign]


def discrete_starts(model: flat.FlatModel) -> flat.FlatModel:
    """The model without initial equations of discrete variables."""
    model = _with_equal_starts(model)
    variables, equations, computed = dict(model.variables), [], {}
    at_events = {n for w in model.whens for n in assigned([w])}.union(*(a.targets for a in model.algorithms))
    by_equation = _defined_by_equations(model, at_events)
    told: dict[Expr, Expr] = {}  # pre(n) of those that have got their start here
    at_start: dict[Expr, Expr] = {}  # what is read for pre(n)
    for eq in sorted(model.initial_equations, key=_reads_pre):
        name = _defined(eq, variables, at_events, computed.keys())
        if name is None:
            equations.append(eq)
            continue
        own, value = (eq.lhs, eq.rhs) if _discrete_name(eq.lhs) == name else (eq.rhs, eq.lhs)
        value = transform(value, told.get, {})
        if is_parametric(value, variables):
            if own.op == "pre":
                told[own] = value
            variables[name] = replace(variables[name], start=value)
        elif name in by_equation and own.op == "pre" and own not in leaves(value):
            at_start[own] = if_else(special("initial"), value, own)
        elif name in by_equation:
            raise Diagnostic(
                "S024", f"the initial value of the discrete variable {name} does not follow from parameters",
                eq.span, f"give {name} a start value, or set it in `when initial() then`",
            )  # fmt: skip
        else:
            computed[name] = flat.Assign(name, value, eq.span)
    model = replace(model, variables=variables, initial_equations=equations)
    model = _read_at_start(model, at_start) if at_start else model
    return _with_assignments(model, computed) if computed else model


def _read_at_start(model: flat.FlatModel, values: dict[Expr, Expr]) -> flat.FlatModel:
    rewriter = Rewriter(values.get)
    return replace(
        model,
        equations=[rewriter.equation(e) for e in model.equations],
        whens=[rewriter.statement(w) for w in model.whens],
        algorithms=[replace(a, statements=rewriter.statements(a.statements)) for a in model.algorithms],
    )


def _reads_pre(eq: flat.Equation) -> bool:
    """Whether an equation says what a variable was by what others were: it comes after those that say that."""
    return any(n.op == "pre" for side in (eq.lhs, eq.rhs) if side.op != "pre" for n in leaves(side))


def _with_equal_starts(model: flat.FlatModel) -> flat.FlatModel:
    """Start values that follow from equalities alone.

    m = pre(n) at all times and m = true at the start give n the start value true; so does pre(n) = pre(k) where k
    follows from others. Sets of m, pre(n) that equal each other take the value that an initial equation gives one of
    them, where that one is defined at all times and could not be given a value otherwise.
    """
    variables, equal = dict(model.variables), UnionFind()
    at_events = {n for w in model.whens for n in assigned([w])}.union(*(a.targets for a in model.algorithms))
    lasting = _defined_by_equations(model, at_events)
    for eq in (*model.equations, *model.initial_equations):
        if _is_discrete(eq.lhs, variables) and _is_discrete(eq.rhs, variables):
            equal.join(eq.lhs, eq.rhs)
    given = {}
    for eq in model.initial_equations:
        for side, value in ((eq.lhs, eq.rhs), (eq.rhs, eq.lhs)):
            if side.op == "var" and side.value in lasting and is_parametric(value, variables):
                given.setdefault(equal.find(side), value)
    held = {equal.find(n) for n in equal.parent if n.op == "pre"}
    given = {root: value for root, value in given.items() if root in held}
    for n in equal.parent if given else ():
        value = given.get(equal.find(n))
        if n.op == "pre" and value is not None:
            variables[str(n.args[0].value)] = replace(variables[str(n.args[0].value)], start=value)

    def explained(eq: flat.Equation) -> bool:
        left, right = (given.get(equal.find(s)) if s in equal.parent else s for s in (eq.lhs, eq.rhs))
        return left is not None and left is right

    left = [eq for eq in model.initial_equations if not given or not explained(eq)]
    return replace(model, variables=variables, initial_equations=left)


def _is_discrete(e: Expr, variables: dict[str, flat.Variable]) -> bool:
    v = variables.get(_discrete_name(e))
    return v is not None and v.variability == flat.DISCRETE and v.causality != "input"


def _defined(
    eq: flat.Equation, variables: dict[str, flat.Variable], at_events: set[str], computed: object
) -> str | None:
    """The discrete variable that an initial equation gives a value: pre(n) first, then one that no event sets."""
    candidates = []
    if _discrete_name(eq.lhs) == _discrete_name(eq.rhs) in at_events:
        message = f"the steady state of the discrete variable {_discrete_name(eq.lhs)} is not solved for"
        raise Diagnostic("S024", message, eq.span, "give its value before the start: pre(n) = ...")
    for side in (eq.lhs, eq.rhs):
        v = variables.get(_discrete_name(side))
        if v is None or v.variability != flat.DISCRETE or v.name in computed or v.causality == "input":
            continue
        held = side.op != "pre" and v.fixed is TRUE
        if not held:
            candidates.append((side.op != "pre", v.name in at_events, v.name))
    return min(candidates, key=lambda c: c[:2])[2] if candidates else None


def _discrete_name(e: Expr) -> str:
    n = e.args[0] if e.op == "pre" else e
    return str(n.value) if n.op == "var" else ""


def _defined_by_equations(model: flat.FlatModel, at_events: set[str]) -> set[str]:
    """Discrete variables that an equation defines at all times."""
    found = set()
    for eq in model.equations:
        name = _discrete_name(eq.lhs) if eq.lhs.op == "var" else ""
        v = model.variables.get(name)
        if v is not None and v.variability == flat.DISCRETE and name not in at_events:
            found.add(name)
    return found


def _with_assignments(model: flat.FlatModel, computed: Assigns) -> flat.FlatModel:
    left = dict(computed)
    whens, algorithms = [], []
    for w in model.whens:
        names = tuple(assigned([w]))
        mine = [left.pop(n) for n in names if n in left]
        if mine:
            algorithms.append(flat.Algorithm([_initially(mine), w], names, w.span, w.origin))
        else:
            whens.append(w)
    for a in model.algorithms:
        mine = [left.pop(n) for n in a.targets if n in left]
        algorithms.append(replace(a, statements=[_initially(mine), *a.statements]) if mine else a)
    algorithms += [flat.Algorithm([_initially([s])], (n,), s.span) for n, s in left.items()]
    return replace(model, whens=whens, algorithms=algorithms)


def _initially(statements: list[flat.Assign]) -> flat.If:
    return flat.If([(special("initial"), sorted_body(list(statements)))], statements[0].span)
