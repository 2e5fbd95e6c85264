"""How much a call of a function may take at translation, with all the calls inside it."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
import threading

from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten.expressions.constants import AtRunTime
from lacuna.codegen.flatten.names.values import Value, expressions_of, scalars
from lacuna.codegen.symbolic.expr import Expr

MAX_NESTED_STEPS = 100_000  # statements of a call and all calls inside it
STEPS_OF_A_CALL = 6  # its arguments, variables and results take as long as so many statements (105 and 18 us measured)
MAX_CALLS = 100  # inside each other
MAX_INLINE_DEPTH = 12  # of inlined calls inside each other
MAX_INLINE_NODES = 250  # of the expressions that an inlined call becomes


class _Effort(threading.local):
    """Of the outermost call that is being run in this thread."""

    calls = 0
    steps = 0


_effort = _Effort()


def one_more_step() -> int:
    """Statements run so far."""
    _effort.steps += 1
    return _effort.steps


@contextmanager
def nested_call(symbolic: bool, span: Span) -> Iterator[None]:
    """Around a call. Raises F034 where it is too deep inside others, AtRunTime where its values are not known."""
    if _effort.calls >= MAX_CALLS:
        if symbolic:
            raise AtRunTime("a deep recursion", span)
        message = f"more than {MAX_CALLS} calls inside each other"
        raise Diagnostic("F034", message, span, "does the recursion reach its end?")
    _effort.calls += 1
    _effort.steps += STEPS_OF_A_CALL
    try:
        yield
    finally:
        _effort.calls -= 1
        if not _effort.calls:
            _effort.steps = 0


def is_small(results: list[Value], arguments: dict[str, Value]) -> bool:
    """Is what a call becomes small enough to stand in its place?"""
    given = {a for v in arguments.values() for a in scalars(v)}
    seen: set[Expr] = set()
    stack = [e for r in results for s in scalars(r) for e in expressions_of(s)]
    while stack:
        n = stack.pop()
        if n not in seen and n not in given:
            seen.add(n)
            stack.extend(n.args)
        if len(seen) > MAX_INLINE_NODES:
            return False
    return True
