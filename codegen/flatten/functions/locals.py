"""What a function declares: inputs, outputs, protected variables, and what fits them."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.flatten.classes.function_restrictions import check_function, check_targets
from lacuna.codegen.flatten.classes.inheritance import inheriting, refuse_redeclaration
from lacuna.codegen.flatten.classes.instance import Instance
from lacuna.codegen.flatten.classes.types import Type, causality_of, resolve_type
from lacuna.codegen.flatten.expressions.enumerations import IndexType, index_type
from lacuna.codegen.flatten.names.context import Context
from lacuna.codegen.flatten.names.modifiers import Modifier, from_tree, merge
from lacuna.codegen.flatten.names.scope import Scope, find_class
from lacuna.codegen.flatten.names.values import (
    Array,
    Value,
)
from lacuna.codegen.flatten.references.written import check_names, is_record
from lacuna.codegen.syntax import ast
from lacuna.codegen.syntax.references import references
from lacuna.units import UnknownSymbol, parse_unit


@dataclass
class Local:
    """A declared input, output or protected variable of a function."""

    name: str
    declaration: ast.Component
    type: Type
    scope: Scope  # of the class it is declared in
    modified_in: ast.Class | None = None  # the class whose extends clause gives the default
    outer: Modifier | None = None  # what an extends clause says of it

    def around_default(self, scope: Scope) -> Scope:
        """`scope` for the default: a modification's names are looked up where it is written (7.2)."""
        return scope if self.modified_in is None else replace(scope, cls=self.modified_in)

    @property
    def is_flexible(self) -> bool:
        """A vector that is no input, declared with `:`: empty at first, then of the size of what is assigned."""
        dimensions = self.declaration.dimensions
        return self.declaration.causality != "input" and len(dimensions) == 1 and isinstance(dimensions[0], ast.Colon)

    @property
    def nothing(self) -> Value | None:
        """What a flexible vector holds before anything is assigned."""
        return Array((0,), ()) if self.is_flexible else None

    @cached_property
    def unit(self) -> str:
        """The declared unit, "" where there is none that is known. Raises U005 for what is no unit."""
        own = from_tree(self.declaration.modification, self.scope)
        child = (merge(self.outer, merge(own, self.type.modifier)) or own).children.get("unit")
        if child is None:
            return ""
        text = child.value.value if isinstance(child.value, ast.Literal) else None
        try:
            if not isinstance(text, str):
                raise ValueError("the unit is not a String")
            parse_unit(text)
        except UnknownSymbol:
            return ""
        except ValueError as reason:
            raise Diagnostic("U005", f"{self.name}: {reason}", child.span, 'such as "N.m.s/rad"') from None
        return text


@dataclass(frozen=True, eq=False)
class Signature:
    """A function (or record) with everything it declares and does, inherited first."""

    cls: ast.Class
    locals: tuple[Local, ...]
    body: tuple[ast.Item, ...]
    written_in: ast.Class  # the class, itself or a base, whose text the body is: its names are looked up there (5.6)
    external: ast.Class | None = None  # the class, itself or a base, that names external code

    @property
    def inputs(self) -> list[Local]:
        return [d for d in self.locals if d.declaration.causality == "input"]

    @cached_property
    def sizing(self) -> frozenset[str]:
        """Inputs whose values (not sizes) decide the sizes of what is declared."""
        names = {i.name for i in self.inputs}
        used: set[str] = set()
        for local in self.locals:
            for dimension in local.declaration.dimensions:
                used |= _values_in(dimension)
        for local in self.locals:  # through protected constants, such as n = 2*m
            if local.name in used and local.declaration.modification.value is not None:
                used |= _values_in(local.declaration.modification.value)
        return frozenset(used & names)

    @cached_property
    def makes_events(self) -> bool:
        """annotation(GenerateEvents = true): relations of the function are as those of the model (12.8.3, 18.3)."""
        cls = self.cls
        arguments = cls.annotation.arguments if cls.annotation else ()
        said = {a.name: a.modification.value for a in arguments if a.name in ("GenerateEvents", "Inline")}
        said = {name: v.value for name, v in said.items() if isinstance(v, ast.Literal)}
        if said.get("GenerateEvents") is True and said.get("Inline") is False:
            hint = "remove one of them"
            message = f"{cls.name} has GenerateEvents = true and Inline = false (12.8.3)"
            raise Diagnostic("R066", message, cls.span, hint)
        return said.get("GenerateEvents") is True

    @cached_property
    def in_order(self) -> list[Local]:
        """Everything declared, each after what its value and its sizes use, in order of declaration else (12.4.4)."""
        used = {d.name: self._uses(d) for d in self.locals}
        waiting, order = list(self.locals), []
        while waiting:
            open_ended = {d.name for d in waiting}
            ready = next((d for d in waiting if not used[d.name] & open_ended), None)
            if ready is None:
                names = ", ".join(d.name for d in waiting)
                span = waiting[0].declaration.span
                raise Diagnostic("F022", f"the values of {names} depend on each other", span, "break the circle")
            waiting.remove(ready)
            order.append(ready)
        return order

    def _uses(self, local: Local) -> set[str]:
        """Names of what else is declared here that the value or the sizes of `local`, no input, are made of."""
        if local.declaration.causality == "input":
            return set()
        parts = [local.declaration.modification.value, *local.declaration.dimensions]
        return {r.names[0] for r in references(parts)} & {d.name for d in self.locals} - {local.name}

    @cached_property
    def index_types(self) -> dict[str, tuple[IndexType, ...]]:
        """Of the dimensions of each array: what their subscripts are of (10.5)."""
        declared = {d.name: [index_type(size, d.scope) for size in d.declaration.dimensions] for d in self.locals}
        return {d.name: (*declared[d.name], *(None for _ in d.type.dimensions)) for d in self.locals}

    def scope_of(self, values: dict[str, Value], context: Context) -> Scope:
        """That of the body, with the values of variables."""
        return Scope(
            context, self.written_in, None, values, index_types=self.index_types, in_function=True,
            pure=not self.cls.impure,
        )  # fmt: skip

    @property
    def outputs(self) -> list[Local]:
        return [d for d in self.locals if d.declaration.causality == "output"]


