"""Scalar expressions of a flat model, hash-consed: equal expressions are the same object.

So common subexpressions share a node by construction, comparison is `is`, and every pass can memoise on
nodes. An expression carries no place in the source (equations do). Build nodes with the functions below,
which fold constants and drop neutral elements; never call `Expr` itself.

    op        args                      value
    const     ()                        float | int | bool
    var       ()                        full Modelica name, such as "motor.phase[2].i"
    der       (var,)                    -
    pre       (var,)                    -
    time      ()                        -
    start_time ()                       -         of the run, in parameters
    path      ()                        -         of homotopy, from 0 to 1, in initial equations
    + * and or min max                  two arguments, left to right
    - /       two arguments;  neg not   one argument;   ^  two arguments
    < <= > >= == <>                     two arguments
    if        (condition, then, else)
    call      arguments                 name of a built-in or a function of the model
    array     elements                  an array argument of a function call (row-major)
    noEvent   (e,)       smooth (order const, e)
    annotated (e, arguments...)         key of its derivative's rules (see `annotated.py`): before differentiation
    sample    (start, interval)         edge (e,)   change (var,)   initial ()   terminal ()
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cache
import math
import threading

REAL, INTEGER, BOOLEAN = "Real", "Integer", "Boolean"

RELATIONS = ("<", "<=", ">", ">=", "==", "<>")

BUILTINS: dict[str, int] = {
    "abs": 1, "sign": 1, "sqrt": 1, "sin": 1, "cos": 1, "tan": 1, "asin": 1, "acos": 1, "atan": 1,
    "atan2": 2, "sinh": 1, "cosh": 1, "tanh": 1, "exp": 1, "log": 1, "log10": 1,
    "floor": 1, "ceil": 1, "integer": 1, "mod": 2, "rem": 2, "div": 2,
}  # fmt: skip

EVENTFUL = ("abs", "sign", "floor", "ceil", "integer", "mod", "rem", "div")


class Expr:
    """One node; immutable. `type` is Real, Integer or Boolean (an enumeration is an Integer)."""

    __slots__ = ("__weakref__", "_hash", "args", "op", "type", "value")
    op: str
    args: tuple[Expr, ...]
    value: object
    type: str

    def __hash__(self) -> int:
        return self._hash

    def __eq__(self, other: object) -> bool:
        return self is other

    def __repr__(self) -> str:
        return to_text(self)


class Table:
    """Nodes by their shape, and what is memoised on them."""

    def __init__(self) -> None:
        self.nodes: dict[tuple, Expr] = {}
        self.leaves: dict[Expr, frozenset[Expr]] = {}
        self.names: dict[Expr, frozenset[str]] = {}
        self.nonlinear: dict[Expr, frozenset[Expr]] = {}
        self.plain: dict[Expr, Expr] = {}
        self.measured: dict[Expr, type[float]] = {}
        self.holding: dict[Callable[[Expr], bool], dict[Expr, bool]] = {}


class _Current(threading.local):
    table = Table()  # that of the process, which lasts


_lasting = _Current.table
_current = _Current()


def table() -> Table:
    """The table in which this thread makes nodes."""
    return _current.table


@contextmanager
def own_table() -> Iterator[Table]:
    """Nodes made inside go with their last user, memos included; those of the process's table serve inside as well."""
    before, _current.table = _current.table, Table()
    try:
        yield _current.table
    finally:
        _current.table = before


def node(op: str, args: tuple[Expr, ...] = (), value: object = None, type: str = REAL) -> Expr:
    """The unique node of this shape, without any folding."""
    key = (op, tuple(map(id, args)), value, value.__class__, type, value == 0.0 and _signed_zero(value))
    nodes = _current.table.nodes
    found = nodes.get(key) or _lasting.nodes.get(key)
    if found is None:
        found = Expr()
        found.op, found.args, found.value, found.type = op, args, value, type
        found._hash = hash((op, tuple(a._hash for a in args), str(value), type))
        nodes[key] = found
    return found


def _signed_zero(value: object) -> bool:
    return isinstance(value, float) and value == 0.0 and math.copysign(1.0, value) < 0


def const(value: float | int | bool) -> Expr:
    kind = BOOLEAN if isinstance(value, bool) else INTEGER if isinstance(value, int) else REAL
    return node("const", (), value, kind)


def nothing(type: str) -> Expr:
    """What is no value of a type: where a run computes it, the run ends."""
    return node("const", (), math.nan, type)


class Unassigned(float):
    """No number: what `output`, as "r.b of f" says, is where its function does not assign it. `unread`: nobody asks."""

    output: str
    unread: bool


