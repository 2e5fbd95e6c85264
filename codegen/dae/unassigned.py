"""Outputs that a function leaves without a value, and fields of such: an error where one is used (12.4.4).

A variable that such an output goes to may stay without a value while nobody reads it: the run goes on, and its result
has NaN for it. When it is read only parameters can tell, so that it is settled before the run:

    v = if c then e else <nothing>      becomes      v = if c then e else if <read> then <nothing> else <unread>

where <read> are the conditions, in parameters, of the branches that read v; what else such a branch depends on counts
as true. The C has a NaN of its own for <unread>, so that any other one in the same place ends the run still.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from lacuna.codegen import flat
from lacuna.codegen.symbolic.expr import (
    FALSE,
    REAL,
    TRUE,
    Expr,
    Unassigned,
    if_else,
    logical_and,
    logical_not,
    logical_or,
    rebuild,
    unassigned,
    var,
    walk,
)
from lacuna.codegen.symbolic.leaves import holds, leaves
from lacuna.codegen.symbolic.rewrite import expressions

_STILL = (flat.CONSTANT, flat.PARAMETER)


def leave_unread(model: flat.FlatModel) -> flat.FlatModel:
    """The model that goes on without what nobody reads, and that names in the texts of equations what is missing."""
    definitions = _definitions(model)
    given = {n for n, e in definitions.items() if any(map(_is_unassigned, _ends(e)))}
    readers = _Readers(model, definitions, given)
    read = {n: readers.of(n) for n in definitions if n in given}

    def marked(name: str, value: Expr) -> Expr:
        return _marked(value, read[name]) if name in read else value

    variables = {
        n: replace(v, binding=marked(n, v.binding)) if n in read and v.binding is not None else v
        for n, v in model.variables.items()
    }
    equations = []
    for e in model.equations:
        rhs = marked(str(e.lhs.value), e.rhs) if e.lhs.op == "var" else e.rhs
        equations.append(replace(e, rhs=rhs, text=told(e.text, e.lhs, rhs)))
    return replace(model, variables=variables, equations=equations)


def told(text: str, *sides: Expr) -> str:
    """The text of an equation, behind what its sides hold that may have no value and somebody reads."""
    found = [n.value for e in sides if holds(e, _is_unassigned) for n in walk(e) if _is_unassigned(n)]
    names = dict.fromkeys(value.output for value in found if not value.unread)
    return f"{', '.join(names)}, which nothing assigns in some case: {text}" if names else text


class _Readers:
    """Who reads variables, other than the definitions of these: `given` may have no value."""

    def __init__(self, model: flat.FlatModel, definitions: dict[str, Expr], given: set[str]):
        self._variables, self._given = model.variables, given
        self._copies: dict[str, list[str]] = {}
        for name, value in definitions.items():
            if value.op == "var":
                self._copies.setdefault(str(value.value), []).append(name)
        self._all = [(n, e) for n, e in _all_expressions(model) if given and not (n in definitions and e.op == "var")]
        self._moving: dict[str, bool] = {}

    def of(self, name: str) -> Expr:
        """When the value of `name` is read, by what is bound to it and read in turn as well."""
        v = self._variables[name]
        bounded = v.variability in _STILL and (v.min is not None or v.max is not None)
        if bounded or v.causality == "output":
            return TRUE
        leaf, found = var(name, v.type), FALSE
        memo: dict[Expr, Expr] = {leaf: TRUE}
        for owner, e in self._all:
            if owner != name and leaf in leaves(e):
                found = logical_or(found, self._reads(e, leaf, memo))
        for copy in self._copies.get(name, ()):
            found = logical_or(found, self.of(copy))
        return found

    def _reads(self, e: Expr, leaf: Expr, memo: dict[Expr, Expr]) -> Expr:
        """When the value of `e` takes that of a leaf of it, as far as parameters tell."""
        if e not in memo:
            if leaf not in leaves(e) or not e.args:
                memo[e] = TRUE if e.op in ("der", "pre") and leaf in e.args else FALSE
            elif e.op in ("if", "and", "or"):
                memo[e] = self._reads_by_choice(e, leaf, memo)
            else:
                found = FALSE
                for a in e.args:
                    found = logical_or(found, self._reads(a, leaf, memo))
                memo[e] = found
        return memo[e]

    def _reads_by_choice(self, e: Expr, leaf: Expr, memo: dict[Expr, Expr]) -> Expr:
        first, *others = e.args
        outcomes = {"if": (True, False), "and": (True,), "or": (False,)}[e.op]
        found = self._reads(first, leaf, memo)
        for outcome, a in zip(outcomes, others, strict=True):
            found = logical_or(found, logical_and(self._may_be(first, outcome), self._reads(a, leaf, memo)))
        return found

    def _may_be(self, condition: Expr, outcome: bool) -> Expr:
        """Whether a condition can have that value, as far as parameters tell."""
        if self._is_still(condition):
            return condition if outcome else logical_not(condition)
        if condition.op == "noEvent":
            return self._may_be(condition.args[0], outcome)
        if condition.op == "not":
            return self._may_be(condition.args[0], not outcome)
        if condition.op in ("and", "or"):
            together = logical_and if (condition.op == "and") == outcome else logical_or
            return together(*(self._may_be(a, outcome) for a in condition.args))
        return TRUE

    def _is_still(self, e: Expr) -> bool:
        """Whether parameters decide about it, none of which may have no value."""
        return all(n.op == "var" and not self._moves(str(n.value)) for n in leaves(e))

    def _moves(self, name: str) -> bool:
        if name not in self._moving:
            v = self._variables[name]
            self._moving[name] = True  # in a circle, which is refused later on
            still = v.variability in _STILL and name not in self._given
            self._moving[name] = not still or (v.binding is not None and not self._is_still(v.binding))
        return self._moving[name]


def _is_unassigned(n: Expr) -> bool:
    return n.op == "const" and isinstance(n.value, Unassigned)


def _definitions(model: flat.FlatModel) -> dict[str, Expr]:
    """What the Reals are that a binding gives, or an equation v = e where e may have no value."""
    found = {n: v.binding for n, v in model.variables.items() if v.binding is not None and v.type == REAL}
    return found | {str(e.lhs.value): e.rhs for e in model.equations if _gives(e, model.variables)}


def _gives(e: flat.Equation, variables: dict[str, flat.Variable]) -> bool:
    if e.lhs.op != "var" or e.lhs.type != REAL or not holds(e.rhs, _is_unassigned):
        return False
    v = variables[str(e.lhs.value)]
    return v.variability == flat.CONTINUOUS and v.causality != "input" and e.lhs not in leaves(e.rhs)


def _ends(e: Expr) -> list[Expr]:
    """The values that `e` may have, whatever its conditions say."""
    if e.op == "if":
        return [end for a in e.args[1:] for end in _ends(a)]
    return _ends(e.args[0]) if e.op == "noEvent" else [e]


def _marked(e: Expr, read: Expr) -> Expr:
    if e.op == "if":
        return rebuild(e, (e.args[0], *(_marked(a, read) for a in e.args[1:])))
    if e.op == "noEvent":
        return rebuild(e, (_marked(e.args[0], read),))
    return if_else(read, e, unassigned(e.value.output, unread=True)) if _is_unassigned(e) else e


def _all_expressions(model: flat.FlatModel) -> Iterator[tuple[str, Expr]]:
    """Whatever is computed, with the name of the variable that it defines, "" where it does not."""
    for v in model.variables.values():
        yield from (("", e) for e in (v.start, v.fixed, v.min, v.max, v.nominal) if e is not None)
        if v.binding is not None:
            yield v.name, v.binding
    for e in model.equations:
        name = str(e.lhs.value) if _gives(e, model.variables) else ""
        yield from (((name, e.rhs),) if name else (("", e.lhs), ("", e.rhs)))
    yield from (("", side) for e in model.initial_equations for side in (e.lhs, e.rhs))
    statements = [*model.whens, *(s for a in model.algorithms for s in a.statements), *model.asserts]
    yield from (("", e) for e in expressions(statements))
    yield from (("", var(n, model.variables[n].type)) for a in model.asserts for n in a.shown if n in model.variables)
    yield from (("", r.value) for rules in model.derivatives.values() for r in rules if isinstance(r.value, Expr))