def _values_in(e: ast.Expression) -> set[str]:
    """Names that an expression reads the values of, those inside size(...) left out."""
    if isinstance(e, ast.Call) and str(e.function) == "size":
        return set().union(*map(_values_in, e.args[1:]))
    if isinstance(e, ast.Ref):
        return {e.names[0]}
    parts = [*e.args, *e.named.values()] if isinstance(e, ast.Call) else []
    if isinstance(e, ast.Binary):
        parts = [e.left, e.right]
    elif isinstance(e, ast.Unary):
        parts = [e.operand]
    elif isinstance(e, ast.IfExpression):
        parts = [e.otherwise, *(p for branch in e.branches for p in branch)]
    return set().union(*map(_values_in, parts))


class _Signatures(dict[int, Signature]):
    """Of the functions and records called so far, by id of the class."""


def signature_of(cls: ast.Class, context: Context) -> Signature:
    """What `cls` declares; a modification in an extends clause or a short definition replaces a default."""
    signatures = context.table(_Signatures)
    found = signatures.get(id(cls))
    if found is None:
        instance = Instance(context, cls, cls.path, None, None)
        declared = []
        for name, element in instance.elements.items():
            scope = Scope(context, element.cls, in_function=True, pure=not cls.impure)
            declaration, outer, modified_in = element.declaration, element.modifier, None
            if outer is not None and isinstance(outer.redeclare, ast.Component):
                refuse_redeclaration(outer.redeclare, declaration, outer.span)
                declaration, scope = inheriting(outer.redeclare, declaration), outer.redeclared_in or scope
            if outer is not None and isinstance(outer.value, ast.Expression):
                changed = replace(declaration.modification, value=outer.value)
                declaration = replace(declaration, modification=changed)
                modified_in = outer.scope.cls if outer.scope is not None else None
            found_type = resolve_type(declaration.type, scope)
            if cls.kind == "function" and not declaration.causality:
                causality = found_type.causality or causality_of(found_type.cls, context)
                declaration = replace(declaration, causality=causality)
            declared.append(Local(name, declaration, found_type, scope, modified_in, outer))
        if cls.kind == "function":
            check_function(cls, [section for section, _ in instance.sections], declared, context)
        body = tuple(item for section, _ in instance.sections for item in section.items)
        check_targets(body, declared if cls.kind == "function" else [])
        external = next((c for c in instance.classes if c.external is not None), None)
        written_in = next((c for section, c in instance.sections if section.items), cls)
        held = {d.name: d.type.cls if is_record(d.type.cls) else None for d in declared}
        check_names(body, Scope(context, written_in, in_function=True), held)
        found = signatures[id(cls)] = Signature(cls, tuple(declared), body, written_in, external)
    return found


def differentiated(cls: ast.Class, context: Context) -> ast.Class:
    """The function that `function f = der(g, x, ...)` is a partial derivative of (12.7.2). Raises R004."""
    reference, _ = cls.derivative_of
    found = find_class(context.library, cls.parent or context.library.root, reference)
    if found is None or found.kind != "function":
        raise Diagnostic("R004", f"there is no function {reference}", reference.span, "name a function")
    return found


def inputs_of(cls: ast.Class, context: Context) -> list[Local]:
    """The inputs of a function; a partial derivative has those of what it is one of (12.7.2)."""
    return signature_of(differentiated(cls, context) if cls.derivative_of else cls, context).inputs