@cache
def _unassigned(output: str, unread: bool) -> Unassigned:
    value = Unassigned(math.nan)
    value.output, value.unread = output, unread
    return value


def unassigned(output: str, unread: bool = False) -> Expr:
    """The Real that is no value, of an output as a message names it."""
    return node("const", (), _unassigned(output, unread))


def is_nothing(e: Expr) -> bool:
    return e.op == "const" and e.value != e.value


def var(name: str, type: str = REAL) -> Expr:
    return node("var", (), name, type)


ZERO, ONE, TRUE, FALSE = const(0.0), const(1.0), const(True), const(False)
TIME = node("time")
START_TIME = node("start_time")


def is_const(e: Expr, value: object = None) -> bool:
    return e.op == "const" and (value is None or (e.value == value and e.type != BOOLEAN))


def _number_type(*args: Expr) -> str:
    return INTEGER if all(a.type == INTEGER for a in args) else REAL


def _real(value: float | int) -> Expr:
    return const(float(value))


def _beside(neutral: Expr, e: Expr) -> Expr:
    """What is left of an operation with 0 or 1: a Real beside a Real."""
    return as_real(e) if neutral.type == REAL else e


def as_real(e: Expr) -> Expr:
    """An Integer where a Real is meant: what is left of n*1.0 is one, too. What happens in it makes events still."""
    if e.type != INTEGER:
        return e
    if e.op == "const":
        return _real(e.value)
    if e.op == "if":
        return if_else(e.args[0], as_real(e.args[1]), as_real(e.args[2]))
    return node("+", (e, ZERO)) if any(map(is_eventful, walk(e))) else special("noEvent", e, type=REAL)


def is_eventful(e: Expr) -> bool:
    """Whether it makes events, outside of noEvent."""
    return e.op in RELATIONS or e.op in ("min", "max") or (e.op == "call" and e.value in EVENTFUL)


def add(a: Expr, b: Expr) -> Expr:
    if is_const(a) and is_const(b):
        return const(a.value + b.value)
    if is_const(a, 0):
        return _beside(a, b)
    if is_const(b, 0):
        return _beside(b, a)
    if b.op == "neg":
        return sub(a, b.args[0])
    if a.op == "neg":
        return sub(b, a.args[0])
    return node("+", (a, b), None, _number_type(a, b))


def sub(a: Expr, b: Expr) -> Expr:
    if is_const(a) and is_const(b):
        return const(a.value - b.value)
    if is_const(b, 0):
        return _beside(b, a)
    if is_const(a, 0):
        return neg(_beside(a, b))
    if a is b:
        return const(0) if a.type == INTEGER else ZERO
    if b.op == "neg":
        return add(a, b.args[0])
    return node("-", (a, b), None, _number_type(a, b))


def neg(a: Expr) -> Expr:
    if is_const(a):
        return const(-a.value)
    if a.op == "neg":
        return a.args[0]
    if a.op == "-":
        return sub(a.args[1], a.args[0])
    return node("neg", (a,), None, a.type)


def mul(a: Expr, b: Expr) -> Expr:
    if is_const(a) and is_const(b):
        return const(a.value * b.value)
    if is_const(a, 0) or is_const(b, 0):
        return const(0) if _number_type(a, b) == INTEGER else ZERO
    if is_const(a, 1):
        return _beside(a, b)
    if is_const(b, 1):
        return _beside(b, a)
    if is_const(a, -1):
        return neg(_beside(a, b))
    if is_const(b, -1):
        return neg(_beside(b, a))
    if a.op == "neg":
        return neg(mul(a.args[0], b))
    if b.op == "neg":
        return neg(mul(a, b.args[0]))
    return node("*", (a, b), None, _number_type(a, b))


def div(a: Expr, b: Expr) -> Expr:
    if is_const(a) and is_const(b) and b.value != 0:
        return const(a.value / b.value)
    if is_const(a, 0) and not is_const(b, 0):
        return ZERO
    if is_const(b, 1):
        return as_real(a)
    if is_const(b, -1):
        return neg(as_real(a))
    if a.op == "neg":
        return neg(div(a.args[0], b))
    return node("/", (a, b))


def power(a: Expr, b: Expr) -> Expr:
    if is_const(b, 1):
        return as_real(a)
    if is_const(b, 0):
        return ONE
    if is_const(a) and is_const(b):
        try:
            value = a.value ** float(b.value)
            if isinstance(value, float) and math.isfinite(value):
                return const(value)
        except (OverflowError, ZeroDivisionError):
            pass
    return node("^", (a, b))


