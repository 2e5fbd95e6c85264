"""What a class inherits and declares, with the modifications that meet each element."""

from __future__ import annotations

from dataclasses import dataclass, replace

from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten.classes.restrictions import check_class
from lacuna.codegen.flatten.names.component import Component
from lacuna.codegen.flatten.names.context import Context
from lacuna.codegen.flatten.names.modifiers import Modifier, from_tree, merge, same_modifier
from lacuna.codegen.flatten.names.scope import PRIMITIVES, Scope, base_class, base_clauses, find_class, own_or_inherited
from lacuna.codegen.flatten.names.unknown import unknown_class, unknown_element
from lacuna.codegen.flatten.names.views import constraints_of
from lacuna.codegen.syntax import ast
from lacuna.codegen.syntax.alike import alike
from lacuna.suggest import did_you_mean

MAX_DEPTH = 40


@dataclass(slots=True)
class Element:
    """A declaration as an instance sees it: own or inherited, with the modification from outside."""

    declaration: ast.Component
    cls: ast.Class  # where it is declared
    modifier: Modifier | None
    replaced: Element | None = None  # what an element written with `redeclare` stands for

    @property
    def is_unsized(self) -> bool:
        """Whether nothing in the declaration says how large it is."""
        return any(isinstance(d, ast.Colon) for d in self.declaration.dimensions) and (
            self.declaration.modification.value is None
        )

    def written_in(self, part: str) -> ast.Class:
        """The class in which its dimensions or its condition are written: a redeclaration may keep them (7.3)."""
        old = self.replaced
        kept = old is not None and getattr(self.declaration, part) is getattr(old.declaration, part)
        return old.written_in(part) if kept else self.cls


