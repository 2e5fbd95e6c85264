"""Enumerations: Integers in the flat model, yet not to be mixed with numbers or with each other."""

from __future__ import annotations

from functools import lru_cache

from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten.names.context import Context
from lacuna.codegen.flatten.names.index_types import boolean_type, enumeration
from lacuna.codegen.flatten.names.scope import Scope
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.expr import BOOLEAN, BUILTINS, FALSE, INTEGER, TRUE, Expr
from lacuna.codegen.syntax import ast


@lru_cache(maxsize=1024)
def _ordinal(enumeration: str) -> type[int]:
    """A class of whole numbers for each enumeration: it keeps their constants apart in the table of expressions."""
    return type("Ordinal", (int,), {"enumeration": enumeration})


def literal(cls: ast.Class, number: int) -> Expr:
    """Literal `number`, from 1, of an enumeration."""
    return ex.const(_ordinal((cls.origin or cls).path)(number))


def as_integer(e: Expr) -> Expr:
    """The number of an enumeration value."""
    return ex.const(int(e.value)) if e.op == "const" else ex.special("noEvent", e, type=INTEGER)


def enumeration_of(e: Expr, context: Context) -> str | None:
    """The path of the enumeration that `e` is of, "" for a number; None where that is not known: variables and results
    of functions that run at run time are mere whole numbers."""
    if e.op == "const":
        return getattr(type(e.value), "enumeration", "")
    if e.op == "var":
        if e.value not in context.scalars:
            return None if e.type == INTEGER else ""
        kind = context.scalars[str(e.value)][0].type
        return (kind.cls.origin or kind.cls).path if kind.literals else ""
    if e.op in ("pre", "if", "min", "max"):
        return enumeration_of(e.args[1 if e.op == "if" else -1], context)
    if e.op == "call" and e.type == INTEGER and e.value not in BUILTINS:
        return enumeration_of(e.args[0], context) if e.value == "[]" else None
    return "" if e.op != "array" else enumeration_of(e.args[0], context)


def require_same(a: Expr, b: Expr, context: Context, span: Span) -> None:
    """Raises R025 where one side is of an enumeration and the other is not of the same."""
    if INTEGER not in (a.type, b.type):
        return
    first, second = enumeration_of(a, context), enumeration_of(b, context)
    if None not in (first, second) and first != second:
        sides = " and ".join(name.rsplit(".", 1)[-1] or "Integer" for name in (first, second))
        name = (first or second).rsplit(".", 1)[-1]
        raise Diagnostic("R025", f"the sides are {sides}", span, f"use literals of {name}, or its number Integer(...)")


IndexType = tuple[Expr, ...] | None  # of a dimension: the values of an enumeration or of Boolean; None: 1, 2, ...


def index_type(e: ast.Expression, scope: Scope) -> IndexType:
    """The values of the type that `e` names as a dimension or a range; None for anything else."""
    if not isinstance(e, ast.Ref):
        return None
    cls = enumeration(e, scope)
    if cls is not None:
        return tuple(literal(cls, number) for number in range(1, len(cls.literals) + 1))
    return (FALSE, TRUE) if boolean_type(e, scope) else None


def index_number(index: Expr, kind: IndexType, context: Context, span: Span) -> Expr:
    """A subscript as a whole number; false is 1, true 2. Raises R044 for one of a type that the dimension has not."""
    wanted = "" if kind is None else "Boolean" if kind[0].type == BOOLEAN else enumeration_of(kind[0], context)
    found = "Boolean" if index.type == BOOLEAN else enumeration_of(index, context)
    if index.type not in (INTEGER, BOOLEAN) or found not in (wanted, None if wanted != "Boolean" else wanted):
        names = [name.rsplit(".", 1)[-1] or "Integer" for name in (found if index.type != "Real" else "Real", wanted)]
        hint = f"use a value of {names[1]}" if wanted else "use a whole number"
        raise Diagnostic("R044", f"a subscript is {names[0]}, the dimension runs over {names[1]}", span, hint)
    return ex.if_else(index, ex.const(2), ex.const(1)) if found == "Boolean" else index
