"""Equalities spread into scalar equations, their types and variabilities checked."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field

from lacuna.codegen import flat
from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten.classes.leaf import Leaf
from lacuna.codegen.flatten.expressions.constants import known, variability
from lacuna.codegen.flatten.expressions.enumerations import require_same
from lacuna.codegen.flatten.expressions.lower import lower, lower_results
from lacuna.codegen.flatten.names.context import Context
from lacuna.codegen.flatten.names.scope import Scope
from lacuna.codegen.flatten.names.values import (
    ChosenText,
    Record,
    Value,
    holds_records,
    items_of,
    scalars,
    shape_of,
    shape_text,
)
from lacuna.codegen.flatten.references.iterators import iterate
from lacuna.codegen.symbolic.expr import BOOLEAN, INTEGER, REAL, Expr, to_text, walk
from lacuna.codegen.symbolic.leaves import holds
from lacuna.codegen.syntax import ast


@dataclass
class Collected:
    """What sections contribute to the flat model."""

    equations: list[flat.Equation] = field(default_factory=list)
    whens: list[flat.When] = field(default_factory=list)
    algorithms: list[flat.Algorithm] = field(default_factory=list)
    asserts: list[flat.Assert] = field(default_factory=list)
    connections: list[tuple[ast.Connect, Scope]] = field(default_factory=list)
    branches: list[ast.Procedure] = field(default_factory=list)  # Connections.branch(...) and the like


def unroll(item: ast.For, scope: Scope) -> list[Scope]:
    """One scope for each pass of a loop, the first iterator being the outermost."""
    scopes = [scope]
    for iterator in item.iterators:
        scopes = [s.with_locals(**{iterator.name: v}) for s in scopes for v in iterate(iterator, s, item.body)]
    return scopes


def unroll_equations(item: ast.For, scope: Scope) -> list[Scope]:
    """As `unroll`, of a loop over equations, whose ranges are known at translation (8.3.2). Raises F021."""
    scopes = unroll(item, scope)
    for iterator in (i for i in item.iterators if isinstance(i.range, ast.Range)):
        for inner in scopes:
            known(inner.locals[iterator.name], inner, iterator.range.span, "the range of the loop")
    return scopes


def equalities(item: ast.Equality, scope: Scope) -> list[flat.Equation]:
    """left = right, scalar by scalar. Raises R024 for types and R042 for sizes that differ."""
    if isinstance(item.left, ast.Tuple):
        return _several(item, scope)
    left, right = lower(item.left, scope), lower(item.right, scope)
    return equate(left, right, item.span, scope, item.text)


def equate(left: Value, right: Value, span: Span, scope: Scope, text: str) -> list[flat.Equation]:
    """The scalar equations of left = right."""
    if shape_of(left) != shape_of(right) or holds_records(left) != holds_records(right):
        message = f"{shape_text(shape_of(left))} = {shape_text(shape_of(right))}"
        if holds_records(left) != holds_records(right):
            raise Diagnostic(
                "R042", "one side is a record, the other is none", span, "equate the elements of the record"
            )
        raise Diagnostic("R042", f"the sides differ in size: {message}", span, "both sides need the same size")
    result = []
    for a, b in pairs(left, right, span, scope):
        if isinstance(a, str | ChosenText) and a == b:
            continue  # what gives a String its value
        check_types(a, b, span, scope)
        result.append(flat.Equation(a, b, span, origin_of(scope), text))
    return result


def pairs(left: Value, right: Value, span: Span, scope: Scope) -> Iterator[tuple[Expr | str, Expr | str]]:
    """Corresponding scalars; the fields of records by their names, but for constants of their own: no constructor takes
    them, and nothing sets them (12.6)."""
    for a, b in zip(items_of(left), items_of(right), strict=True):
        if not isinstance(a, Record) and not isinstance(b, Record):
            yield a, b
            continue
        records = isinstance(a, Record) and isinstance(b, Record)
        if not records or any(not _is_constant(r.fields[n], scope) for r, n in _of_one_side(a, b)):
            raise Diagnostic("R042", "records of different kind", span, "both sides need the same fields")
        for name, part in ((n, v) for n, v in a.fields.items() if n in b.fields):
            if shape_of(part) != shape_of(b.fields[name]):
                raise Diagnostic("R042", f"the sides differ in size: {name}", span, "both sides need the same size")
            if not (_is_constant(part, scope) and _is_constant(b.fields[name], scope)):
                yield from pairs(part, b.fields[name], span, scope)


def _of_one_side(a: Record, b: Record) -> Iterator[tuple[Record, str]]:
    """Fields that only one of two records has."""
    return ((r, n) for r, other in ((a, b), (b, a)) for n in r.fields if n not in other.fields)


def _is_constant(value: Value, scope: Scope) -> bool:
    """Whether all of a field is constants; a literal may be given to a variable."""
    return all(
        isinstance(s, Expr) and s.op == "var" and variability(s, scope.context) == "constant" for s in scalars(value)
    )


def check_types(a: Expr | str, b: Expr | str, span: Span, scope: Scope) -> None:
    """Both sides Boolean, both Integer, or at least one Real with numbers only."""
    if not (isinstance(a, Expr) and isinstance(b, Expr)):
        kinds = sorted({"String" if isinstance(side, str) else side.type for side in (a, b)})
        if len(kinds) > 1:
            raise Diagnostic(
                "R024", f"the sides are {kinds[0]} and {kinds[1]}", span, "String(x) is the text of a number"
            )
        hint = "a String has one equation of its own, outside of conditions: s = ..."
        raise Diagnostic("R024", "an equation between Strings", span, hint)
    kinds = {a.type, b.type}
    if BOOLEAN in kinds and len(kinds) > 1:
        hint = "a Boolean as a number: if b then 1 else 0"
        raise Diagnostic("R024", f"the sides are {a.type} and {b.type}", span, hint)
    if a.op == "var" and a.type == INTEGER and b.type == REAL:
        hint = "integer(x) gives the whole number at or below x; or declare it Real"
        raise Diagnostic("R024", f"the Integer {a.value} is set to a Real", span, hint)
    require_same(a, b, scope.context, span)


def check_target(target: Expr | str, span: Span, scope: Scope) -> None:
    """What is assigned is a variable, neither parameter nor constant. Raises R058."""
    if not isinstance(target, Expr) or target.op != "var":
        raise Diagnostic("R058", "the left side is not a variable", span, "write: variable, then its value")
    kind = variability(target, scope.context)
    if kind == "constant" or (kind == "parameter" and not scope.initial):
        hint = "declare it without 'parameter' or 'constant'"
        raise Diagnostic("R058", f"the {kind} {target.value} is assigned", span, hint)


def check_discrete(
    equations: list[flat.Equation], leaves: Iterable[Leaf], assigned: set[str], context: Context
) -> None:
    """A discrete variable that no event sets does not follow what varies between events. Raises R063."""
    for e in equations:
        for a, b in ((e.lhs, e.rhs), (e.rhs, e.lhs)):
            alone = a.op == "var" and a.value not in assigned and variability(a, context) == "discrete"
            if alone and b.op not in ("var", "der") and variability(b, context) == "continuous":
                hint = "set it at events: when ... then; or drop 'discrete'"
                message = f"the discrete {a.value} equals what varies continuously"
                raise Diagnostic("R063", message, e.span, hint)
    _check_declared(leaves, assigned)
    _check_before(equations, assigned, context)


def _is_beside(e: Expr) -> bool:
    """Is it of a variable, and not its value?"""
    return e.op in ("der", "pre", "change")


def _check_before(equations: list[flat.Equation], assigned: set[str], context: Context) -> None:
    """Outside of when-clauses there is no value before of what varies continuously, and what is set at events only has
    no derivative (3.7.4.2, 3.7.5). Raises R052, R054."""
    for e in equations:
        sides = [side for side in (e.lhs, e.rhs) if holds(side, _is_beside)]
        for n in (n for side in sides for n in walk(side) if _is_beside(n)):
            name = n.args[0].value
            continuous = n.args[0].op == "var" and variability(n.args[0], context) == "continuous"
            if n.op in ("pre", "change") and continuous and name not in assigned:
                hint = "use it inside of when, or keep the value in a discrete variable"
                raise Diagnostic("R052", f"{to_text(n)}: {name} varies continuously", e.span, hint)
            if n.op == "der" and name in assigned:
                hint = f"a when-clause sets {name}, which then is constant between events; a state jumps by reinit"
                raise Diagnostic("R054", f"the derivative of the discrete {name}", e.span, hint)


def _check_declared(leaves: Iterable[Leaf], assigned: set[str]) -> None:
    """A Real declared `discrete` is assigned in a when-clause; an input and what is connected gets its value elsewhere
    (4.4.4). Raises R063."""
    for leaf in leaves:
        plain = leaf.declaration.variability == "discrete" and leaf.primitive == REAL and not leaf.causality
        if plain and not leaf.instance.in_connector and not assigned.intersection(leaf.names):
            hint = "set it at events: when ... then; or drop 'discrete'"
            raise Diagnostic("R063", f"no when-clause sets the discrete {leaf.name}", leaf.span, hint)


def _several(item: ast.Equality, scope: Scope) -> list[flat.Equation]:
    results = lower_results(item.right, scope, len(item.left.items))
    equations = []
    for target in item.left.items:
        if target is not None and not isinstance(target, ast.Ref):
            raise Diagnostic("R058", "the left side is not a list of variables", item.left.span, "(a, b) = f(x)")
    for target, value in zip(item.left.items, results, strict=False):
        if target is not None:
            equations += equate(lower(target, scope), value, item.span, scope, item.text)
    return equations


def origin_of(scope: Scope) -> str:
    return scope.instance.name if scope.instance is not None else ""


def real_or_same(kind: str, value: Expr) -> bool:
    """May a variable of type `kind` take `value`?"""
    return value.type == kind or (kind == REAL and value.type == INTEGER)
