"""What may stand before a declaration, by the type it declares (Modelica 3.6, 4.4.2.2, 4.7, 5.4)."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten.classes.inheritance import Element
from lacuna.codegen.flatten.classes.types import Type, is_partial
from lacuna.codegen.flatten.names.context import Context
from lacuna.codegen.flatten.names.modifiers import Modifier
from lacuna.codegen.flatten.names.scope import own_or_inherited
from lacuna.codegen.symbolic.expr import REAL
from lacuna.codegen.syntax import ast

ElementsOf = Callable[[ast.Class], Mapping[str, Element]]


def check_prefixes(declaration: ast.Component, found: Type, elements: ElementsOf) -> None:
    """Raises R072 for a prefix that the type of the component does not allow."""
    name, span, cls = declaration.name, declaration.span, found.cls
    written = [declaration.variability, declaration.causality]
    written += [p for p in ("flow", "stream") if getattr(declaration, p)]
    prefixes = [p for p in written if p]
    if not prefixes:
        return
    causality = declaration.causality or found.causality
    if causality == "input" and declaration.variability in ("parameter", "constant"):
        hint = f"a {declaration.variability} is given a value by a modification; an input may vary"
        raise Diagnostic("R072", f"{name} is input and {declaration.variability}", span, hint)
    if found.primitive is not None:
        if (declaration.flow or declaration.stream) and found.primitive != REAL:
            raise Diagnostic("R072", f"{name} is {prefixes[-1]} and no Real", span, "only Reals flow")
        if declaration.causality and found.causality:
            hint = f"{declaration.type} is {found.causality} already"
            raise Diagnostic("R072", f"{name} is {declaration.causality} of what is {found.causality}", span, hint)
        return
    if cls.kind in ("model", "block"):
        hint = "prefixes are for types, records and connectors"
        raise Diagnostic("R072", f"the {cls.kind} {name} cannot be {prefixes[0]}", span, hint)
    if cls.kind == "connector" and declaration.variability in ("parameter", "constant"):
        hint = "remove the prefix, or declare a record"
        raise Diagnostic("R072", f"the connector {name} cannot be a {declaration.variability}", span, hint)
    inner = _first_prefixed(cls, bool(declaration.flow or declaration.stream), bool(declaration.causality), elements)
    if inner:
        hint = f"remove one of the two: {inner} has a prefix of its own"
        raise Diagnostic("R072", f"{name} and its element {inner} both have such a prefix", span, hint)


def _first_prefixed(cls: ast.Class, kind: bool, causal: bool, elements: ElementsOf) -> str:
    """The first element that is flow or stream (where `kind`), or input or output (where `causal`); "" if none is."""
    if cls.alias is not None and cls.alias.causality and causal:
        return cls.name
    for name, element in elements(cls).items():
        d = element.declaration
        if (kind and (d.flow or d.stream)) or (causal and d.causality):
            return name
    return ""


def check_outer(declaration: ast.Component, outside: Modifier | None) -> None:
    """Raises R076 for an outer declaration that is modified (5.4)."""
    own = declaration.modification
    if own.value is not None or own.arguments or (outside is not None and not outside.empty):
        span = outside.span if outside is not None and not outside.empty else own.span
        hint = "modify the inner one"
        raise Diagnostic("R076", f"{declaration.name} is outer and cannot be modified", span, hint)


def varies_more(declaration: ast.Component, inner: str) -> str:
    """Why an inner component of that variability cannot be meant by an outer declaration; "" where it can (5.4)."""
    wider = ("constant", "parameter", "discrete", "continuous")
    outer = declaration.variability
    wrong = outer and inner and wider.index(inner) > wider.index(outer)
    return f"it is a {outer}, the inner one is {inner}" if wrong else ""


def check_block(cls: ast.Class, declaration: ast.Component, found: Type, elements: ElementsOf) -> None:
    """Raises R070 for a connector of a block whose direction is open, and for one in a record (4.7)."""
    if cls.kind == "record" and found.primitive is not None and found.named is not None:
        _refuse_in_record(declaration, found.named)
    if cls.kind != "block" or declaration.protected or declaration.causality or declaration.outer:
        return
    kind = found.named if found.primitive is not None else found.cls
    if kind is None or kind.kind != "connector" or kind.expandable or found.causality:
        return
    held = {} if found.primitive is not None else elements(kind)
    open_ended = [
        name for name, e in held.items()
        if not e.declaration.causality and e.declaration.variability not in ("parameter", "constant")
    ]  # fmt: skip
    if found.primitive is not None or any(held[name].declaration.flow for name in open_ended):
        hint = "write a model, or connectors of inputs and outputs"
        message = f"{declaration.name} of a block is neither input nor output"
        raise Diagnostic("R070", message, declaration.span, hint)


def _refuse_in_record(declaration: ast.Component, cls: ast.Class) -> None:
    if cls.kind in ("model", "block", "connector"):
        hint = "an element of a record is of a record or a type: write a model"
        raise Diagnostic("R070", f"{declaration.name} is a {cls.kind} in a record", declaration.span, hint)


def check_component(holder: ast.Class, declaration: ast.Component, found: Type, context: Context) -> None:
    """Raises R014 or R015 for a class that no component is of: packages, functions, what is partial; R070 for models
    and connectors in a record (4.7)."""
    cls = found.cls
    if holder.kind == "record":
        _refuse_in_record(declaration, cls)
    if holder.kind == "connector" and cls.kind in ("model", "block"):
        hint = "an element of a connector is of a connector, a record or a type"
        raise Diagnostic("R070", f"{declaration.name} is a {cls.kind} in a connector (4.7)", declaration.span, hint)
    if cls.kind in ("package", "function"):
        hint = "components are of a model, block, connector, record or type"
        raise Diagnostic("R014", f"{cls.name} is a {cls.kind}, not a component class", declaration.span, hint)
    if is_partial(cls, context):
        hint = "use a class that extends it"
        if declaration.replaceable:
            hint = (
                f"redeclare it where a {holder.name} is declared: {holder.name} x(redeclare CLASS {declaration.name})"
            )
        raise Diagnostic("R015", f"{cls.name} is partial and cannot be a component", declaration.span, hint)


def check_flow_record(cls: ast.Class, span: Span, context: Context) -> None:
    """An operator record that flows has '+', '-' and '0': what connections add up (9.2). Raises R079."""
    if not (cls.operator and cls.kind == "record"):
        return
    for name in ("'+'", "'-'", "'0'"):
        if own_or_inherited(context.library, cls, name) is None:
            hint = "declare it in the operator record"
            raise Diagnostic("R079", f"{cls.name} is a flow and has no operator {name}", span, hint)