def _minmax(op: str) -> Callable[[Expr, Expr], Expr]:
    pick = min if op == "min" else max

    def build(a: Expr, b: Expr) -> Expr:
        if is_const(a) and is_const(b):
            picked = const(pick(a.value, b.value))
            return as_real(picked) if REAL in (a.type, b.type) else picked
        return a if a is b else node(op, (a, b), None, _number_type(a, b))

    return build


minimum, maximum = _minmax("min"), _minmax("max")

_compare: dict[str, Callable[[float, float], bool]] = {
    "<": lambda a, b: a < b, "<=": lambda a, b: a <= b, ">": lambda a, b: a > b,
    ">=": lambda a, b: a >= b, "==": lambda a, b: a == b, "<>": lambda a, b: a != b,
}  # fmt: skip


def relation(op: str, a: Expr, b: Expr) -> Expr:
    if a.op == "const" and b.op == "const":
        return const(bool(_compare[op](a.value, b.value)))
    return node(op, (a, b), None, BOOLEAN)


def logical_and(a: Expr, b: Expr) -> Expr:
    if a.op == "const":
        return b if a.value else FALSE
    if b.op == "const":
        return a if b.value else FALSE
    return a if a is b else node("and", (a, b), None, BOOLEAN)


def logical_or(a: Expr, b: Expr) -> Expr:
    if a.op == "const":
        return TRUE if a.value else b
    if b.op == "const":
        return TRUE if b.value else a
    return a if a is b else node("or", (a, b), None, BOOLEAN)


def logical_not(a: Expr) -> Expr:
    if a.op == "const":
        return const(not a.value)
    return a.args[0] if a.op == "not" else node("not", (a,), None, BOOLEAN)


def if_else(condition: Expr, then: Expr, otherwise: Expr) -> Expr:
    if condition.op == "const":
        chosen, other = (then, otherwise) if condition.value else (otherwise, then)
        return _beside(other, chosen)
    if then is otherwise:
        return then
    kind = then.type if then.type == otherwise.type else REAL
    return node("if", (condition, then, otherwise), None, kind)


def der(e: Expr) -> Expr:
    return node("der", (e,))


def pre(e: Expr) -> Expr:
    return node("pre", (e,), None, e.type)


def _floor_of(a: float, b: float) -> int:
    """The largest whole number that is not above a/b; of Integers without rounding."""
    return a // b if isinstance(a, int) and isinstance(b, int) else math.floor(a / b)


def _whole_of(a: float, b: float) -> int:
    """a/b without its fraction; of Integers without rounding."""
    if isinstance(a, int) and isinstance(b, int):
        return abs(a) // abs(b) * (1 if (a < 0) == (b < 0) else -1)
    return math.trunc(a / b)


_fold: dict[str, Callable[..., float]] = {
    "abs": abs, "sqrt": math.sqrt, "sin": math.sin, "cos": math.cos, "tan": math.tan, "asin": math.asin,
    "acos": math.acos, "atan": math.atan, "atan2": math.atan2, "sinh": math.sinh, "cosh": math.cosh,
    "tanh": math.tanh, "exp": math.exp, "log": math.log, "log10": math.log10,
    "sign": lambda a: (a > 0) - (a < 0), "floor": math.floor, "ceil": math.ceil, "integer": math.floor,
    "mod": lambda a, b: a - _floor_of(a, b) * b,
    "rem": lambda a, b: a - _whole_of(a, b) * b, "div": lambda a, b: _whole_of(a, b),
}  # fmt: skip


def call(name: str, *args: Expr, type: str | None = None) -> Expr:
    """A built-in (see BUILTINS) or a function of the model; constant arguments of built-ins are folded."""
    if name in BUILTINS:
        kind = type or _builtin_type(name, args)
        if all(is_const(a) for a in args):
            try:
                value = _fold[name](*(a.value for a in args))
                return const(int(value)) if kind == INTEGER else _real(value)
            except (ValueError, ZeroDivisionError, OverflowError):
                pass
        return node("call", tuple(args), name, kind)
    return node("call", tuple(args), name, type or REAL)


def is_of_the_model(e: Expr) -> bool:
    """Whether `e` calls a function of the model; "[]" takes an element of an array."""
    return e.op == "call" and e.value not in BUILTINS and e.value != "[]"


def _builtin_type(name: str, args: tuple[Expr, ...]) -> str:
    if name in ("sign", "integer"):
        return INTEGER
    if name in ("abs", "mod", "rem", "div"):
        return _number_type(*args)
    return REAL


def array(*elements: Expr) -> Expr:
    return node("array", tuple(elements))


