"""Enumerations: Integers in the flat model, yet not to be mixed with numbers or with each other."""

from __future__ import annotations

from functools import lru_cache

from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten.context import Context
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.expr import INTEGER, Expr
from lacuna.codegen.syntax import ast


@lru_cache(maxsize=1024)
def _ordinal(enumeration: str) -> type[int]:
    """A class of whole numbers for each enumeration: it keeps their constants apart in the table of expressions."""
    return type("Ordinal", (int,), {"enumeration": enumeration})


def literal(cls: ast.Class, number: int) -> Expr:
    """Literal `number`, from 1, of an enumeration."""
    return ex.const(_ordinal(cls.path)(number))


def as_integer(e: Expr) -> Expr:
    """The number of an enumeration value."""
    return ex.const(int(e.value)) if e.op == "const" else ex.special("noEvent", e, type=INTEGER)


def enumeration_of(e: Expr, context: Context) -> str:
    """The path of the enumeration that `e` is of, "" for a number."""
    if e.op == "const":
        return getattr(type(e.value), "enumeration", "")
    if e.op == "var" and e.value in context.scalars:
        kind = context.scalars[str(e.value)][0].type
        return kind.cls.path if kind.literals else ""
    if e.op in ("pre", "if", "min", "max"):
        return enumeration_of(e.args[-1], context)
    return ""


def require_same(a: Expr, b: Expr, context: Context, span: Span) -> None:
    """Raises R025 where one side is of an enumeration and the other is not of the same."""
    if a.type != INTEGER or b.type != INTEGER:
        return
    first, second = enumeration_of(a, context), enumeration_of(b, context)
    if first != second:
        sides = " and ".join(name.rsplit(".", 1)[-1] or "Integer" for name in (first, second))
        name = (first or second).rsplit(".", 1)[-1]
        raise Diagnostic("R025", f"the sides are {sides}", span, f"use literals of {name}, or its number Integer(...)")
