"""The source of a class copied with variables added to some of its equations, for what `extends` cannot change."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
import re

from lacuna.codegen.syntax import ast
from lacuna.discovery.efforts.sites import Site, occurrences


def copied(cls: ast.Class, edits: Mapping[Site, str]) -> tuple[str, list[str]]:
    """(name, lines) of class `cls` with the named variable added to the right side of each edited equation, or to each
    edited parameter or input in its equations.

    The copy is to be nested in a class that extends it and says what the variables are.
    """
    lines = Path(cls.span.file).read_text(encoding="utf-8").split("\n")
    text = "\n".join(lines)
    starts = [0]
    for line in lines:
        starts.append(starts[-1] + len(line) + 1)
    changes: list[tuple[int, bool, str]] = []  # where, whether around a right side, what is put in
    for site, variable in edits.items():
        for part in site.parts or (site,):
            begin = starts[part.span.line - 1] + part.span.column - 1
            side, end = right_side(text, begin)
            if site.kind in ("parameter", "input"):
                for at in occurrences(site.label, text, begin, end):
                    changes += [(at, False, "("), (at + len(site.label), False, f" + {variable})")]
            else:
                changes += [(side, True, " ("), (end, True, f") + {variable}")]
        owner = text.rfind("\nequation", 0, begin)
        owner = _section(text, begin) if owner < 0 else owner
        kind = "input Real" if site.instance else "Real"  # a component is given from outside what it does not say
        changes.append((owner, False, f'\n  {kind} {variable} "Missing in a balance";'))
    for at, _, new in sorted(changes, key=lambda c: c[:2], reverse=True):  # a parameter closes before its right side
        text = text[:at] + new + text[at:]
    begin = starts[cls.span.line - 1]
    end = re.compile(rf"\bend\s+{re.escape(cls.name)}\s*;").search(text, begin).end()
    body = text[begin:end].split("\n")
    return cls.name, [f"  {line}" if line else "" for line in body]


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
        if level == 0 and side < 0 and c == "=" and text[k - 1] not in "<>=:" and text[k + 1] != "=":
            side = k + 1
        elif level == 0 and side >= 0 and (c in ';"' or re.match(r"annotation\b", text[k:])):
            return side, k
        k += 1
    raise ValueError("an equation without end")


def _section(text: str, begin: int) -> int:
    """Where the section of the equation at `begin` starts."""
    found = [m.start() for m in re.finditer(r"\bequation\b", text[:begin])]
    return found[-1]