class Inheritance:
    """Elements by name, sections with the classes they are written in, and the classes; bases before what extends them.

    `elements` are in order of declaration. Raises R010, R011, R030 to R032 and R037 for what does not fit.
    """

    def __init__(self, context: Context, instance: Component, cls: ast.Class, modifier: Modifier | None) -> None:
        self._context, self._instance = context, instance
        self.elements: dict[str, Element] = {}
        self.sections: list[tuple[ast.Section, ast.Class]] = []
        self.classes: list[ast.Class] = []  # own class and bases
        self.visible: dict[int, set[str]] = {}  # names of elements, by identity of the class whose text may use them
        self._clauses: list[ast.Ref] = []  # of the bases that are being collected, outermost first
        self._collect(cls, modifier)
        if len(self.sections) > 1:
            self.sections = _once(self.sections)
        if modifier is not None:
            self._refuse_unknown(modifier, self.elements, cls)
            self._refuse_protected(modifier, cls)

    def _collect(self, cls: ast.Class, modifier: Modifier | None, depth: int = 0) -> None:
        if depth > MAX_DEPTH:
            clause = next(iter(base_clauses(cls)))[0]
            raise Diagnostic("R011", f"{cls.name} extends itself", clause.span, "break the circle of extends")
        context = self._context
        scope = Scope(context, cls, self._instance)
        if isinstance(cls.written, Scope):
            scope = cls.written
        elif cls.alias is not None and cls.parent is not None:
            scope = Scope(context, cls.parent, None)
        check_class(cls, context)
        constraint = self._constraint(cls)
        if cls.alias is None:
            modifier = merge(modifier, constraint)
        self.classes.append(cls)
        known = set(self.elements)
        visible = self.visible.setdefault(id(cls.origin or cls), set())
        for reference, tree in base_clauses(cls):
            base = base_class(context.library, cls, reference, tree)
            if base is None:
                raise unknown_class(context.library, cls, reference, "class")
            inner = from_tree(tree, scope)
            if cls.alias is not None and constraint is not None:
                inner = merge(inner, constraint)
            before, sections = dict(self.elements), len(self.sections)
            self._clauses.append(reference)
            self._collect(base, modifier if inner.empty else merge(modifier, inner), depth + 1)
            self._clauses.pop()
            if tree.left_out:
                self._leave_out(tree.left_out, sections, base)
            inherited = {n: e for n, e in self.elements.items() if before.get(n) is not e}
            self._refuse_unknown(inner, inherited, base)
            if any(e.protected and e.base is reference for e in cls.extends):
                for name, e in inherited.items():
                    self.elements[name] = replace(e, declaration=replace(e.declaration, protected=True))
            visible |= self.visible[id(base.origin or base)]
        for declaration in cls.components:
            outer = modifier.children.get(declaration.name) if modifier else None
            self._add(Element(declaration, cls, outer))
        if cls.final and modifier is not None:
            self._refuse_final(cls, modifier, known)
        visible.update(c.name for c in cls.components)
        self.sections += [(section, cls) for section in cls.sections]

    def _constraint(self, cls: ast.Class) -> Modifier | None:
        """The modification of the constraining clauses that `cls` keeps to."""
        found: Modifier | None = None
        for tree, around in constraints_of(cls):
            found = merge(found, from_tree(tree, Scope(self._context, around, self._instance.parent)))
        return found

    def _leave_out(self, left_out: list[ast.Ref | ast.Connect], first: int, base: ast.Class) -> None:
        """Selective extension (Modelica 3.6, 7.4): drop inherited components with their connections, or connections."""
        names = {str(item): item for item in left_out if isinstance(item, ast.Ref)}
        pairs = {frozenset((written(c.left), written(c.right))): c for c in left_out if isinstance(c, ast.Connect)}
        used: set[frozenset[str]] = set()
        for name, item in names.items():
            if name not in self.elements:
                hint = did_you_mean(name, self.elements, f"{base.name} has {', '.join(list(self.elements)[:10])}")
                raise Diagnostic("R032", f"{base.path} has no component {name} to leave out", item.span, hint)
            declared = self.elements[name]
            found = find_class(self._context.library, declared.cls, declared.declaration.type)
            if str(declared.declaration.type) in PRIMITIVES or (found is not None and found.kind in ("record", "type")):
                hint = "models, blocks and connectors are left out"
                raise Diagnostic("R032", f"{name} is a {declared.declaration.type} (7.4)", item.span, hint)
            del self.elements[name]

        def kept(item: ast.Item) -> bool:
            if not isinstance(item, ast.Connect):
                return True
            pair = frozenset((written(item.left), written(item.right)))
            used.add(pair)
            return pair not in pairs and item.left.names[0] not in names and item.right.names[0] not in names

        for k in range(first, len(self.sections)):
            section, cls = self.sections[k]
            self.sections[k] = (replace(section, items=[i for i in section.items if kept(i)]), cls)
        for pair, item in pairs.items():
            if pair not in used:
                hint = "write it as the base class does"
                raise Diagnostic("R032", f"{base.path} has no such connection to leave out", item.span, hint)

    def _add(self, element: Element) -> None:
        name = element.declaration.name
        present = self.elements.get(name)
        if element.declaration.redeclares:
            element = _redeclared(element, present)
        elif present is not None and not self._is_same(present, element):
            places = [*(c.span for c in self._clauses[:1]), element.declaration.span, present.declaration.span]
            error = Diagnostic("R010", f"{name} is declared twice", places[0], "rename one of them")
            error.notes += [(place, "the other declaration") for place in places[1:]]
            raise error
        self.elements[name] = element

    def _is_same(self, one: Element, other: Element) -> bool:
        """Whether an element is inherited again: of the same type, each by the names of its own class, and
        with the same prefixes, sizes and modifications (7.1.2)."""
        if one.declaration is other.declaration:
            return same_modifier(one.modifier, other.modifier)
        if one.cls is other.cls or not alike(one.declaration, other.declaration, beside=("type",)):
            return False
        if str(one.declaration.type) == str(other.declaration.type) and str(one.declaration.type) in PRIMITIVES:
            return True
        meant = [find_class(self._context.library, e.cls, e.declaration.type) for e in (one, other)]
        return meant[0] is not None and meant[0] is meant[1]

    def _refuse_unknown(self, modifier: Modifier, elements: dict[str, Element], cls: ast.Class) -> None:
        for name, child in modifier.children.items():
            if name in elements:
                continue
            if own_or_inherited(self._context.library, cls, name) is None:
                raise unknown_element(cls, name, elements, child.span)
            if child.value is not None:
                hint = did_you_mean(name, elements, f"modify what is in it: {name}(...)")
                raise Diagnostic("R032", f"{name} is a class of {cls.path} and has no value", child.span, hint)

    def _refuse_final(self, cls: ast.Class, modifier: Modifier, others: set[str]) -> None:
        """Nothing of a class that is final is modified (7.2.6). Raises R031."""
        for name, child in modifier.children.items():
            if name in self.elements and name not in others and not child.empty:
                hint = "remove the modification"
                raise Diagnostic("R031", f"{cls.name} is final and cannot be modified", child.span, hint)

    def _refuse_protected(self, modifier: Modifier, cls: ast.Class) -> None:
        for name, child in modifier.children.items():
            declaration = self.elements[name].declaration if name in self.elements else None
            if declaration is not None and declaration.protected:
                hint = "make it public, or modify it in an extends clause"
                error = Diagnostic("R037", f"{name} is protected in {cls.name}", child.span, hint)
                error.notes.append((declaration.span, "declared here"))
                raise error


