"""Functions whose derivative in time the model gives: annotation(derivative(order, noDerivative, zeroDerivative) = df).

The annotation is looked at where a function is called with what varies (Modelica 3.6, 12.7.1). The call's values are
what they are without it, marked with the rules for their derivatives (`symbolic/annotated.py`); a rule is a call of df
with something standing for each argument and each derivative.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace

from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.flatten.expressions.constants import is_parameter
from lacuna.codegen.flatten.functions.locals import Signature, signature_of
from lacuna.codegen.flatten.names.annotations import warn_of_slips
from lacuna.codegen.flatten.names.context import Context
from lacuna.codegen.flatten.names.scope import find_class
from lacuna.codegen.flatten.names.values import (
    Array,
    ExternalValue,
    FunctionValue,
    Record,
    Value,
    items_of,
    scalars,
    shape_of,
    with_scalars,
)
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.annotated import DerivativeRule, annotated
from lacuna.codegen.symbolic.expr import REAL, ZERO, Expr
from lacuna.codegen.symbolic.leaves import LEAF_OPS, leaves
from lacuna.codegen.syntax import ast

Call = Callable[[Signature, dict[str, Value]], list[Value]]  # the results of a function, no annotation looked at


@dataclass(frozen=True)
class _Annotation:
    """One entry derivative(...) = df of a function's annotation."""

    span: ast.Span
    function: Signature
    order: int
    without: frozenset[str]  # inputs of which no derivative is handed on
    still: frozenset[str]  # those of them that must not move


@dataclass(frozen=True)
class _Level:
    """Of a function that is the derivative of order `order`: its last inputs, which are derivatives of that order, and
    pairs (argument, argument that is its derivative) by their positions among what varies."""

    order: int = 0
    last: tuple[str, ...] = ()
    chain: tuple[tuple[int, int], ...] = ()


@dataclass
class _Known:
    """Keys of the rules made so far, and what stands for arguments in them."""

    keys: dict[tuple[object, ...], str] = field(default_factory=dict)
    placeholders: set[Expr] = field(default_factory=set)


def with_derivatives(
    signature: Signature, arguments: dict[str, Value], results: list[Value], context: Context, call: Call,
    level: _Level = _Level(),
) -> list[Value]:  # fmt: skip
    """The results of a call, marked with the derivatives that annotations give. Raises R004 and R050 for an annotation
    that does not fit its function."""
    annotations = _annotations(signature, context)
    if not annotations or not _concerned(annotations, arguments, context):
        return results
    key = _key(signature, arguments, level, context)
    known = context.table(_Known)
    base = known.keys.get(key)
    if base is None:
        base = known.keys[key] = f"{signature.cls.path}:{len(known.keys) + 1}"
        for annotation in (_by_its_inputs(a, signature, arguments, level) for a in annotations):
            _add_rule(annotation, signature, arguments, results, base, level, context, call)
    unheard = {
        n for a in annotations for name in a.without - a.still for s in scalars(arguments[name]) for n in leaves(s)
    }
    varying = [s for v in arguments.values() for s in scalars(v) if _varies(s)]

    def marked(number: int, s: Expr | str) -> Expr | str:
        rule = f"{base}.{number}"
        itself = unheard and isinstance(s, Expr) and s.op in LEAF_OPS and s not in unheard  # whose derivative is known
        return s if itself or rule not in context.derivatives else annotated(s, varying, rule)

    numbered = iter([marked(k, s) for k, s in enumerate(s for r in results for s in scalars(r))])
    return [with_scalars(r, numbered) for r in results]


