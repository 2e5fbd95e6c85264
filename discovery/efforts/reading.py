"""The places of a class, read from how it is written: connections, equations, those of its components' classes."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path
import re

from lacuna.codegen.flatten.classes.inheritance import written
from lacuna.codegen.flatten.classes.instance import Instance
from lacuna.codegen.flatten.classes.leaf import Leaf
from lacuna.codegen.flatten.connections.connectors import Connector, connectors
from lacuna.codegen.flatten.equations.equations import unroll
from lacuna.codegen.flatten.expressions.lower import lower
from lacuna.codegen.flatten.language import LOWERING
from lacuna.codegen.flatten.names.context import Context
from lacuna.codegen.flatten.names.scope import Scope, base_classes
from lacuna.codegen.flatten.names.values import indices, scalars, shape_of
from lacuna.codegen.library.classes import Library
from lacuna.codegen.library.search_path import MODEL_FOLDER, outermost
from lacuna.codegen.symbolic.expr import Expr, walk
from lacuna.codegen.syntax import ast
from lacuna.discovery.efforts.sites import MOST, Port, Site, Sites, root

ALGORITHM = "it is a statement of an algorithm that other statements follow"
DEFINITION = "it only says that one variable is the rate of another"


def read(library: Library, name: str) -> Sites:
    """The places of class `name`. Raises Diagnostic."""
    cls = library.find(name)
    top = Instance(Context(library, Path(cls.span.file).resolve().parent, LOWERING), cls, "", None, None)
    found: list[Site] = []
    closed: list[tuple[str, str]] = []
    group: dict[str, str] = {}
    ports: dict[str, Port] = {}
    states = _states(section for section, _ in top.sections)
    bases = _bases(top)
    for section, owner in top.sections:
        closed += [(f"line {i.span.line}", ALGORITHM) for i in _passing(section)]
        for item, scope, loops in _each(_equations(section), Scope(top.context, owner, top)):
            if isinstance(item, ast.Connect):
                found += _connection(item, scope, bool(loops), group, ports, closed)
            elif _is_definition(item, states):
                closed.append((item.text, DEFINITION))
            elif owner in bases:
                found += _elements(Site("equation", item.text, span=item.span, bases=bases[owner]), item, scope, loops)
            else:
                closed.append((item.text, f"the equation stands in {owner.path}"))
    found += _inside(top, bases)
    joined: dict[str, list[str]] = {}
    for end in ports:
        joined.setdefault(root(group, end), []).append(end)
    nodes = [
        Site("node", root, (root, *(e for e in ends if e != root)), ports[root])
        for root, ends in joined.items() if root in ports
    ]  # fmt: skip
    return _few(cls, [*nodes, *_branches(group, ports), *found], dict.fromkeys(closed))


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


def _branches(group: dict[str, str], ports: dict[str, Port]) -> list[Site]:
    """Past every component that joins two nodes: what goes on between them may have been left out. Its ports are of one
    kind where the language lets them be connected: their variables have the same names (specification 9.3)."""
    of: dict[tuple[str, str, str], list[str]] = {}
    for end, port in ports.items():
        of.setdefault((end.rpartition(".")[0], port.flow, port.potential), []).append(end)
    return [
        Site("branch", name, (ends[0], ends[1]), ports[ends[0]]) for (name, *_), ends in of.items()
        if len(ends) == 2 and root(group, ends[0]) != root(group, ends[1])
    ]  # fmt: skip


def _bases(top: Instance) -> dict[ast.Class, tuple[ast.Class, ...]]:
    """Classes that the class inherits from, itself among them, whose files are its own: each with the way there."""
    found: dict[ast.Class, tuple[ast.Class, ...]] = {top.cls: ()}
    ways = [top.cls]
    for cls in ways:
        for base in base_classes(top.context.library, cls):
            if base not in found and _is_own(base, top.cls):
                found[base] = (*found[cls], base)
                ways.append(base)
    return found


def _is_own(cls: ast.Class, top: ast.Class) -> bool:
    """Whether a class is of the user's model: in its file, or else in its package, which is not Lacuna, or beside it in
    its folder: not in another package there, which may be the standard library."""
    file, own = Path(cls.span.file).resolve(), Path(top.span.file).resolve()
    package = outermost(own.parent)
    beside = file.is_relative_to(package) if package else file.parent == own.parent
    return file == own or (beside and not file.is_relative_to(MODEL_FOLDER.resolve()))


def _inside(top: Instance, bases: Mapping[ast.Class, tuple[ast.Class, ...]]) -> list[Site]:
    """Equations of the components' classes: of those that the class itself declares and uses once, and of others of the
    user's model."""
    users: dict[ast.Class, list[Instance]] = {}
    for name in top.elements:
        node = top.child(name)
        if isinstance(node, Instance) and node.cls.kind in ("model", "block"):
            users.setdefault(node.cls, []).append(node)
    way = {c.name: bases[cls] for cls in bases for c in cls.components}
    found = []
    for cls, nodes in users.items():
        nested = cls.parent is top.cls and len(nodes) == 1
        if nested or _is_own(cls, top.cls):
            for node in (n for n in nodes if nested or n.name in way):
                found += _balances(node, None if nested else cls, way.get(node.name, ()))
    return found


