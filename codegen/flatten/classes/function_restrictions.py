"""What a function must not hold (Modelica 3.6, 12.2), and what must not be said of what it declares."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Protocol

from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.flatten.classes.instance import Instance
from lacuna.codegen.flatten.classes.leaf import check_attributes
from lacuna.codegen.flatten.classes.prefixes import check_component
from lacuna.codegen.flatten.classes.types import EXTERNAL, Type
from lacuna.codegen.flatten.expressions.enumerations import enumeration_of
from lacuna.codegen.flatten.expressions.evaluate import evaluate_dimensions
from lacuna.codegen.flatten.expressions.lower import modifier_value
from lacuna.codegen.flatten.names.context import Context
from lacuna.codegen.flatten.names.modifiers import Modifier, from_tree, merge, refuse_each
from lacuna.codegen.flatten.names.scope import Scope
from lacuna.codegen.flatten.names.values import ChosenText, Value, items_of, shape_of, shape_text
from lacuna.codegen.symbolic.expr import BOOLEAN, INTEGER, REAL, Expr
from lacuna.codegen.syntax import ast
from lacuna.codegen.syntax.references import references

_TYPES = {  # of attributes that are not of the type of the variable, with the enumeration
    **dict.fromkeys(("unit", "displayUnit", "quantity"), ("String", "")),
    **dict.fromkeys(("fixed", "unbounded"), (BOOLEAN, "")),
    "stateSelect": (INTEGER, "StateSelect"),
}


class Declared(Protocol):
    """An input, output or protected variable of a function."""

    name: str
    declaration: ast.Component
    type: Type
    scope: Scope


def check_function(
    cls: ast.Class, sections: Sequence[ast.Section], declared: Sequence[Declared], context: Context
) -> None:  # fmt: skip
    """Raises R066 and R055 for what a function must not hold, R015, R031, R032, R035 and R038 for what must not be said
    of what it declares."""
    _check_sections(cls, sections)
    for local in declared:
        _check_prefixes(cls, local.declaration)
        _check_constant(cls, local.declaration, declared)
        _check_kind(cls, local)
        _check_modification(cls, local, {d.name for d in declared}, context)


def _check_sections(cls: ast.Class, sections: Sequence[ast.Section]) -> None:
    wrong = next((s for s in sections if s.initial or not s.algorithm), None) or next(iter(sections[1:]), None)
    if wrong is not None:
        what = "an initial section" if wrong.initial else "a second algorithm" if wrong.algorithm else "equations"
        hint = "a function has one algorithm section, or is external"
        raise Diagnostic("R066", f"the function {cls.name} has {what}", wrong.span, hint)


def _check_prefixes(cls: ast.Class, d: ast.Component) -> None:
    if not (d.causality or d.protected or d.variability == "constant"):
        hint = "declare it input or output, or under 'protected'"
        raise Diagnostic("R066", f"{d.name} of the function {cls.name} is public", d.span, hint)
    if d.causality and d.protected:
        raise Diagnostic("R066", f"the {d.causality} {d.name} of {cls.name} is protected", d.span, "make it public")
    if d.inner or d.outer:
        what = "inner" if d.inner else "outer"
        raise Diagnostic("R066", f"{what} {d.name} in the function {cls.name}", d.span, "hand it on as an input")


def _check_constant(cls: ast.Class, d: ast.Component, declared: Sequence[Declared]) -> None:
    """A constant of a function does not follow its inputs (3.8), and nothing assigns it, or a parameter (11.2.1)."""
    if d.variability != "constant" or d.modification.value is None:
        return
    varies = {x.name for x in declared if x.declaration.variability != "constant"}
    used = next((r for r in references(d.modification.value) if r.names[0] in varies), None)
    if used is not None:
        message = f"the constant {d.name} of {cls.name} depends on what varies: {used}"
        raise Diagnostic("R055", message, used.span, "declare it without 'constant'")


def check_targets(items: Iterable[ast.Item], declared: Sequence[Declared]) -> None:
    """What a body assigns are none of its constants, parameters and loop variables. Raises R058."""
    kinds = {d.name: d.declaration.variability for d in declared}
    _refuse_fixed(items, {name: f"the {kind}" for name, kind in kinds.items() if kind in ("constant", "parameter")})


def _refuse_fixed(items: Iterable[ast.Item], fixed: dict[str, str]) -> None:
    """Constants, parameters, and the variable of a loop inside it are not assigned (11.2.1, 11.2.2). Raises R058."""
    for item in items:
        if isinstance(item, ast.For):
            _refuse_fixed(item.body, fixed | {i.name: "the loop variable" for i in item.iterators})
        elif isinstance(item, ast.If | ast.When):
            for _, body in item.branches:
                _refuse_fixed(body, fixed)
        elif isinstance(item, ast.While):
            _refuse_fixed(item.body, fixed)
        elif isinstance(item, ast.Assignment):
            targets = item.target.items if isinstance(item.target, ast.Tuple) else [item.target]
            wrong = next((t for t in targets if t is not None and t.names[0] in fixed), None)
            if wrong is not None:
                hint = "copy it to a variable of the function"
                raise Diagnostic("R058", f"{fixed[wrong.names[0]]} {wrong} is assigned", wrong.span, hint)


def _check_kind(cls: ast.Class, local: Declared) -> None:
    """A function holds types, records and functions only (12.2)."""
    kind = local.type.cls.kind if local.type.primitive is None and local.type.cls is not None else "type"
    if kind in ("model", "block", "connector", "package"):
        message = f"{local.name} of the function {cls.name} is a {kind}"
        raise Diagnostic("R066", message, local.declaration.span, "a function holds types and records only")


def _check_modification(cls: ast.Class, local: Declared, names: set[str], context: Context) -> None:
    """As of a component of a model: a function is a class (12.2)."""
    declaration, found = local.declaration, local.type
    own = from_tree(declaration.modification, local.scope)
    if not (declaration.dimensions or found.dimensions):
        refuse_each(own)
    if found.primitive is not None:
        if found.primitive != EXTERNAL:
            whole = merge(own, found.modifier) or own
            check_attributes(found.primitive, declaration.name, whole)
            for name, child in whole.children.items():
                _check_attribute(local, name, child, names, of_type=name not in own.children)
        return
    if found.cls is None or found.cls.kind not in ("record", "operator record"):
        return
    check_component(cls, declaration, found, context)
    if own.children:
        record = Instance(context, found.cls, declaration.name, None, merge(own, found.modifier))
        for name, child in own.children.items():
            element = record.elements[name]
            merge(child, from_tree(element.declaration.modification, Scope(context, element.cls)))
            if element.declaration.final:
                hint = "remove the modification"
                raise Diagnostic("R031", f"{name} of {found.cls.name} is final", child.span, hint)


def _check_attribute(local: Declared, name: str, said: Modifier, names: set[str], of_type: bool) -> None:
    """An attribute has the type that it is of (4.9), and its size. One that follows variables of the function is not
    looked at."""
    if not isinstance(said.value, ast.Expression) or any(r.names[0] in names for r in references(said.value)):
        return
    value = modifier_value(said)
    _check_size(local, name, said, value, set() if of_type else names, [] if of_type else local.declaration.dimensions)
    own = (local.type.cls.origin or local.type.cls).path if local.type.literals else ""
    wanted, kind = _TYPES.get(name, (local.type.primitive, own))
    for item in items_of(value):
        found = item.type if isinstance(item, Expr | ChosenText) else "String" if isinstance(item, str) else "a record"
        of = enumeration_of(item, said.scope.context) if isinstance(item, Expr) else ""
        if (found != wanted and (wanted, found) != (REAL, INTEGER)) or of not in (None, kind):
            given, needed = (k.rpartition(".")[2] or t for k, t in ((of, found), (kind, wanted)))
            message = f"{name} of {local.name} is {needed}, its value {given}"
            raise Diagnostic("R024", message, said.span, f"give a {needed}")


def _check_size(
    local: Declared, name: str, said: Modifier, value: Value, names: set[str], dimensions: list[ast.Expression]
) -> None:
    """An attribute has the size of the variable, as far as that is known; beside `each` that of its type (7.2.5).
    Raises R036."""
    sized = [None if _follows(d, names) else d for d in dimensions]
    known = [d and evaluate_dimensions([d], local.scope, None, local.name)[0] for d in sized]
    own, given = local.type.dimensions, shape_of(value)
    wanted = [*known, *own]
    if given and not (own or local.declaration.dimensions):
        message = f"{name} of the scalar {local.name} has size {shape_text(given)}"
        raise Diagnostic("R036", message, said.span, "give one value")
    sizes = next((s for s in ((wanted, own, []) if said.each else (wanted,)) if len(s) == len(given)), None)
    if sizes is None or any(n is not None and n != m for n, m in zip(sizes, given, strict=True)):
        size = ", ".join(":" if n is None else str(n) for n in wanted)
        hint = "both need the same size" if given else f"write each {name} = ..."
        message = f"{local.name} has size [{size}], {name} {shape_text(given) if given else 'a scalar'}"
        raise Diagnostic("R036", message, said.span, hint)


def _follows(dimension: ast.Expression, names: set[str]) -> bool:
    """Whether a size follows a value, or variables of the function."""
    return isinstance(dimension, ast.Colon) or any(r.names[0] in names for r in references(dimension))
