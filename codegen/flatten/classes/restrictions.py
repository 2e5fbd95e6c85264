"""What the specification forbids a class to declare: specialised classes, inheritance, prefixes, names (Modelica 3.6).

Each class is looked at once, when a model first uses it; what no model uses is not judged.
"""

from __future__ import annotations

from collections.abc import Iterator

from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten.classes.imports import check_imports
from lacuna.codegen.flatten.names.context import Context
from lacuna.codegen.flatten.names.scope import (
    base_class,
    base_classes,
    base_clauses,
    find_first,
    own_or_inherited,
)
from lacuna.codegen.library.predefined import PRIMITIVES
from lacuna.codegen.syntax import ast
from lacuna.codegen.syntax.alike import alike

# What each kind of class may extend besides `class` (7.1.3).
MAY_EXTEND = {
    "package": ("package",),
    "operator": ("operator",),
    "function": ("function",),
    "type": ("type",),
    "record": ("record",),
    "connector": ("type", "record", "connector"),
    "block": ("record", "block"),
    "model": ("record", "block", "model"),
    "class": ("package", "operator", "function", "type", "record", "connector", "block", "model"),
}
OPERATORS = (
    "'constructor'", "'0'", "'String'", "'+'", "'-'", "'*'", "'/'", "'^'", "'=='", "'<>'", "'<'", "'<='", "'>'", "'>='",
    "'and'", "'or'", "'not'",
)  # fmt: skip  # 14.1
_ATTRIBUTES_OF_ENUMERATIONS = ("quantity", "min", "max", "start", "fixed")  # 4.9.5
_WITHOUT_SECTIONS = ("connector", "record", "package", "type")
_ALL_PUBLIC = ("connector", "record")


class _Checked(set[int]):
    """Classes looked at, by identity."""


class _Held(set[int]):
    """Classes and packages whose contents were looked at, by identity."""


def check_class(cls: ast.Class, context: Context) -> None:
    """Raises R070 (contents of a specialised class), R071 (what it extends), R074 (names), or what imports raise."""
    checked, origin = context.table(_Checked), cls.origin or cls
    if id(origin) in checked:
        return
    checked.add(id(origin))
    for cls_or_package in _around(origin, context.table(_Held)):
        for finding in _findings(cls_or_package):
            raise finding
    check_imports(origin, context.library)
    _check_bases(cls, context)


def _around(cls: ast.Class, seen: _Held) -> Iterator[ast.Class]:
    """The class, and the packages that it stands in, as far as their contents were not looked at."""
    around: ast.Class | None = cls
    while around is not None and id(around) not in seen:
        seen.add(id(around))
        yield around
        around = around.parent if around.parent is not None and around.parent.kind == "package" else None


def _findings(cls: ast.Class) -> Iterator[Diagnostic]:
    yield from _names(cls)
    yield from _sections(cls)
    for component in cls.components:
        yield from _component(cls, component)
    if cls.kind == "operator":
        yield from _operator(cls)
    for nested in cls.classes.values():
        operator = nested.kind == "operator" or (nested.operator and nested.kind == "function")
        if operator and cls.kind != "package" and not (cls.operator and cls.kind == "record"):
            hint = "declare it in an operator record"
            yield Diagnostic("R070", f"the operator {nested.name} in a {cls.kind}", nested.span, hint)
        elif operator and cls.kind == "record" and nested.name not in OPERATORS:
            hint = f"an operator is one of {', '.join(OPERATORS)}"
            yield Diagnostic("R070", f"there is no operator {nested.name} to declare (14.1)", nested.span, hint)
        elif operator and cls.kind == "record" and not nested.encapsulated:
            hint = "write encapsulated before it, and import what it uses"
            yield Diagnostic("R070", f"the operator {nested.name} is not encapsulated (14.2)", nested.span, hint)


def _names(cls: ast.Class) -> Iterator[Diagnostic]:
    for span, name in _declared(cls):
        if name in PRIMITIVES:
            yield Diagnostic(
                "R074", f"{name} is the name of a predefined type", span, f"rename it, for example my{name}"
            )
    if cls.alias is not None and cls.alias.causality and cls.kind in ("model", "block", "function", "package"):
        hint = "prefixes are for types, records and connectors"
        yield Diagnostic("R072", f"the {cls.kind} {cls.name} cannot be {cls.alias.causality}", cls.alias.span, hint)
    named = {component.name for component in cls.components}
    for component in cls.components:
        if component.name in cls.classes:
            hint = "rename one of them"
            both = sorted((component.span, cls.classes[component.name].span), key=lambda s: s.line)
            yield Diagnostic("R010", f"{component.name} is declared as a class, too", both[1], hint)
        if component.name == "time" and cls.kind in ("model", "block", "class"):
            hint = "choose another name"
            yield Diagnostic("R074", "time is the time, in models and blocks", component.span, hint)
        first = component.type.names[0]
        if first in named and not component.type.absolute:
            hint = f"rename the component {first}, or write .{component.type}"
            message = f"{first} is a component here, which hides the class of that name"
            yield Diagnostic("R074", message, component.span, hint)
    seen: set[str] = set()
    for literal, _ in cls.literals or ():
        if literal in _ATTRIBUTES_OF_ENUMERATIONS or literal in PRIMITIVES:
            hint = "choose another name"
            what = "a predefined type" if literal in PRIMITIVES else "an attribute"
            yield Diagnostic("R074", f"{literal} is {what} and cannot be a literal", cls.span, hint)
        if literal in seen:
            yield Diagnostic("R074", f"the literal {literal} is given twice", cls.span, "remove one of them")
        seen.add(literal)
    names: set[str] = set()
    for item in cls.imports:
        name = item.alias or item.path.names[-1]
        if not item.every and name in names:
            hint = "import one of them under another name: import A = B.C;"
            yield Diagnostic("R075", f"{name} is imported twice", item.span, hint)
        names |= set() if item.every else {name}


