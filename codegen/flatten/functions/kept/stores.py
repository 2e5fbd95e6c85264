"""Statements that set variables of a function that runs at run time: those that are named, and those that a subscript
picks. The elements of an array of records are variables of their own, so that a subscript chooses among them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import groupby

from lacuna.codegen import flat
from lacuna.codegen.errors import Span
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.expr import FALSE, TRUE, Expr

Step = tuple[Expr, Expr]  # what is set, and its value


def stores(steps: Iterable[Step], span: Span) -> list[flat.Statement]:
    """Set one after the other; a choice that is the same for neighbours (fields of one record) is made once. A
    subscript of none of the elements fails."""
    result: list[flat.Statement] = []
    for conditions, group in groupby(steps, key=lambda step: [c for c, _ in _alternatives(step[0])]):
        alike = [([t for _, t in _alternatives(target)], value) for target, value in group]
        if len(conditions) == 1:
            result += [_store(target, value, span) for (target,), value in alike]
            continue
        chosen = [[(targets[k], value) for targets, value in alike] for k in range(len(conditions))]
        bodies = [stores(c, span) for c in chosen[:-1]]
        outside = ex.is_nothing(chosen[-1][0][0])
        bodies.append([_outside(chosen[0][0][0], span)] if outside else stores(chosen[-1], span))
        result.append(flat.If(list(zip(conditions, bodies, strict=True)), span))
    return result


def _store(target: Expr, value: Expr, span: Span) -> flat.Statement:
    if target.op == "var":
        return flat.Assign(str(target.value), value, span)
    return flat.AssignElement(str(target.args[0].value), target.args[1:], value, span)


def _outside(element: Expr, span: Span) -> flat.Statement:
    array = str(next(_names(element))).split("[")[0]
    return flat.Assert(FALSE, f"a subscript of {array} is outside of its array", span)


def _alternatives(target: Expr) -> list[tuple[Expr, Expr]]:
    """(condition, target) of a choice, the first whose condition holds being meant; of anything else itself."""
    found = []
    while target.op == "if":
        condition, first, target = target.args
        found.append((condition, first))
    return [*found, (TRUE, target)]


def read_what_is_set(read: Iterable[Expr], steps: list[Step]) -> bool:
    """Does one of the expressions read a variable that the steps may set?"""
    names = {name for target, _ in steps for name in _names(target)}
    return any(n.op == "var" and n.value in names for e in read for n in ex.walk(e))


def _names(target: Expr) -> Iterator[object]:
    """The variables that may be meant."""
    if target.op == "if":
        for _, t in _alternatives(target):
            yield from _names(t)
    elif not ex.is_nothing(target):
        yield target.value if target.op == "var" else target.args[0].value


def deciding(target: Expr) -> Iterator[Expr]:
    """What decides at run time which variable is meant: subscripts, and conditions that they came to."""
    if target.op == "if":
        for condition, t in _alternatives(target):
            yield from (() if condition is TRUE else (condition,))
            yield from deciding(t)
    elif target.op == "call":
        yield from (index for index in target.args[1:] if index.op != "const")


def decided(target: Expr, by: dict[Expr, Expr]) -> Expr:
    """The target with other expressions in place of those that decide which variable it is."""
    if target.op == "if":
        *chosen, (_, result) = [(by.get(c, c), decided(t, by)) for c, t in _alternatives(target)]
        for condition, t in reversed(chosen):
            result = ex.if_else(condition, t, result)
        return result
    if target.op == "call":
        array, *subscripts = target.args
        return ex.node("call", (array, *(by.get(i, i) for i in subscripts)), "[]", target.type)
    return target