def _once(sections: list[tuple[ast.Section, ast.Class]]) -> list[tuple[ast.Section, ast.Class]]:
    """Sections without what is inherited twice, and equations without those written twice alike (7.1)."""
    kept, sections_seen = [], set()
    written: dict[tuple[bool, str], int] = {}  # by equation, the class it stands in
    for section, cls in sections:
        if id(section) in sections_seen:
            continue
        sections_seen.add(id(section))
        keys = [_key(item, section) for item in section.items]
        again = [written.get(key, id(cls)) != id(cls) for key in keys]
        written.update((key, id(cls)) for key in keys if key)
        if any(again):
            section = replace(section, items=[i for i, twice in zip(section.items, again, strict=True) if not twice])
        kept.append((section, cls))
    return kept


def _key(item: ast.Item, section: ast.Section) -> tuple[bool, str] | None:
    """An equation as it is written, blanks aside; None for anything else."""
    plain = isinstance(item, ast.Equality) and not section.algorithm
    return (section.initial, "".join(item.text.split())) if plain else None


def _redeclared(element: Element, present: Element | None) -> Element:
    """An element written with `redeclare`, in place of the inherited one. Raises R032, R033, R037."""
    new = element.declaration
    if present is None:
        hint = "redeclare what a base class declares, or remove 'redeclare'"
        raise Diagnostic("R032", f"{new.name} redeclares nothing", new.span, hint)
    old = present.declaration
    refuse_redeclaration(new, old, new.span)
    if old.protected != new.protected:
        hint = "declare both public, or both protected"
        raise Diagnostic("R037", f"{new.name} and what it redeclares differ in visibility", new.span, hint)
    if new.constraint is None and old.constraint is not None:
        new = replace(new, constraint=old.constraint)
    return replace(element, declaration=inheriting(new, old), replaced=present)


def refuse_redeclaration(new: ast.Component, old: ast.Component, span: Span) -> None:
    """Raises R033 where a component cannot be redeclared: constants, final ones, and those not replaceable."""
    why = "a constant" if old.variability == "constant" else "final" if old.final else ""
    if why or not old.replaceable:
        message = f"{old.name} is {why or 'not replaceable'}" + (" and cannot be redeclared" if why else "")
        error = Diagnostic("R033", message, span, "declare it with 'replaceable'" if not why else "remove 'redeclare'")
        error.notes.append((old.span, "declared here"))
        raise error
    if new.condition is not None:
        hint = "the condition of the declaration holds"
        raise Diagnostic("R032", f"{new.name} is redeclared with a condition (4.4.5)", span, hint)
    pairs = [(new.causality, old.causality), (_carried(new), _carried(old))]
    reason = next((f"{one} where it is {other}" for one, other in pairs if one and other and one != other), "")
    if _VARIABILITIES.index(new.variability or old.variability) > _VARIABILITIES.index(old.variability):
        reason = f"{new.variability} where it is {old.variability}"
    if _carried(new) and not _carried(old):
        reason = f"{_carried(new)} where it is not"
    if reason:
        hint = "keep the prefixes of the declaration"
        error = Diagnostic("R034", f"{old.name} is redeclared as {reason}", span, hint)
        error.notes.append((old.span, "declared here"))
        raise error


_VARIABILITIES = ("constant", "parameter", "discrete", "")  # from the narrowest


def _carried(declaration: ast.Component) -> str:
    return "flow" if declaration.flow else "stream" if declaration.stream else ""


def inheriting(new: ast.Component, old: ast.Component) -> ast.Component:
    """A redeclaration with the prefixes and sizes of the original where it has none of its own (7.3)."""
    return replace(
        new, variability=new.variability or old.variability, causality=new.causality or old.causality,
        flow=new.flow or old.flow, stream=new.stream or old.stream, inner=new.inner or old.inner,
        outer=new.outer or old.outer, dimensions=new.dimensions or old.dimensions,
        condition=new.condition or old.condition, protected=old.protected,
        description=new.description or old.description,
    )  # fmt: skip


def written(reference: ast.Ref) -> str:
    """A name as text, subscripts that are whole numbers included, to compare connections."""
    parts = []
    for name, subscripts in zip(reference.names, reference.subscripts, strict=True):
        shown = [str(s.value) if isinstance(s, ast.Literal) else "?" for s in subscripts or ()]
        parts.append(name + (f"[{','.join(shown)}]" if shown else ""))
    return ".".join(parts)


def own_modifier(element: Element, scope: Scope, redeclared: bool) -> Modifier:
    """What the declaration says, and its constraining clause: that holds whatever stands there, `redeclared` from
    outside or by an element; without such a clause what the replaced declaration says does (7.3.2)."""
    declaration, old = element.declaration, element.replaced
    own = from_tree(declaration.modification, scope, final=declaration.final)
    if old is not None and declaration.constraint is old.declaration.constraint:
        kept = own_modifier(old, replace(scope, cls=old.cls), True)
        return kept if redeclared else merge(own, kept) or own
    if declaration.constraint is None:
        return own
    constraint = from_tree(declaration.constraint.modification, scope, final=declaration.final)
    return constraint if redeclared else merge(own, constraint) or own
