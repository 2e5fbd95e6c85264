"""The places of a class, read from how it is written: connections, equations, those of its components' classes."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import replace
from pathlib import Path
import re

from lacuna.codegen.flatten.classes.inheritance import written
from lacuna.codegen.flatten.classes.instance import ArrayNode, Instance, Node
from lacuna.codegen.flatten.classes.types import resolve_type
from lacuna.codegen.flatten.equations.equations import unroll
from lacuna.codegen.flatten.expressions.lower import lower
from lacuna.codegen.flatten.language import LOWERING
from lacuna.codegen.flatten.names.context import Context
from lacuna.codegen.flatten.names.scope import Scope, base_classes, base_clauses
from lacuna.codegen.flatten.names.values import indices, scalars, shape_of
from lacuna.codegen.library.classes import Library
from lacuna.codegen.library.search_path import MODEL_FOLDER, outermost
from lacuna.codegen.symbolic.expr import Expr, walk
from lacuna.codegen.syntax import ast
from lacuna.discovery.efforts.places.joined import Joined
from lacuna.discovery.efforts.places.sites import MOST, Site, Sites, Step, occurrences

ALGORITHM = "it is a statement of an algorithm that other statements follow"
DEFINITION = "it only says that one variable is the rate of another"
MANY = f"it is one of more than {MOST}"
LIBRARY = "its class, of a library, is made of components: what is inside is closed"
ELSEWHERE = "its class is named in a text that is not of the model"

Way = tuple[Step, ...]


def read(library: Library, name: str) -> Sites:
    """The places of class `name`. Raises Diagnostic."""
    cls = library.find(name)
    top = Instance(Context(library, Path(cls.span.file).resolve().parent, LOWERING), cls, "", None, None)
    reading = _Reading(top)
    reading.enter(top, ())
    every = [*reading.joined.sites(), *reading.found, *reading.laws]
    return replace(_few(cls, every, dict.fromkeys(reading.closed)), inside=tuple(reading.library))


class _Reading:
    """What is found on the way down through the components of a class whose classes are the user's own."""

    def __init__(self, top: Instance) -> None:
        self.top = top
        self.found: list[Site] = []
        self.closed: list[tuple[str, str]] = []
        self.library: list[Site] = []
        self.laws: list[Site] = []  # of those, where a parameter stands: what such a component is to the machine
        self.joined = Joined(top.cls)
        self.bases: dict[str, dict[ast.Class, Way]] = {}  # of each component on the way

    def enter(self, node: Instance, way: Way) -> None:
        """Read a component's equations and connections, at the end of this way, and those inside."""
        bases = self.bases[node.name] = _bases(node, self.top.cls)
        self.joined.ways[node.name] = way
        prefix = f"{node.name}: " if node.name else ""
        states = _states(section for section, _ in node.sections)
        for section, owner in node.sections:
            self.closed += [(f"{prefix}line {i.span.line}", ALGORITHM) for i in _passing(section)]
            for item, scope, loops in _each(_equations(section), Scope(node.context, owner, node)):
                there = (*way, *bases[owner]) if owner in bases else None
                if isinstance(item, ast.Connect):
                    self.closed += self.joined.read(item, scope, there, bool(loops))
                elif _is_definition(item, states):
                    self.closed.append((prefix + item.text, DEFINITION))
                elif there is not None:
                    site = Site("equation", prefix + item.text, span=item.span, instance=node.name, way=there)
                    self.found += _elements(site, item, scope, loops)
                else:
                    self.closed.append((prefix + item.text, f"the equation stands in {owner.path}"))
        for name in node.elements:
            self._inside(node, name)

    def _inside(self, node: Instance, name: str) -> None:
        """Go on into a component, or into each of an array."""
        child = node.child(name)
        parts = child.items if isinstance(child, ArrayNode) else [child]
        if not parts or not _is_made_of(parts[0]) or child.name != node.path_of(name):
            return
        if not _is_own(parts[0].cls, self.top.cls):
            if any(isinstance(i, ast.Connect) for section, _ in parts[0].sections for i in _flat(section.items)):
                self.closed.append((child.name, LIBRARY))
            if isinstance(child, Instance) and (named := self._named(node, name)) is not None:
                self._of_library(child, (*named[0], named[1]))
        elif (named := self._named(node, name)) is None or any(
            _as_written(p.cls) is not _as_written(named[1].cls) for p in parts
        ):
            self.closed.append((child.name, ELSEWHERE))
        elif len(parts) > MOST:
            self.closed.append((child.name, MANY))
        else:
            way, step = named
            shape = tuple(child.shape) if isinstance(child, ArrayNode) else ()
            for part, index in zip(parts, indices(shape), strict=True):
                one = replace(step, element=(*step.element, *index), shape=(*step.shape, *shape))
                self.enter(part, (*way, one))

    def _of_library(self, part: Instance, way: Way) -> None:
        """The equations of a component of a library: those in which a parameter stands are laws of its own."""
        own = [n for n, e in part.elements.items() if e.declaration.variability == "parameter"]
        for site in _written_in(part, way):
            law = any(occurrences(n, site.local, 0, len(site.local)) for n in own)
            (self.laws if law else self.library).append(site)

    def _named(self, node: Instance, name: str) -> tuple[Way, Step] | None:
        """(way to the class in whose text the class of a component is named, in its declaration or in a modification
        that redeclares it; the step from there to the component, past those in between). None where that text is not
        one of the user's own."""
        element = node.elements[name]
        declaration, scope = element.declaration, Scope(node.context, element.cls, node)
        if element.modifier is not None and isinstance(element.modifier.redeclare, ast.Component):
            declaration, scope = element.modifier.redeclare, element.modifier.redeclared_in
        owner, way = scope.instance.name if scope.instance else None, self.joined.ways[node.name]
        above = self.joined.ways.get(owner, ())
        if scope.cls not in self.bases.get(owner, {}) or way[: len(above)] != above:
            return None
        between = [step for step in way[len(above) :] if step.component]
        cls, component = resolve_type(declaration.type, scope).cls, [*(step.component for step in between), name]
        element, shape = (sum(of, ()) for of in ([s.element for s in between], [s.shape for s in between]))
        step = Step(cls, declaration.type.span, ".".join(component), element, shape)
        return (*above, *self.bases[owner][scope.cls]), step


