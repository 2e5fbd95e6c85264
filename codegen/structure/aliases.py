"""Alias elimination: a = b and a = -b leave one variable of the pair; the other keeps its row in the table.

The survivor takes over start, fixed, nominal and the strongest stateSelect of those it stands for.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from lacuna.codegen import flat
from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.structure.constants import evaluate_constants, parametric_unknowns
from lacuna.codegen.symbolic.annotated import OP
from lacuna.codegen.symbolic.expr import ZERO, Expr, const, der, is_const, neg, pre, var
from lacuna.codegen.symbolic.leaves import leaves
from lacuna.codegen.symbolic.rewrite import Rewriter, assigned

STATE_SELECT = ("never", "avoid", "default", "prefer", "always")


@dataclass
class Aliases:
    """The model without aliases, and for each eliminated name (representative, sign)."""

    model: flat.FlatModel
    representative: dict[str, tuple[str, int]] = field(default_factory=dict)


def eliminate_aliases(model: flat.FlatModel) -> Aliases:
    """Eliminate aliases and parametric unknowns until none is left."""
    result = Aliases(evaluate_constants(model))
    while True:
        differentiated = _differentiated(result.model)
        model = parametric_unknowns(result.model, differentiated)
        pairs, equations = _alias_pairs(model, differentiated)
        if not pairs:
            result.model = _settled(model) if model.derivatives else model
            if result.model is model:
                return result
            continue
        model = _merge_attributes(replace(model, equations=equations), pairs)
        result.model = _renamer(model, pairs).model(model)
        for name, (target, sign) in result.representative.items():
            if target in pairs:
                further, other = pairs[target]
                result.representative[name] = (further, sign * other)
        result.representative.update(pairs)


def _settled(model: flat.FlatModel) -> flat.FlatModel:
    """Values of functions whose annotated derivatives leave out what an argument does (noDerivative) as mere values,
    where the argument can be differentiated: both say the same then, and the function's body shows more. What follows
    an input or a discrete variable has no derivative but the annotated one."""
    outside = _from_outside(model)

    def rule(n: Expr) -> Expr | None:
        rules = model.derivatives[str(n.value)] if n.op == OP else ()
        unheard = [r.unheard for r in rules]
        if not unheard or not all(unheard) or any(outside & leaves(n.args[k + 1]) for k in set().union(*unheard)):
            return None
        return rewriter.expression(n.args[0])

    rewriter = Rewriter(rule)
    equations = [rewriter.equation(eq) for eq in model.equations]
    same = all(new is old for new, old in zip(equations, model.equations, strict=True))
    return model if same else replace(model, equations=equations)


def _from_outside(model: flat.FlatModel) -> set[Expr]:
    """Inputs, discrete variables, and what equations v = e give values that follow from them."""
    given = [v for v in model.variables.values() if v.causality == "input" or v.variability == flat.DISCRETE]
    found = {var(v.name, v.type) for v in given}
    pairs = [pair for eq in model.equations for pair in ((eq.lhs, eq.rhs), (eq.rhs, eq.lhs)) if pair[0].op == "var"]
    before = -1
    while before < len(found):
        before = len(found)
        found |= {a for a, value in pairs if a not in found and found & leaves(value)}
    return found


def _differentiated(model: flat.FlatModel) -> set[str]:
    names: set[str] = set()
    for eq in (*model.equations, *model.initial_equations):
        names |= {_state_name(n) for side in (eq.lhs, eq.rhs) for n in leaves(side) if n.op == "der"}
    return names


def _state_name(derivative: Expr) -> str:
    while derivative.op == "der":
        derivative = derivative.args[0]
    return str(derivative.value)


def _signed(e: Expr) -> tuple[str, int] | None:
    if e.op == "var":
        return str(e.value), 1
    if e.op == "neg" and e.args[0].op == "var":
        return str(e.args[0].value), -1
    return None


def alias_pair(eq: flat.Equation) -> tuple[str, str, int] | None:
    """(a, b, sign) where the equation says a = sign * b."""
    left, right = _signed(eq.lhs), _signed(eq.rhs)
    if left and right:
        return left[0], right[0], left[1] * right[1]
    for side, zero in ((eq.lhs, eq.rhs), (eq.rhs, eq.lhs)):
        if is_const(zero, 0) and side.op in ("+", "-"):
            a, b = map(_signed, side.args)
            if a and b:
                return a[0], b[0], a[1] * b[1] * (-1 if side.op == "+" else 1)
    return None


def _speed(eq: flat.Equation) -> tuple[str, Expr, int] | None:
    """(v, der(x), sign) where the equation says v = sign * der(x)."""
    for side, other in ((eq.lhs, eq.rhs), (eq.rhs, eq.lhs)):
        v, sign = _signed(side), 1
        if other.op == "neg":
            other, sign = other.args[0], -1
        if v and other.op == "der":
            return v[0], other, v[1] * sign
    return None


class _Union:
    """Union-find over names with a sign on every link; `before`: values of pre(v), which each name has its own of."""

    def __init__(self, before: dict[str, Expr]) -> None:
        self.parent: dict[str, tuple[str, int]] = {}
        self._before = before

    def find(self, name: str) -> tuple[str, int]:
        sign = 1
        while name in self.parent:
            name, s = self.parent[name]
            sign *= s
        return name, sign

    def join(self, name: str, root: str, sign: int) -> bool:
        """Whether `name` can be sign * root before the start, too: then it is."""
        own = self._before.get(name)
        if own is not None and self._before.setdefault(root, own) is not own:
            return False
        self.parent[name] = (root, sign)
        return True


def _alias_pairs(
    model: flat.FlatModel, differentiated: set[str]
) -> tuple[dict[str, tuple[str, int]], list[flat.Equation]]:
    union, kept = _Union(_before_the_start(model)), []
    assigned_elsewhere = _assigned_at_events(model)

    def rank(name: str) -> tuple:
        """The variable with the greatest rank survives."""
        v = model.variables[name]
        return (
            v.causality == "input",
            name in assigned_elsewhere,
            v.variability == flat.DISCRETE,
            name in differentiated,
            is_const(v.fixed) and bool(v.fixed.value) if v.fixed is not None else False,
            STATE_SELECT.index(v.state_select),
            -name.count("."),
        )

    def removable(name: str, other: str) -> bool:
        v, o = model.variables[name], model.variables[other]
        if v.causality == "input" or name in assigned_elsewhere:
            return False
        continuous = v.variability == o.variability == flat.CONTINUOUS and o.causality != "input"
        return v.type == o.type and (continuous or ((v.variability == flat.DISCRETE) <= (o.variability == flat.DISCRETE)
                                     and name not in differentiated))  # fmt: skip

    def solvable(name: str) -> bool:
        """May `-name` stand in its place? What holds between events is only ever solved for a variable itself."""
        return model.variables[name].type == "Real" and model.variables[name].variability == flat.CONTINUOUS

    speeds: dict[Expr, tuple[str, int]] = {}
    for eq in model.equations:
        pair, speed = alias_pair(eq), _speed(eq)
        if speed:  # two variables that equal the same derivative equal each other
            first, sign = speeds.setdefault(speed[1], (speed[0], speed[2]))
            pair = (speed[0], first, speed[2] * sign) if first != speed[0] else None
        if pair is None or any(model.variables[n].variability in (flat.CONSTANT, flat.PARAMETER) for n in pair[:2]):
            kept.append(eq)
            continue
        (a, sign_a), (b, sign_b) = union.find(pair[0]), union.find(pair[1])
        keep, drop = (a, b) if rank(a) >= rank(b) else (b, a)
        if a == b and pair[2] * sign_a * sign_b > 0:
            kept.append(replace(eq, lhs=ZERO, rhs=ZERO, text=eq.text or f"{eq.lhs} = {eq.rhs}"))
            continue
        sign = pair[2] * sign_a * sign_b
        if a == b or not removable(drop, keep) or (sign < 0 and not solvable(drop)) or not union.join(drop, keep, sign):
            kept.append(eq)
    return {name: union.find(name) for name in union.parent}, kept


def _before_the_start(model: flat.FlatModel) -> dict[str, Expr]:
    """The values of pre(v) at the start that are fixed (8.6)."""
    discrete = {name: v for name, v in model.variables.items() if v.variability == flat.DISCRETE}
    return {name: _start(v, 1) for name, v in discrete.items() if _is_fixed(v)}


def _assigned_at_events(model: flat.FlatModel) -> set[str]:
    names = {n for w in model.whens for n in assigned([w])}
    return names.union(*(a.targets for a in model.algorithms))


def _renamer(model: flat.FlatModel, pairs: dict[str, tuple[str, int]]) -> Rewriter:
    def replacement(n: Expr) -> Expr | None:
        if n.op == "var" and n.value in pairs:
            name, sign = pairs[str(n.value)]
            target = var(name, n.type)
        elif n.op in ("der", "pre") and n.args[0].op == "var" and n.args[0].value in pairs:
            name, sign = pairs[str(n.args[0].value)]
            target = (der if n.op == "der" else pre)(var(name, n.args[0].type))
        else:
            return None
        return neg(target) if sign < 0 else target

    return Rewriter(replacement, lambda name: pairs.get(name, (name, 1)))


def _merge_attributes(model: flat.FlatModel, pairs: dict[str, tuple[str, int]]) -> flat.FlatModel:
    variables = dict(model.variables)
    for name, (target, sign) in sorted(pairs.items()):
        a, b = variables[name], variables[target]
        changed: dict[str, object] = {}
        if _is_fixed(a) and _is_fixed(b) and _start(a, sign) is not _start(b, 1):
            raise Diagnostic(
                "S002", f"{name} and {target} are equal but have different fixed start values", b.start_span,
                f"give one fixed=false, or both the same start: {b.start} against {'-' if sign < 0 else ''}{a.start}",
                [(a.start_span, f"{name} is {'-' if sign < 0 else ''}{target}")],
            )  # fmt: skip
        if not _is_fixed(b) and (_is_fixed(a) or (a.start is not None and b.start is None)):
            changed |= {"start": _start(a, sign), "fixed": a.fixed}
        if a.nominal is not None and b.nominal is None:
            changed["nominal"] = a.nominal
        changed["state_select"] = max(a.state_select, b.state_select, key=STATE_SELECT.index)
        variables[target] = replace(b, **changed)
    return replace(model, variables={name: v for name, v in variables.items() if name not in pairs})


def _is_fixed(v: flat.Variable) -> bool:
    return v.fixed is not None and v.fixed.op == "const" and bool(v.fixed.value)


def _start(v: flat.Variable, sign: int) -> Expr:
    start = v.start if v.start is not None else const(0.0)
    return neg(start) if sign < 0 else start
