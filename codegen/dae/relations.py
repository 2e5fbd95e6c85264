"""Relations between continuous quantities: a > b or its negation, and how they are told."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

from lacuna.codegen import flat
from lacuna.codegen.symbolic.expr import BOOLEAN, Expr, node, relation
from lacuna.codegen.symbolic.rewrite import Rewriter


@dataclass
class Relation:
    """left > right; `slope` is d(left - right)/dt of a time relation, None of a root. `text` says the same as the model
    does: its operands and their order, or the call that it comes from."""

    left: Expr
    right: Expr
    source: flat.Equation
    slope: Expr | None = None
    text: str = ""


def canonical(n: Expr) -> tuple[Expr, Expr, bool]:
    """(a, b, positive): the relation is a > b, or its negation where not positive."""
    a, b = n.args
    if n.op == ">":
        return a, b, True
    if n.op == "<":
        return b, a, True
    return (a, b, False) if n.op == "<=" else (b, a, False)


def complement(n: Expr) -> Expr:
    """`n`, one of <= and >=, the other way round: true where it is false, with its operands where they were."""
    return node(">" if n.op == "<=" else "<", n.args, None, BOOLEAN)


def within(written: Expr, left: Expr, right: Expr) -> str:
    """left > right inside the call `written`."""
    return f"{relation('>', left, right)} in {written}"


def rename(relations: list[Relation], rewriter: Rewriter) -> list[Relation]:
    """The relations with other names of derivatives."""
    return [replace(r, left=rewriter.expression(r.left), right=rewriter.expression(r.right)) for r in relations]


def asked(expressions: Iterable[Expr]) -> set[int]:
    """Numbers of the relations that every evaluation of the expressions asks for: those in no branch of an `if`
    and behind no `and` or `or`."""
    found: set[int] = set()
    seen: set[Expr] = set()
    waiting = list(expressions)
    while waiting:
        e = waiting.pop()
        if e in seen:
            continue
        seen.add(e)
        if e.op == "rel":
            found.add(int(e.value))
        waiting += e.args[:1] if e.op in ("if", "and", "or") else e.args
    return found