def _written_in(part: Instance, way: Way) -> list[Site]:
    """The equations that stand in the text of a component's own class, none in a loop."""
    found = []
    for section, owner in part.sections:
        scope = Scope(part.context, owner, part)
        items = _each(_equations(section), scope) if _as_written(owner) is _as_written(part.cls) else ()
        for item, _, loops in items:
            if isinstance(item, ast.Equality) and not loops and not isinstance(item.left, ast.Tuple):
                label = f"{part.name}: {item.text}"
                found.append(Site("equation", label, span=item.span, instance=part.name, way=way))
    return found


def _as_written(cls: ast.Class) -> ast.Class:
    """A class whatever is redeclared in it: its text is the same."""
    return cls.origin or cls


def _is_made_of(node: Node | None) -> bool:
    return isinstance(node, Instance) and node.cls.kind in ("model", "block", "class")


def _equations(section: ast.Section) -> list[ast.Item]:
    """What holds at all times: equations, and in an algorithm the assignments of what nothing else there assigns."""
    if section.initial:
        return []
    if not section.algorithm:
        return section.items
    passing = _passing(section)
    lasting = (i for i in section.items if isinstance(i, ast.Assignment) and i not in passing)
    return [ast.Equality(i.span, i.target, i.value, i.text.replace(":=", "=", 1)) for i in lasting]


def _passing(section: ast.Section) -> list[ast.Item]:
    """The statements of an algorithm that do not hold at all times, but from one to the next: all, where there are
    loops, conditions or calls with several results, which may assign anything."""
    if section.initial or not section.algorithm:
        return []
    steps = [i for i in section.items if not isinstance(i, ast.Procedure)]
    if not all(isinstance(i, ast.Assignment) and isinstance(i.target, ast.Ref) for i in steps):
        return steps
    times = Counter(i.target.names[0] for i in steps)
    return [i for i in steps if times[i.target.names[0]] > 1]


def _few(cls: ast.Class, places: list[Site], closed: Iterable[tuple[str, str]]) -> Sites:
    """The places, but equations of an array that has too many of them."""
    sizes = Counter((s.span, s.instance) for s in places if s.term != "@")
    many = [s for s in places if sizes[s.span, s.instance] > MOST]
    said = dict.fromkeys((s.label.rpartition(" [")[0], f"it is one of more than {MOST} equations") for s in many)
    return Sites(cls, tuple(s for s in places if s not in many), (*closed, *said))


