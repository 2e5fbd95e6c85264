"""How much a call of a function may take at translation, with all the calls inside it."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
import threading

from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten.expressions.constants import AtRunTime

MAX_NESTED_STEPS = 100_000  # statements of a call and all calls inside it
MAX_CALLS = 100  # inside each other


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
    try:
        yield
    finally:
        _effort.calls -= 1
        if not _effort.calls:
            _effort.steps = 0