def _declared(cls: ast.Class) -> Iterator[tuple[Span, str]]:
    yield cls.span, cls.name
    yield from ((c.span, c.name) for c in cls.components)
    yield from ((c.span, c.name) for c in cls.classes.values())


def _sections(cls: ast.Class) -> Iterator[Diagnostic]:
    if cls.kind in _WITHOUT_SECTIONS and cls.sections:
        section = cls.sections[0]
        what = "algorithm" if section.algorithm else "equations"
        yield Diagnostic("R070", f"a {cls.kind} has no {what}", section.span, "write a model or a block")
    if cls.external is not None and cls.kind != "function":
        yield Diagnostic("R070", f"a {cls.kind} has no external code (12.9)", cls.external.span, "call a function")
    if cls.kind == "type" and cls.alias is None and cls.literals is None and not cls.extends and not cls.components:
        yield Diagnostic("R070", f"the type {cls.name} is of nothing (4.7)", cls.span, "type T = Real")
    for place in (place for section in cls.sections for place in section.stray_breaks):
        yield Diagnostic("R059", "'break' outside of a loop", place, "it ends the loop around it")


def _component(cls: ast.Class, component: ast.Component) -> Iterator[Diagnostic]:
    kind, span = cls.kind, component.span
    if kind in _ALL_PUBLIC and component.protected:
        yield Diagnostic("R070", f"a {kind} has no protected elements", span, "make it public")
    if kind in _ALL_PUBLIC and (component.inner or component.outer):
        yield Diagnostic("R070", f"a {kind} has neither inner nor outer elements", span, "declare it in a model")
    if component.stream and kind not in ("connector", "record"):
        yield Diagnostic("R070", f"the stream {component.name} of a {kind}", span, "streams belong into connectors")
    if cls.expandable and component.flow:
        hint = "connect the flow by a connector of its own"
        yield Diagnostic("R070", f"the flow {component.name} of an expandable connector", span, hint)
    if kind == "record" and (component.causality or component.flow or component.stream):
        hint = "prefixes of that kind belong into connectors, blocks and functions"
        yield Diagnostic(
            "R070", f"{component.name}: an element of a record is not input, output, flow or stream", span, hint
        )
    if kind == "type" and not cls.extends:  # of one that extends, R071 says it
        hint = "declare a record, or a type that extends a predefined one"
        yield Diagnostic("R070", f"{component.name}: a type has no components", span, hint)
    if kind == "package" and component.variability != "constant":
        yield Diagnostic(
            "R070", f"{component.name}: a package holds classes and constants", span, "declare it constant"
        )


def _operator(cls: ast.Class) -> Iterator[Diagnostic]:
    held = [(c.span, c.name) for c in cls.components]
    held += [(c.span, c.name) for c in cls.classes.values() if c.kind != "function"]
    for span, name in held:
        yield Diagnostic("R070", f"{name}: an operator holds functions only", span, "move it out of the operator")


def _check_bases(cls: ast.Class, context: Context) -> None:
    if cls.alias is not None and str(cls.alias.base) in PRIMITIVES and cls.kind not in ("type", "connector", "class"):
        hint = f"write: type {cls.name} = {cls.alias.base}"
        raise Diagnostic("R071", f"the {cls.kind} {cls.name} is a {cls.alias.base}", cls.alias.base.span, hint)
    allowed = MAY_EXTEND.get(cls.kind, ())
    for reference, tree in base_clauses(cls):
        base = base_class(context.library, cls, reference, tree)
        if base is not None and cls.alias is None:
            _check_operators(cls, base, reference)
        if base is not None and cls.kind == base.kind == "function" and base.impure and not (cls.impure or cls.alias):
            hint = f"write impure before function {cls.name}"
            raise Diagnostic("R082", f"{cls.name} extends the impure function {base.name} (12.3)", cls.span, hint)
        any_class = (
            base is not None and base.kind == "class" and (cls.kind != "type" or _is_simple(reference, cls, context))
        )
        if base is None or base.kind in allowed or any_class:
            continue
        if cls.kind == "function" and base.kind == "class":
            continue
        hint = f"a {cls.kind} extends {' or '.join(allowed)}"
        raise Diagnostic("R071", f"the {cls.kind} {cls.name} extends the {base.kind} {base.name}", reference.span, hint)
    _check_replaceable_bases(cls, context)
    _check_names_of_bases(cls, context)
    _check_hidden(cls, context)
    if cls.alias is None and len(cls.extends) + len(cls.components) > 1:
        for clause in cls.extends:
            if _is_simple(clause.base, cls, context):
                hint = "a class that extends a simple or an array type has nothing else"
                raise Diagnostic("R071", f"{cls.name} extends {clause.base} and more", clause.base.span, hint)