def special(op: str, *args: Expr, type: str = BOOLEAN) -> Expr:
    """noEvent, smooth, sample, edge, change, initial, terminal."""
    return node(op, tuple(args), None, type)


_BUILD: dict[str, Callable[..., Expr]] = {
    "+": add, "-": sub, "*": mul, "/": div, "^": power, "neg": neg, "min": minimum, "max": maximum,
    "and": logical_and, "or": logical_or, "not": logical_not, "if": if_else,
}  # fmt: skip


def rebuild(e: Expr, args: tuple[Expr, ...]) -> Expr:
    """`e` with other arguments, folded again."""
    if args == e.args:
        return e
    if e.op in _BUILD:
        return _BUILD[e.op](*args)
    if e.op in RELATIONS:
        return relation(e.op, *args)
    if e.op == "call":
        return call(e.value, *args, type=e.type)
    if e.op in ("noEvent", "smooth") and is_const(args[-1]):
        return args[-1]
    if e.op == "annotated" and is_const(args[0]):
        return args[0]
    return node(e.op, args, e.value, e.type)


def substitute(e: Expr, mapping: dict[Expr, Expr], memo: dict[Expr, Expr] | None = None) -> Expr:
    """Replace nodes by nodes, bottom up. Pass the same `memo` to share work between calls with one mapping."""
    memo = {} if memo is None else memo
    return transform(e, lambda n: mapping.get(n), memo)


def transform(e: Expr, rule: Callable[[Expr], Expr | None], memo: dict[Expr, Expr]) -> Expr:
    """Rewrite top down: where `rule(node)` gives a node that one stands; elsewhere arguments are rewritten."""
    done = memo.get(e)
    if done is None:
        done = rule(e)
        if done is None:
            done = rebuild(e, tuple(transform(a, rule, memo) for a in e.args)) if e.args else e
        memo[e] = done
    return done


def walk(e: Expr) -> Iterator[Expr]:
    """Every distinct node below and including `e`, parents before arguments."""
    seen: set[int] = set()
    stack = [e]
    while stack:
        n = stack.pop()
        if id(n) not in seen:
            seen.add(id(n))
            yield n
            stack.extend(reversed(n.args))


_PRECEDENCE = {
    "or": 1, "and": 2, "not": 3, "<": 4, "<=": 4, ">": 4, ">=": 4, "==": 4, "<>": 4,
    "+": 5, "-": 5, "neg": 5, "*": 6, "/": 6, "^": 7,
}  # fmt: skip


LEGIBLE = 2000  # nodes of a text, what is shared counted wherever it stands: more than anybody reads


def to_text(e: Expr) -> str:
    """Modelica source of `e`; longer operands of a long text are `...`: shared nodes may make one of any length."""
    sizes: dict[Expr, int] = {}
    if _tree_size(e, sizes) > LEGIBLE:
        cut = tuple(var("...", a.type) if sizes[a] > max(20, LEGIBLE // len(e.args)) else a for a in e.args)
        e = node(e.op, cut, e.value, e.type)
    return _text(e, 0)


def _tree_size(e: Expr, sizes: dict[Expr, int]) -> int:
    found = sizes.get(e)
    if found is None:
        found = sizes[e] = 1 + sum(_tree_size(a, sizes) for a in e.args)
    return found


def _text(e: Expr, outer: int) -> str:
    if e.op == "const":
        text = str(e.value).lower() if e.type == BOOLEAN else repr(e.value)
        return f"({text})" if text.startswith("-") and outer > 4 else text
    if e.op in ("var", "unset"):
        return str(e.value)
    if e.op == "time":
        return "time"
    if e.op == "if":
        text = "if " + _text(e.args[0], 0) + " then " + _text(e.args[1], 0) + " else " + _text(e.args[2], 0)
        return f"({text})" if outer else text
    if e.op == "array":
        return "{" + ", ".join(_text(a, 0) for a in e.args) + "}"
    if e.op == "annotated":
        return _text(e.args[0], outer)
    rank = _PRECEDENCE.get(e.op)
    if rank is None:
        name = e.value if e.op == "call" else e.op
        return f"{name}(" + ", ".join(_text(a, 0) for a in e.args) + ")"
    if e.op == "neg":
        text = "-" + _text(e.args[0], 6)
    elif e.op == "not":
        text = "not " + _text(e.args[0], 4)
    else:
        left = rank + 1 if e.op in ("^", *RELATIONS) else rank
        text = _text(e.args[0], left) + f" {e.op} " + _text(e.args[1], rank + 1)
    return f"({text})" if rank < outer else text