def _balances(node: Instance, of: ast.Class | None, bases: tuple[ast.Class, ...]) -> list[Site]:
    sections = node.cls.sections
    states, found = _states(sections), []
    for section in sections:
        for item, scope, loops in _each(_equations(section), Scope(node.context, node.cls, node)):
            if isinstance(item, ast.Equality) and not _is_definition(item, states):
                label = f"{node.name}: {item.text}"
                site = Site("equation", label, span=item.span, instance=node.name, of=of, bases=bases)
                found += _elements(site, item, scope, loops)
    return found


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


def _connection(
    item: ast.Connect, scope: Scope, loops: bool, group: dict[str, str], ports: dict[str, Port],
    closed: list[tuple[str, str]],
) -> list[Site]:  # fmt: skip
    """What a connection joins; itself a place where nothing but it is written there."""
    top, found = scope.instance, []
    pairs = list(zip(connectors(item.left, scope), connectors(item.right, scope), strict=False))
    for pair in pairs:
        left, right = names = [_path(node) for node in pair]
        alone = not loops and len(pairs) == 1 and names == [written(item.left), written(item.right)]
        into = [end for end, node in zip(names, pair, strict=True) if "." in end and _causality(node) == "input"]
        if len(into) == 1 and all(map(_causality, pair)):
            source = right if into == [left] else left
            found += [Site("signal", f"{source} to {into[0]}", (left, right), into=into[0])] if alone else []
            continue
        kinds = [_port(top, end, node) for end, node in zip(names, pair, strict=True)]
        if None in kinds:
            closed.append((f"{left}, {right}", "its connectors are not one flow and one potential"))
            continue
        ports[left], ports[right] = kinds
        group[root(group, right)] = root(group, left)
        found += [Site("edge", f"{left} to {right}", (left, right), kinds[0])] if alone else []
    return found


def _path(node: Connector) -> str:
    if not isinstance(node, tuple):
        return node.name
    leaf, position = node
    return leaf.name + (f"[{', '.join(map(str, list(indices(leaf.shape))[position]))}]" if leaf.shape else "")


def _causality(node: Connector) -> str:
    """Of a signal: input | output; "" of anything else."""
    return node[0].causality if isinstance(node, tuple) else node.causality if isinstance(node, Leaf) else ""


def _port(top: Instance, end: str, node: Connector) -> Port | None:
    if not isinstance(node, Instance) or "." not in end or node.cls.kind != "connector":
        return None
    flows = [n for n, e in node.elements.items() if e.declaration.flow]
    others = [n for n, e in node.elements.items() if not e.declaration.flow and not e.declaration.variability]
    plain = all(not isinstance(node.child(n), Instance) for n in (*flows, *others))
    if not plain or len(flows) != 1 or len(others) != 1:
        return None
    return Port(_seen_from(top.cls, node.cls.path), flows[0], others[0])


def _seen_from(model: ast.Class, path: str) -> str:
    """A class as a model that extends `model` names it: what that declares is inherited, all else has its full name."""
    return path.removeprefix(f"{model.path}.")