def _check_operators(cls: ast.Class, base: ast.Class, reference: ast.Ref) -> None:
    """Nothing extends an operator record, nor a class around one, but by a short definition (14.2, 4.7)."""
    held = next((c for c in base.classes.values() if c.operator and c.kind == "record"), None)
    found = base if base.operator and base.kind == "record" else held
    if found is not None:
        hint = "write a short definition: operator record NAME = BASE(...);"
        what = f"the operator record {base.name}" if found is base else f"{base.name}, which holds an operator record"
        raise Diagnostic("R071", f"{cls.name} extends {what}", reference.span, hint)


def _check_replaceable_bases(cls: ast.Class, context: Context) -> None:
    for clause in cls.extends:
        base = base_class(context.library, cls, clause.base, clause.modification)
        if base is not None and ((base.replaceable and base.alias is None) or (base.origin or base).replaceable):
            hint = "extend a class that is not replaceable (7.1.4)"
            raise Diagnostic("R071", f"{cls.name} extends the replaceable {base.name}", clause.base.span, hint)


def _check_names_of_bases(cls: ast.Class, context: Context) -> None:
    """What an extends clause names is the same with and without what the clauses bring in (7.1). Raises R071."""
    library = context.library
    for clause, base in ((c, b) for c in cls.extends if not c.base.absolute for b in base_classes(library, cls)):
        name = clause.base.names[0]
        meant, other = find_first(library, cls, name, of_base=True), own_or_inherited(library, base, name)
        if other is not None and meant is not None and (other.origin or other) is not (meant.origin or meant):
            hint = f"write its full name, or rename {name}"
            error = Diagnostic("R071", f"{name} is inherited from {base.name}, too", clause.base.span, hint)
            error.notes.append((other.span, "the inherited one"))
            raise error


def _check_hidden(cls: ast.Class, context: Context) -> None:
    """A class of the name of an inherited one is the same, or redeclares it (7.1)."""
    _check_one_kind(cls, context)
    own = [c for c in cls.classes.values() if not c.redeclares and c.extends_same is None]
    for nested in own if cls.extends else ():
        for reference, tree in base_clauses(cls):
            base = base_class(context.library, cls, reference, tree)
            old = own_or_inherited(context.library, base, nested.name) if base is not None else None
            if old is not None and not _same(old.origin or old, nested):
                hint = "rename it, or write 'redeclare' before it where the inherited one is replaceable"
                error = Diagnostic("R010", f"{nested.name} is inherited from {base.name}, too", nested.span, hint)
                error.notes.append((old.span, "the inherited one"))
                raise error


def _check_one_kind(cls: ast.Class, context: Context) -> None:
    """A name is of a component or of a class, inherited or not (4.3). Raises R010."""
    bases = base_classes(context.library, cls) if cls.extends else []
    for component, base in ((c, b) for c in cls.components for b in bases):
        old = own_or_inherited(context.library, base, component.name)
        if old is not None:
            hint = "rename it"
            error = Diagnostic("R010", f"{component.name} is a class inherited from {base.name}", component.span, hint)
            error.notes.append((old.span, "the inherited one"))
            raise error


def _same(one: ast.Class, other: ast.Class) -> bool:
    """Whether two classes are written alike."""
    parts = ("kind", "components", "extends", "extends_same", "alias", "literals", "sections", "external")
    return (
        all(alike(getattr(one, p), getattr(other, p)) for p in parts)
        and one.classes.keys() == other.classes.keys()
        and all(_same(one.classes[n], other.classes[n]) for n in one.classes)
    )


def _is_simple(reference: ast.Ref, cls: ast.Class, context: Context, depth: int = 0) -> bool:
    """A primitive type, an array type, or a type with a prefix of its own."""
    if str(reference) in PRIMITIVES:
        return True
    clauses = {id(r): t for r, t in base_clauses(cls)}
    base = base_class(context.library, cls, reference, clauses.get(id(reference), ast.Modification(reference.span)))
    if base is None or depth > 20:
        return False
    if base.literals is not None:
        return True
    if base.alias is not None:
        prefixed = bool(base.alias.dimensions or base.alias.causality)
        return prefixed or _is_simple(base.alias.base, base, context, depth + 1)
    return any(_is_simple(e.base, base, context, depth + 1) for e in base.extends)