def _concerned(annotations: Sequence[_Annotation], arguments: dict[str, Value], context: Context) -> bool:
    """Whether an annotation can say more of this call than the function's body. It cannot where what it leaves out does
    not move; and variables of functions that run at run time are not differentiated by time."""
    if any(isinstance(v, FunctionValue | ExternalValue) for v in arguments.values()):
        return False
    items = [s for v in arguments.values() for s in scalars(v)]
    if not all(isinstance(s, Expr | str) for s in items):
        return False
    varying = [s for s in items if _varies(s)]
    placeholders = context.table(_Known).placeholders
    names = {n for s in varying for n in leaves(s) if n.op == "var"} - placeholders
    if any(str(n.value) not in context.scalars for n in names) or all(is_parameter(s, context) for s in varying):
        return False
    left_out = [s for a in annotations for n in a.without - a.still for s in scalars(arguments[n]) if _varies(s)]
    return any(a.without == a.still for a in annotations) or not all(is_parameter(s, context) for s in left_out)


def _varies(s: Expr | str) -> bool:
    return isinstance(s, Expr) and s.op != "const"


def _key(signature: Signature, arguments: dict[str, Value], level: _Level, context: Context) -> tuple[object, ...]:
    """Calls of equal keys have equal rules: constants are part of them."""
    items = [None if _varies(s) else s for v in arguments.values() for s in scalars(v)]
    shapes = [shape_of(item) for v in arguments.values() for item in (v, *items_of(v))]
    return id(signature), tuple(items), tuple(shapes), level


def _annotations(signature: Signature, context: Context) -> list[_Annotation]:
    cls = signature.cls
    warn_of_slips(cls.annotation, ("derivative", "GenerateEvents"), context)
    entries = cls.annotation.arguments if cls.annotation is not None else ()
    return [_annotation(a, signature, context) for a in entries if a.name == "derivative"]


def _annotation(entry: ast.Argument, signature: Signature, context: Context) -> _Annotation:
    cls, order, excluded = signature.cls, 1, {"noDerivative": set(), "zeroDerivative": set()}
    inputs = {i.name for i in signature.inputs}
    for option in entry.modification.arguments:
        value = option.modification.value
        whole = isinstance(value, ast.Literal) and type(value.value) is int
        if option.name == "order" and whole and value.value >= 1:
            order = value.value
        elif option.name in excluded and isinstance(value, ast.Ref) and str(value) in inputs:
            excluded[option.name].add(str(value))
        else:
            hint = f"order = 2, noDerivative or zeroDerivative = one of {', '.join(inputs)}"
            raise Diagnostic("R050", f"{option.name} of the derivative of {cls.name}", option.span, hint)
    ref = entry.modification.value
    found = find_class(context.library, cls, ref) if isinstance(ref, ast.Ref) else None
    if found is None or found.kind != "function":
        raise Diagnostic("R004", f"there is no function {ref}", entry.span, f"name the derivative of {cls.name}")
    without = frozenset(excluded["noDerivative"] | excluded["zeroDerivative"])
    still = frozenset(excluded["zeroDerivative"])
    return _Annotation(entry.span, signature_of(found, context), order, without, still)


def _by_its_inputs(
    annotation: _Annotation, signature: Signature, arguments: dict[str, Value], level: _Level
) -> _Annotation:
    """The annotation with the order that the inputs of its function have: some write none on a second derivative."""
    moving = [n for n, v in arguments.items() if n not in annotation.without and _real([v])]
    more = len(annotation.function.inputs) - len(signature.inputs)
    next_one = annotation.order == 1 and level.order and more == len(level.last) != len(moving)
    return replace(annotation, order=level.order + 1) if next_one else annotation