def _each(
    items: Iterable[ast.Item], scope: Scope, loops: tuple[str, ...] = ()
) -> Iterator[tuple[ast.Equality | ast.Connect, Scope, tuple[str, ...]]]:
    """Equalities and connections with the loops that they are in, a pass at a time: `i == 2`; under conditions, which
    may change, equalities."""
    for item in items:
        if isinstance(item, ast.Equality | ast.Connect):
            yield item, scope, loops
        elif isinstance(item, ast.For):
            for inner in unroll(item, scope):
                here = (f"{i.name} == {inner.locals[i.name].value}" for i in item.iterators)
                yield from _each(item.body, inner, (*loops, *here))
        elif isinstance(item, ast.If):
            under = (found for _, body in item.branches for found in _each(body, scope, loops))
            yield from (found for found in under if isinstance(found[0], ast.Equality))


def _elements(site: Site, item: ast.Equality, scope: Scope, loops: tuple[str, ...]) -> list[Site]:
    """The place of an equation, or of each element of an array of them."""
    if isinstance(item.left, ast.Tuple):
        return [site]
    value = lower(item.left, scope)
    shape = shape_of(value)
    if not shape and not loops:
        return [site]
    found = []
    for element, left in zip(indices(shape), scalars(value), strict=True):
        term, none = _within(shape, element, "@"), _within(shape, element, "0")
        term = f"(if {' and '.join(loops)} then {term} else {none})" if loops else term
        which = [p.replace("==", "=") for p in loops] + [", ".join(map(str, element))] * bool(element)
        found.append(replace(site, label=f"{site.label} [{', '.join(which)}]", term=term, left=_name(left)))
    return found


def _name(e: Expr) -> str:
    """A variable, or else the first rate inside; "" where there is neither."""
    if e.op == "var":
        return str(e.value)
    return next((f"der({_name(x.args[0])})" for x in walk(e) if x.op == "der"), "")


def _within(shape: tuple[int, ...], element: tuple[int, ...], text: str) -> str:
    """An array of zeros with a text as one element."""
    if not shape:
        return text
    rows = (_within(shape[1:], element[1:], text if k == element[0] else "0") for k in range(1, shape[0] + 1))
    return "{" + ", ".join(rows) + "}"


def _bases(node: Instance, top: ast.Class) -> dict[ast.Class, Way]:
    """Classes that a component's class inherits from, itself among them, which are the user's own: the way to each."""
    found: dict[ast.Class, Way] = {node.cls: ()}
    ways = [node.cls]
    for cls in ways:
        clauses, bases = base_clauses(cls), base_classes(node.context.library, cls)
        if len(clauses) != len(bases) or cls.alias is not None or cls.extends_same is not None:
            continue  # the text does not name it where it could be exchanged
        for (ref, _), base in zip(clauses, bases, strict=True):
            if base not in found and _is_own(base, top):
                found[base] = (*found[cls], Step(base, ref.span))
                ways.append(base)
    return found


def _is_own(cls: ast.Class, top: ast.Class) -> bool:
    """Whether a class is of the user's model: in its file, or else in its package, which is not Lacuna, or beside it in
    its folder: not in another package there, which may be the standard library."""
    file, own = Path(cls.span.file).resolve(), Path(top.span.file).resolve()
    package = outermost(own.parent)
    beside = file.is_relative_to(package) if package else file.parent == own.parent
    return file == own or (beside and not file.is_relative_to(MODEL_FOLDER.resolve()))


def _is_definition(item: ast.Equality, states: set[str]) -> bool:
    """Whether an equation only says that one variable is the rate of another, which has a balance of its own: nothing
    of a machine is in it."""
    sides = [item.left, item.right]
    rates = [s for s in sides if isinstance(s, ast.Call) and written(s.function) == "der"]
    return len(rates) == 1 and any(isinstance(s, ast.Ref) and ".".join(s.names) in states for s in sides)


def _states(sections: Iterable[ast.Section]) -> set[str]:
    """Names that occur differentiated in these sections."""
    texts = [i.text for s in sections for i in _flat(s.items) if isinstance(i, ast.Equality)]
    return {name for text in texts for name in re.findall(r"\bder\(\s*([\w.]+)(?:\[[^\]]*\])?\s*\)", text)}


def _flat(items: Iterable[ast.Item]) -> Iterator[ast.Item]:
    for item in items:
        if isinstance(item, ast.If):
            yield from (inner for _, body in item.branches for inner in _flat(body))
        else:
            yield from _flat(item.body) if isinstance(item, ast.For) else (item,)
