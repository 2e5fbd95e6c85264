"""Modifications of a class as Modelica text."""

from __future__ import annotations

from collections.abc import Mapping
import re


def modified(parameters: Mapping[str, float]) -> list[str]:
    """Modifications that give parameters these values; of an array, which only has one as a whole, all elements."""
    arrays: dict[str, dict[tuple[int, ...], float]] = {}
    for name, value in parameters.items():
        at = tuple(int(k) for inside in re.findall(r"\[([^\]]*)\]", name) for k in inside.split(","))
        arrays.setdefault(unsubscripted(name), {})[at] = value
    return [f"{name}={_array(elements)}" for name, elements in arrays.items()]


def unsubscripted(name: str) -> str:
    return re.sub(r"\[[^\]]*\]", "", name)


def _array(elements: Mapping[tuple[int, ...], float]) -> str:
    """A literal of numbers by their subscripts."""
    if () in elements:
        return f"{elements[()]:.10g}"
    rows: dict[int, dict[tuple[int, ...], float]] = {}
    for (first, *others), value in sorted(elements.items()):
        rows.setdefault(first, {})[tuple(others)] = value
    return "{" + ", ".join(_array(row) for row in rows.values()) + "}"


def entries(modification: str) -> dict[str, str]:
    """The plain `name=value` entries of a modification as written."""
    entries, level, start, inside = [], 0, 0, modification[1:-1]
    for k, c in enumerate(inside + ","):
        level += {"(": 1, ")": -1}.get(c, 0)
        if c == "," and level == 0:
            entries.append(inside[start:k])
            start = k + 1
    return {n.strip(): v.strip() for n, _, v in (e.partition("=") for e in entries) if "(" not in n}


def wrapped(text: str, width: int = 110) -> list[str]:
    """A clause over several lines, broken after commas."""
    lines, line = [], " "
    for piece in text.replace(", ", ",\0").split("\0"):
        if len(line) + len(piece) > width:
            lines.append(line)
            line = "   "
        line += " " + piece
    return [*lines, line]
