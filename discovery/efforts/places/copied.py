"""The source of a class copied with variables added to some of its equations, for what `extends` cannot change."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
import re

from lacuna.codegen.errors import Span
from lacuna.codegen.flatten.classes.inheritance import written
from lacuna.codegen.syntax import ast
from lacuna.discovery.efforts.places.sites import Site, Step, occurrences

Edit = tuple[tuple[Step, ...], Site, str]  # what is left of the way to a site, the site, what is added there
Change = tuple[int, bool, str, int]  # where, whether after others there, what is put in, in place of what up to where


@dataclass
class Added:
    """A variable that is added at a place: a sum of terms, of each element where arrays are on the way."""

    site: Site
    variable: str
    sums: dict[tuple[int, ...], list[str]] = field(default_factory=dict)

    def value(self, element: tuple[int, ...] = ()) -> str:
        """Its binding, or that of a part of the array."""
        _, shape = self.site.element
        if len(element) == len(shape):
            return " + ".join(self.sums.get(element, ["0"]))
        return "{" + ", ".join(self.value((*element, k)) for k in range(1, shape[len(element)] + 1)) + "}"


def copied(cls: ast.Class, edits: Sequence[tuple[Site, str]]) -> tuple[str, list[str]]:
    """(name, lines) of class `cls` with the named variable added where each site is: to the right side of an equation,
    to each occurrence of a parameter or input in its equations, as what flows in at a node or past a component and is
    lost in a connection. A component whose class stands elsewhere has a copy of that, with the variable as an input.

    The copy is to be nested in a class that extends it and says what the variables are.
    """
    body = _copy(cls, [(site.way, site, variable) for site, variable in edits])
    return cls.name, [f"  {line}" if line else "" for line in body.split("\n")]


def _copy(cls: ast.Class, edits: list[Edit]) -> str:
    """The text of a class, and before whatever names them copies of the classes of its components and bases, changed,
    by names of their own."""
    text = Path(cls.span.file).read_text(encoding="utf-8")
    starts = [0, *(m.end() for m in re.finditer("\n", text))]
    changes: list[Change] = []
    inner: dict[int, tuple[ast.Class, str, list[Edit]]] = {}  # by where the class is named: it, and the copy's name
    for way, site, variable in edits:
        if way:
            step, *rest = way
            name = f"{step.cls.name}_{step.component.replace('.', '_') or 'inherited'}"
            copy = inner.setdefault(_at(step.span, starts), (step.cls, name, []))
            copy[2].append((tuple(rest), site, variable))
        else:
            changes += _added(site, variable, cls, text, starts)
    begins = [_at(c.type.span, starts) for c in cls.components] + [_at(e.base.span, starts) for e in cls.extends]
    for at, (of, name, own) in inner.items():
        line = text.rfind("\n", 0, max(b for b in begins if b <= at)) + 1
        changes.append((line, False, _renamed(of, _copy(of, own), name), line))
        changes.append((at, False, name, re.compile(r"[\w.']+").match(text, at).end()))
    return _class_text(cls, text, starts, [*_seen(cls, text, starts), *changes])


def _at(span: Span, starts: list[int]) -> int:
    return starts[span.line - 1] + span.column - 1


def _added(site: Site, variable: str, cls: ast.Class, text: str, starts: list[int]) -> list[Change]:
    """What declares a variable in a class and puts it where a site is."""
    kind, value = ("input Real", " = 0") if site.instance else ("Real", "")  # a component is given it from outside
    size = f"[{len(site.members)}]" if site.members else ""
    declared, joins = [f'{kind} {variable}{size}{value} "Missing there";'], []
    if site.port is None:
        changes = _terms(site, variable, text, starts)
    elif site.kind == "edge":
        changes = _broken(site, variable, text, starts)
    else:
        ends = zip(("port",) if site.kind == "node" else ("a", "b"), site.ports, strict=False)
        changes, joins = [], [f"connect({end}, at_{variable}.{own});" for own, end in ends]
    declared += _joining(site, variable) if site.port else []
    owner = _declarations_end(cls, text, starts)
    margin = _margin(text[owner:].lstrip("\n"))
    hidden = site.instance and re.search(r"\bprotected\b", text[starts[cls.span.line - 1] : owner])
    section = f"\n{margin[2:]}public" if hidden else ""  # it is given from outside
    changes.append((owner, False, section + "".join(f"\n{margin}{line}" for line in declared), owner))
    if joins:
        changes.append((owner, True, "".join([f"\n{margin[2:]}equation", *(f"\n{margin}{j}" for j in joins)]), owner))
    return changes


def _terms(site: Site, variable: str, text: str, starts: list[int]) -> list[Change]:
    """A variable in equations, or added to a signal on its way."""
    changes: list[Change] = []
    if site.kind == "signal":
        begin = _at(site.span, starts)
        source, into = (end for end in sorted(site.ports, key=lambda end: end == site.inside(site.into)))
        return [(begin, False, f"{into} = {source} + {variable}", connection_end(text, begin))]
    for part in site.parts or (site,):
        begin = _at(part.span, starts)
        side, end = right_side(text, begin)
        if site.kind in ("parameter", "input"):
            for at in occurrences(site.local, text, begin, end):
                last = at + len(site.local)
                changes += [(at, False, "(", at), (last, False, f" + {variable})", last)]
        else:
            changes += [
                (side, True, " (", side),
                (end, True, f") + {site.term.replace('{@}', '@').replace('@', variable)}", end),
            ]
    return changes


def _broken(site: Site, variable: str, text: str, starts: list[int]) -> list[Change]:
    """A connection in two, with what is lost between them."""
    begin, (left, right) = _at(site.span, starts), site.ports
    through = f"connect({left}, at_{variable}.a); connect(at_{variable}.b, {right})"
    return [(begin, False, through, connection_end(text, begin))]


def _joining(site: Site, variable: str) -> list[str]:
    """What gives the variable as a flow in a component's class, or loses it across, and its component."""
    (ports, does), cls = site.acting("effort"), f"At_{variable}"
    return [
        f"model {cls}", f"  {ports}", "  input Real effort;", "equation", *(f"  {equation}" for equation in does),
        f"end {cls};", f"{cls} at_{variable}(effort={variable});",
    ]  # fmt: skip


