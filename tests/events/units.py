"""A model counted in other units: variables, parameters, literals of its flat form times the factors of their units.

`rescaled` writes x = coefficient * x' for all quantities and collects the coefficients of products, sums and
conditions, so that equations look as somebody would write them in those units, not as conversions.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
import hashlib
import math

from lacuna import runtime
from lacuna.codegen import flat
from lacuna.codegen.cache import Cache
from lacuna.codegen.compile import Report, prepare
from lacuna.codegen.emit.source import generate
from lacuna.codegen.flatten import flatten
from lacuna.codegen.library.classes import Library
from lacuna.codegen.symbolic.expr import REAL, RELATIONS, Expr, const, div, is_const, mul, own_table, rebuild, relation
from lacuna.units import parse_unit

_LEAVES = ("var", "der", "pre")
_ALIKE = ("+", "-", "min", "max")
_BASE = ("m", "kg", "s", "A", "K", "mol", "cd")
Scaled = tuple[float, Expr]  # (c, e'): the value in SI units is c times e' of the numbers in the others


@dataclass
class Units:
    """`per` is how many of the other unit are in one of a base unit: {"m": 1e3} counts in millimetres."""

    per: Mapping[str, float]

    def of(self, v: flat.Variable) -> float:
        """Numbers in the other units for one in the declared unit, or that which the equations say."""
        if v.type != REAL or not (v.unit or v.inferred_unit):
            return 1.0
        exponents = parse_unit(v.unit or v.inferred_unit).exponents
        return math.prod(self.per.get(base, 1.0) ** float(e) for base, e in zip(_BASE, exponents, strict=True))


class _Rescaling:
    def __init__(self, model: flat.FlatModel, units: Units):
        self.factor = {n: units.of(v) for n, v in model.variables.items()}
        self._memo: dict[Expr, Scaled] = {}

    def scaled(self, e: Expr) -> Scaled:
        if e not in self._memo:
            self._memo[e] = self._scaled(e)
        return self._memo[e]

    def _scaled(self, e: Expr) -> Scaled:
        if e.op in _LEAVES:
            leaf = e
            while leaf.op != "var":
                leaf = leaf.args[0]
            return 1.0 / self.factor.get(str(leaf.value), 1.0), e
        if not e.args or e.op in ("edge", "change"):
            return 1.0, e
        parts = [self.scaled(a) for a in e.args]
        if e.op in _ALIKE:
            coefficient, parts = _alike(parts)
            return coefficient, rebuild(e, parts)
        if e.op in RELATIONS:
            return 1.0, relation(e.op, *_alike(parts)[1])
        if e.op in ("if", "noEvent", "smooth"):
            values = 2 if e.op == "if" else 1
            coefficient, last = _alike(parts[-values:])
            return coefficient, rebuild(e, (*(_plain(p) for p in parts[:-values]), *last))
        return _product(e, parts)

    def value(self, e: Expr | None, name: str) -> Expr | None:
        """What is assigned to variable `name`, in its unit."""
        if e is None:
            return None
        coefficient, inner = self.scaled(e)
        return inner if e.type != REAL else _times(coefficient * self.factor.get(name, 1.0), inner)


def _product(e: Expr, parts: list[Scaled]) -> Scaled:
    (c, a), *rest = parts
    if e.op in ("*", "/"):
        d, b = rest[0]
        return (c * d, mul(a, b)) if e.op == "*" else (c / d, div(a, b))
    if e.op == "neg" or (e.op == "call" and e.value == "abs"):
        return c, rebuild(e, (a,))
    if e.op == "call" and e.value == "sqrt":
        return math.sqrt(c), rebuild(e, (a,))
    if e.op == "^" and is_const(e.args[1]):
        return c ** float(e.args[1].value), rebuild(e, (a, e.args[1]))
    return 1.0, rebuild(e, tuple(_plain(p) for p in parts))


def _alike(parts: list[Scaled]) -> tuple[float, tuple[Expr, ...]]:
    """Numbers of one kind, in one unit: that of the first which is no literal."""
    unit = next((c for c, e in parts if not is_const(e)), 1.0)
    return unit, tuple(_times(c / unit, e) for c, e in parts)


def _times(factor: float, e: Expr) -> Expr:
    if e.type != REAL and factor == 1.0:
        return e
    return e if math.isclose(factor, 1.0, rel_tol=1e-12) else mul(const(factor), e)


def _plain(part: Scaled) -> Expr:
    return _times(*part)


def _statement(s: flat.Statement, r: _Rescaling) -> flat.Statement:
    match s:
        case flat.Assign() | flat.Reinit():
            return replace(s, value=r.value(s.value, s.target))
        case flat.Assert():
            return replace(s, condition=r.scaled(s.condition)[1])
        case flat.If() | flat.When():
            branches = [(r.scaled(c)[1], [_statement(b, r) for b in body]) for c, body in s.branches]
            return replace(s, branches=branches)
        case flat.Terminate():
            return s
    raise NotImplementedError(type(s).__name__)


def _equation(e: flat.Equation, r: _Rescaling) -> flat.Equation:
    _, (lhs, rhs) = _alike([r.scaled(e.lhs), r.scaled(e.rhs)])
    return replace(e, lhs=lhs, rhs=rhs)


def _variable(v: flat.Variable, r: _Rescaling) -> flat.Variable:
    attributes = ("binding", "start", "min", "max", "nominal")
    return replace(v, **{a: r.value(getattr(v, a), v.name) for a in attributes})


def rescaled(name: str, per: Mapping[str, float], search_path: list[str], cache: str) -> tuple[runtime.Model, dict]:
    """The model counted in other units, and by how much the number of each of its variables is larger there."""
    with own_table():
        model = flatten(Library(search_path), name, {}, "off")
        r = _Rescaling(model, Units(per))
        model = replace(
            model,
            variables={n: _variable(v, r) for n, v in model.variables.items()},
            equations=[_equation(e, r) for e in model.equations],
            initial_equations=[_equation(e, r) for e in model.initial_equations],
            whens=[_statement(w, r) for w in model.whens],
            algorithms=[replace(a, statements=[_statement(s, r) for s in a.statements]) for a in model.algorithms],
            asserts=[_statement(a, r) for a in model.asserts],
        )
        prepared = prepare(model, Report())
        prepared.hash = hashlib.sha256(repr((name, sorted(per.items()))).encode()).hexdigest()
        source = generate(prepared, False)
    digest = hashlib.sha256(source.encode()).hexdigest()
    return runtime.Model(Cache(cache).build(digest, source)), r.factor
