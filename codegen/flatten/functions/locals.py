"""What a function declares: inputs, outputs, protected variables, and what fits them."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import cached_property

from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten.classes.inheritance import inheriting, refuse_redeclaration
from lacuna.codegen.flatten.classes.instance import Instance
from lacuna.codegen.flatten.classes.types import EXTERNAL, Type, causality_of, resolve_type
from lacuna.codegen.flatten.expressions.enumerations import enumeration_of
from lacuna.codegen.flatten.expressions.evaluate import evaluate_dimensions
from lacuna.codegen.flatten.names.context import Context
from lacuna.codegen.flatten.names.modifiers import from_tree, merge
from lacuna.codegen.flatten.names.scope import Scope
from lacuna.codegen.flatten.names.values import (
    Array,
    ExternalValue,
    Record,
    Value,
    holds_records,
    items_of,
    scalars,
    shape_of,
    shape_text,
)
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.expr import INTEGER, REAL, Expr
from lacuna.codegen.syntax import ast
from lacuna.units import parse_unit


@dataclass
class Local:
    """A declared input, output or protected variable of a function."""

    name: str
    declaration: ast.Component
    type: Type
    scope: Scope  # of the class it is declared in
    modified_in: ast.Class | None = None  # the class whose extends clause gives the default

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
        """The declared unit, "" where there is none. Raises U005 for what is no unit."""
        own = from_tree(self.declaration.modification, self.scope)
        child = (merge(own, self.type.modifier) or own).children.get("unit")
        if child is None:
            return ""
        text = child.value.value if isinstance(child.value, ast.Literal) else None
        try:
            if not isinstance(text, str):
                raise ValueError("the unit is not a String")
            parse_unit(text)
        except ValueError as reason:
            raise Diagnostic("U005", f"{self.name}: {reason}", child.span, 'such as "N.m.s/rad"') from None
        return text


@dataclass(frozen=True, eq=False)
class Signature:
    """A function (or record) with everything it declares and does, inherited first."""

    cls: ast.Class
    locals: tuple[Local, ...]
    body: tuple[ast.Item, ...]
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
            scope = Scope(context, element.cls, in_function=True)
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
            declared.append(Local(name, declaration, found_type, scope, modified_in))
        if cls.kind == "function":
            _check_function(cls, instance, declared)
            _check_components(cls, declared)
        body = tuple(item for section, _ in instance.sections for item in section.items)
        _check_iterators(body)
        external = next((c for c in instance.classes if c.external is not None), None)
        found = signatures[id(cls)] = Signature(cls, tuple(declared), body, external)
    return found


def _check_function(cls: ast.Class, instance: Instance, declared: list[Local]) -> None:
    """What a function must not hold (Modelica 3.6, 12.2)."""
    sections = [section for section, _ in instance.sections]
    wrong = next((s for s in sections if s.initial or not s.algorithm), None) or next(iter(sections[1:]), None)
    if wrong is not None:
        what = "an initial section" if wrong.initial else "a second algorithm" if wrong.algorithm else "equations"
        hint = "a function has one algorithm section, or is external"
        raise Diagnostic("R066", f"the function {cls.name} has {what}", wrong.span, hint)
    for name, d in ((local.name, local.declaration) for local in declared):
        if not (d.causality or d.protected or d.variability):
            hint = "declare it input or output, or under 'protected'"
            raise Diagnostic("R066", f"{name} of the function {cls.name} is public", d.span, hint)
        if d.causality and d.protected:
            raise Diagnostic("R066", f"the {d.causality} {name} of {cls.name} is protected", d.span, "make it public")


def _check_iterators(items: Iterable[ast.Item], iterators: frozenset[str] = frozenset()) -> None:
    """The variable of a loop is not assigned inside it (11.2.2). Raises R058."""
    for item in items:
        if isinstance(item, ast.For):
            _check_iterators(item.body, iterators | {i.name for i in item.iterators})
        elif isinstance(item, ast.If | ast.When):
            for _, body in item.branches:
                _check_iterators(body, iterators)
        elif isinstance(item, ast.While):
            _check_iterators(item.body, iterators)
        elif isinstance(item, ast.Assignment):
            targets = item.target.items if isinstance(item.target, ast.Tuple) else [item.target]
            wrong = next((t for t in targets if t is not None and t.names[0] in iterators), None)
            if wrong is not None:
                hint = "copy it to a variable of the function"
                raise Diagnostic("R058", f"the loop variable {wrong} is assigned", wrong.span, hint)


def _check_components(cls: ast.Class, declared: list[Local]) -> None:
    """A function holds types, records and functions only (12.2)."""
    for local in declared:
        kind = local.type.cls.kind if local.type.primitive is None and local.type.cls is not None else "type"
        if kind in ("model", "block", "connector", "package"):
            message = f"{local.name} of the function {cls.name} is a {kind}"
            raise Diagnostic("R066", message, local.declaration.span, "a function holds types and records only")


def fit(local: Local, value: Value, scope: Scope, span: Span) -> Value:
    """`value` for a declared variable: type and size checked, whole numbers made Real where that is declared."""
    if local.type.primitive == EXTERNAL:
        if not isinstance(value, ExternalValue) or value.cls is not local.type.cls:
            raise Diagnostic("R062", f"{local.name} is an external object", span, f"give a {local.declaration.type}")
        return value
    if local.type.primitive is None:
        return _fit_records(local, value, scope, span)
    sizes = declared_sizes(local, scope, value)
    if sizes != shape_of(value) or isinstance(value, Record):
        message = f"{local.name} has size {shape_text(sizes)}, given {shape_text(shape_of(value))}"
        each = f"for each element: {{f({local.name}) for {local.name} in array}}"
        raise Diagnostic("R062", message, span, "both need the same size" if sizes else each)
    items = [typed(item, local.type.primitive, local.name, span) for item in scalars(value)]
    _require_enumeration(local, scalars(value), scope, span)
    return Array(sizes, tuple(items)) if isinstance(value, Array) else items[0]


def _require_enumeration(local: Local, items: list[Expr | str], scope: Scope, span: Span) -> None:
    """Raises R025 for a value of one enumeration where a number or another is declared."""
    cls = local.type.cls
    wanted = (cls.origin or cls).path if local.type.literals and cls is not None else ""
    for item in items:
        found = enumeration_of(item, scope.context) if isinstance(item, Expr) else ""
        if found and found != wanted:
            names = [name.rsplit(".", 1)[-1] or local.type.primitive for name in (wanted, found)]
            hint = f"give a {names[0]}; Integer(e) is the number of a literal"
            raise Diagnostic("R025", f"{local.name} is {names[0]}, given {names[1]}", span, hint)


def conform(old: Value, value: Value, span: Span, name: str, kind: str | None) -> Value:
    """`value` for a variable of type `kind` (None: a record) that held `old`: the same size, and a type that fits."""
    if shape_of(old) != shape_of(value) or holds_records(old) != holds_records(value):
        message = f"{name} has size {shape_text(shape_of(old))}, given {shape_text(shape_of(value))}"
        raise Diagnostic("R042", message, span, "both need the same size")
    if kind is None or holds_records(old):
        return value
    items = [typed(item, kind, name, span) for item in scalars(value)]
    return Array(old.shape, tuple(items)) if isinstance(old, Array) else items[0]


def _fit_records(local: Local, value: Value, scope: Scope, span: Span) -> Value:
    """A record, or an array of records, with the fields that are declared; the result is of the declared class."""
    sizes = declared_sizes(local, scope, value)
    if sizes != shape_of(value) or not all(isinstance(i, Record) for i in items_of(value)):
        what = "a record" if not sizes else f"an array {shape_text(sizes)} of records"
        raise Diagnostic("R062", f"{local.name} is {what}", span, f"give a {local.declaration.type}")
    return value


def declared_sizes(local: Local, scope: Scope, value: Value | None) -> tuple[int, ...]:
    """The size of a declared variable; `:` takes that of `value`, which a size may ask for: `A[:, size(A, 1)]`."""
    sizes = []
    if value is not None and local.declaration.dimensions:
        scope = scope.with_locals(**{local.name: value})
    for position, dimension in enumerate(local.declaration.dimensions):
        if isinstance(dimension, ast.Colon):
            shape = shape_of(value) if value is not None else ()
            if position >= len(shape):
                message = f"{local.name} needs an array of {len(local.declaration.dimensions)} dimensions"
                raise Diagnostic("R062", message, dimension.span, "give a size, or an array")
            sizes.append(shape[position])
        else:
            sizes += evaluate_dimensions([dimension], scope, None, local.name)
    return (*sizes, *local.type.dimensions)


def typed(item: Expr | str, kind: str, name: str, span: Span) -> Expr | str:
    """`item` as a value of type `kind`. Raises R062."""
    found = "String" if isinstance(item, str) else item.type
    if found != kind and (kind, found) != (REAL, INTEGER):
        raise Diagnostic("R062", f"{name} is {kind}, given {found}", span, f"give a {kind}")
    if kind == REAL and not isinstance(item, str) and item.op == "const" and item.type == INTEGER:
        return ex.const(float(item.value))
    return item