def _add_rule(
    annotation: _Annotation, signature: Signature, arguments: dict[str, Value], results: list[Value], base: str,
    level: _Level, context: Context, call: Call,
) -> None:  # fmt: skip
    """Note the rule of one annotation for each Real scalar of the results. One of an order that this call does not have
    says nothing of it."""
    if annotation.order not in (1, level.order + 1) or (annotation.order > 1 and not level.order):
        return
    items = [s for v in arguments.values() for s in scalars(v)]
    stands = [ex.var(f"{base}({k})", s.type) if _varies(s) else s for k, s in enumerate(items)]
    rates = [_rate_of(s, f"{base}'({k})") for k, s in enumerate(items)]
    context.table(_Known).placeholders.update(s for s in (*stands, *rates) if isinstance(s, Expr))
    each, rate = iter(stands), iter(rates)
    given = {n: with_scalars(v, each) for n, v in arguments.items()}
    moving = {i.name: _rates(arguments[i.name], rate, i.type.primitive == REAL) for i in signature.inputs}
    wanted = level.last if annotation.order > 1 else [n for n in arguments if n not in annotation.without]
    derivatives = [moving[n] for n in wanted if moving[n] is not None]
    taken = dict(zip(_inputs(annotation, signature, len(derivatives)), [*given.values(), *derivatives], strict=True))
    used = {r for d in derivatives for r in scalars(d)}
    varying = [k for k, s in enumerate(items) if _varies(s)]
    asked = [rates[k] if rates[k] in used else None for k in varying]
    try:
        found = call(annotation.function, taken)
        own = _level(annotation, signature, asked, level)
        found = with_derivatives(annotation.function, taken, found, context, call, own)
        values: Sequence[Expr | Diagnostic] = _real(found)
    except Diagnostic as error:
        values = [error] * len(_real(results))
    owners = [n for n, v in arguments.items() for s in scalars(v) if _varies(s)]
    still = tuple(k for k, n in enumerate(owners) if n in annotation.still)
    chain = level.chain if annotation.order > 1 else ()
    numbers = [
        k for k, s in enumerate(s for r in results for s in scalars(r)) if isinstance(s, Expr) and s.type == REAL
    ]
    if len(values) != len(numbers):
        message = f"{annotation.function.cls.name} gives {len(values)} derivatives of {len(numbers)} Reals"
        raise Diagnostic("R050", f"{message} of {signature.cls.name}", annotation.span, "one for each Real result")
    parameters = tuple(stands[k] for k in varying)
    for number, value in zip(numbers, values, strict=True):
        rule = DerivativeRule(parameters, tuple(asked), still, chain, value)
        context.derivatives.setdefault(f"{base}.{number}", []).append(rule)


def _level(annotation: _Annotation, signature: Signature, asked: list[Expr | None], level: _Level) -> _Level:
    """What the derivative function is, called by the rule: its derivatives stand behind the arguments."""
    behind = [k for k, r in enumerate(asked) if r is not None]
    pairs = tuple((k, len(asked) + position) for position, k in enumerate(behind))
    last = tuple(i.name for i in annotation.function.inputs[len(signature.inputs) :])
    return _Level(annotation.order, last, (level.chain if annotation.order > 1 else ()) + pairs)


def _inputs(annotation: _Annotation, signature: Signature, derivatives: int) -> list[str]:
    """Names of the inputs of the derivative function: those of the function, then the derivatives. Raises R050."""
    names, wanted = [i.name for i in annotation.function.inputs], len(signature.inputs) + derivatives
    if len(names) != wanted:
        message = f"the derivative {annotation.function.cls.name} of {signature.cls.name} has {len(names)} inputs"
        hint = f"those of {signature.cls.name}, then the derivatives of its Reals: {wanted}"
        raise Diagnostic("R050", message, annotation.span, hint)
    return names


def _rate_of(s: Expr | str, name: str) -> Expr | None:
    if not isinstance(s, Expr) or s.type != REAL:
        return None
    return ex.var(name) if _varies(s) else ZERO


def _rates(value: Value, rate: Iterator[Expr | None], real: bool) -> Value | None:
    """The derivatives of the Reals in `value`; None where there are none."""
    if isinstance(value, Record):
        fields = {n: _rates(v, rate, False) for n, v in value.fields.items()}
        moving = {n: v for n, v in fields.items() if v is not None}
        return Record(value.name, moving, value.cls) if moving else None
    if isinstance(value, Array):
        items = tuple(_rates(i, rate, real) for i in value.items)
        return Array(value.shape, items) if (items or real) and None not in items else None
    return next(rate)


def _real(results: list[Value]) -> list[Expr]:
    return [s for r in results for s in scalars(r) if isinstance(s, Expr) and s.type == REAL]
