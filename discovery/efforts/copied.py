"""The source of a class copied with variables added to some of its equations, for what `extends` cannot change."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
import re

from lacuna.codegen.errors import Span
from lacuna.codegen.flatten.classes.inheritance import written
from lacuna.codegen.syntax import ast
from lacuna.discovery.efforts.sites import Site, occurrences

Edit = tuple[tuple[ast.Class, ...], Site, str]  # bases on the way to a site, the site, what is added there
Change = tuple[int, bool, str, int]  # where, whether around a right side, what is put in, in place of what up to where


def copied(cls: ast.Class, edits: Mapping[Site, str]) -> tuple[str, list[str]]:
    """(name, lines) of class `cls` with the named variable added to the right side of each edited equation, or to each
    edited parameter or input in its equations. A component whose class stands elsewhere in the file has a copy of that.

    The copy is to be nested in a class that extends it and says what the variables are.
    """
    body = _copy(cls, [(site.bases, site, variable) for site, variable in edits.items()])
    return cls.name, [f"  {line}" if line else "" for line in body.split("\n")]


def _copy(cls: ast.Class, edits: list[Edit]) -> str:
    """The text of a class, and before whatever names them copies of the classes of its components and bases, changed,
    by names of their own."""
    text = Path(cls.span.file).read_text(encoding="utf-8")
    starts = [0, *(m.end() for m in re.finditer("\n", text))]
    changes: list[Change] = []
    inner: dict[int, tuple[ast.Class, str, list[Edit]]] = {}  # by where the class is named: it, and the copy's name
    for bases, site, variable in edits:
        if bases:
            base, *rest = bases
            named = next(e.base for e in cls.extends if written(e.base).rpartition(".")[2] == base.name)
            copy = inner.setdefault(_at(named.span, starts), (base, f"{base.name}_inherited", []))
            copy[2].append((tuple(rest), site, variable))
        elif site.of is not None and site.of is not cls:
            component = next(c for c in cls.components if c.name == site.instance)
            copy = inner.setdefault(_at(component.type.span, starts), (site.of, f"{site.of.name}_{site.instance}", []))
            copy[2].append(((), site, variable))
        else:
            changes += _added(site, variable, cls, text, starts)
    for at, (of, name, own) in inner.items():
        line = text.rfind("\n", 0, at) + 1
        changes.append((line, False, _renamed(of, _copy(of, own), name), line))
        changes.append((at, False, name, re.compile(r"[\w.']+").match(text, at).end()))
    return _class_text(cls, text, starts, [*changes, *_seen(cls, text, starts)])


def _at(span: Span, starts: list[int]) -> int:
    return starts[span.line - 1] + span.column - 1


def _added(site: Site, variable: str, cls: ast.Class, text: str, starts: list[int]) -> list[Change]:
    """What declares a variable in a class and puts it where a site is."""
    changes: list[Change] = []
    for part in site.parts or (site,):
        begin = _at(part.span, starts)
        side, end = right_side(text, begin)
        if site.kind in ("parameter", "input"):
            for at in occurrences(site.label, text, begin, end):
                last = at + len(site.label)
                changes += [(at, False, "(", at), (last, False, f" + {variable})", last)]
        else:
            changes += [(side, True, " (", side), (end, True, f") + {site.term.replace('@', variable)}", end)]
    owner = _declarations_end(cls, text, starts)
    kind = "input Real" if site.instance else "Real"  # a component is given from outside what it does not say
    value = " = 0" if site.of else ""
    margin = _margin(text[owner:].lstrip("\n"))
    return [*changes, (owner, False, f'\n{margin}{kind} {variable}{value} "Missing in a balance";', owner)]


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
    while around is not None and around.name:
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


def _declarations_end(cls: ast.Class, text: str, starts: list[int]) -> int:
    """Where the line ends before the first section of a class; or where that starts, if it does so within a line."""
    if not cls.sections:
        return text.rindex("\n", 0, _end(cls, text, starts).start())
    begin = _at(cls.sections[0].span, starts)
    before = text[:begin].rstrip(" \t")
    return len(before) - 1 if before.endswith("\n") else begin
