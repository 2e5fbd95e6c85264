"""Which functions of a model may run for long, take much of the stack or compare what is no number, and where that is
told."""

from __future__ import annotations

from collections.abc import Iterable
import math

from lacuna.codegen import flat
from lacuna.codegen.emit.text.doubts import Doubts
from lacuna.codegen.symbolic.expr import TRUE, Expr, is_of_the_model, walk
from lacuna.codegen.symbolic.function_tangent import by_name, original
from lacuna.codegen.symbolic.rewrite import all_statements, expressions

ROUNDS = 10_000_000  # of all loops and calls inside one call from an equation: a tenth of a second
STACK = 1 << 21  # bytes: a quarter of what a thread has on Linux, since _FRAME is a guess
_FRAME = 512  # bytes of a call beside its locals: return address, saved registers, temporaries
_LARGE = 4096  # bytes that no chain of functions without recursion makes dangerous


def frame(f: flat.Function) -> int:
    """Bytes of a call on the stack, about."""
    return _FRAME + 8 * sum(math.prod(shape) for shape in f.shapes.values())


def may_not_end(f: flat.Function, functions: dict[str, flat.Function]) -> bool:
    """Whether a call may take long, or much of the stack: it is counted. Of a tangent whether one of its function may:
    it has the same loops and calls, and a few times the locals."""
    f = original(functions, f.name)
    loops = any(isinstance(s, flat.For | flat.While) for s in all_statements(f.body))
    return loops or frame(f) > _LARGE or is_recursive(f, functions)


def has_row(f: flat.Function, functions: dict[str, flat.Function]) -> bool:
    """Whether a call may go wrong in a way that is told at the function: it does not end, or compares what is no
    number."""
    doubts = Doubts(in_function=True)
    own = original(functions, f.name)
    compares = any(doubts.of(n) for e in (*own.defaults.values(), *expressions(own.body)) for n in walk(e))
    return compares or may_not_end(f, functions)


def row_of(f: flat.Function) -> flat.Assert:
    """A function as a row of the table of asserts."""
    return flat.Assert(TRUE, f"function {f.name}", f.span)


def calls(roots: Iterable[Expr]) -> list[str]:
    """Names of the functions of the model that occur in expressions, in order."""
    found = (str(n.value) for root in roots for n in walk(root) if is_of_the_model(n))
    return list(dict.fromkeys(found))


def calls_of(f: flat.Function) -> list[tuple[str, bool]]:
    """(name, whether in an expression) of the functions that `f` calls."""
    whole = [s.value for s in all_statements(f.body) if isinstance(s, flat.AssignCall)]
    inside = [e for e in (*f.defaults.values(), *expressions(f.body)) if e not in whole]
    inside += [a for call in whole for a in call.args]
    return [(str(call.value), False) for call in whole] + [(name, True) for name in calls(inside)]


def is_recursive(f: flat.Function, functions: dict[str, flat.Function]) -> bool:
    """Whether calls lead from the function to itself."""
    waiting, seen = [name for name, _ in calls_of(f)], set[str]()
    while waiting:
        name = waiting.pop()
        if name not in seen:
            seen.add(name)
            waiting += [inner for inner, _ in calls_of(by_name(functions, name))]
    return f.name in seen