def _class_text(cls: ast.Class, text: str, starts: list[int], changes: list[Change]) -> str:
    """A class as it is written, changed."""
    begin = starts[cls.span.line - 1]
    end = _end(cls, text, starts).end()
    result, last = [], begin
    for at, _, new, until in sorted(changes, key=lambda c: c[:2]):  # a parameter closes before its right side
        result += [text[last:at], new]
        last = until
    return "".join([*result, text[last:end]])


def _end(cls: ast.Class, text: str, starts: list[int]) -> re.Match:
    return re.compile(rf"\bend\s+{re.escape(cls.name)}\s*;").search(text, starts[cls.span.line - 1])


def _renamed(cls: ast.Class, text: str, name: str) -> str:
    """The text of a class by another name."""
    text = re.sub(rf"\b(model|block)(\s+){re.escape(cls.name)}\b", rf"\1\2{name}", text, count=1)
    return re.sub(rf"\bend(\s+){re.escape(cls.name)}(\s*);$", rf"end\1{name}\2;", text) + "\n"


def _seen(cls: ast.Class, text: str, starts: list[int]) -> list[Change]:
    """What lets a class see elsewhere what the packages around it and their imports let it see."""
    around, seen = cls.parent, []
    while around is not None and around.name and around.kind == "package":
        seen += [f"import {around.path}.*;", *(f"import {_imported(i)};" for i in around.imports)]
        around = around.parent
    at = _declarations_end(cls, text, starts)
    margin = _margin(text[at:].lstrip("\n"))
    return [(at, False, "".join(f"\n{margin}{clause}" for clause in seen), at)]


def _margin(section: str) -> str:
    """Before an element of a class whose section begins with this line."""
    return section[: len(section) - len(section.lstrip())] + "  "


def _imported(clause: ast.Import) -> str:
    path = written(clause.path)
    return f"{path}.*" if clause.every else f"{clause.alias} = {path}" if clause.alias else path


def right_side(text: str, begin: int) -> tuple[int, int]:
    """(begin, end) of the right side of the equation that starts at `begin`, without comment and annotation."""
    level, side, k = 0, -1, begin
    while k < len(text):
        c = text[k]
        if text.startswith("//", k):
            k = text.index("\n", k)
            continue
        if text.startswith("/*", k):
            k = text.index("*/", k) + 2
            continue
        level += {"(": 1, "[": 1, "{": 1, ")": -1, "]": -1, "}": -1}.get(c, 0)
        if level == 0 and side < 0 and c == "=" and text[k - 1] not in "<>=" and text[k + 1] != "=":
            side = k + 1
        elif level == 0 and side >= 0 and (c in ';"' or re.match(r"annotation\b", text[k:])):
            return side, k
        k += 1
    raise ValueError("an equation without end")


def connection_end(text: str, begin: int) -> int:
    """Where the text of a connection ends that begins there: after its bracket."""
    level = 0
    for k in range(begin, len(text)):
        level += {"(": 1, ")": -1}.get(text[k], 0)
        if level == 0 and text[k] == ")":
            return k + 1
    raise ValueError("a connection without end")


def _declarations_end(cls: ast.Class, text: str, starts: list[int]) -> int:
    """Where the line ends before the first section of a class; or where that starts, if it does so within a line."""
    if not cls.sections:
        return text.rindex("\n", 0, _end(cls, text, starts).start())
    begin = _at(cls.sections[0].span, starts)
    before = text[:begin].rstrip(" \t")
    return len(before) - 1 if before.endswith("\n") else begin
