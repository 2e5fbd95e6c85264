"""Whether two pieces of a syntax tree say the same, wherever they stand and whatever their comments."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import fields, is_dataclass

_SILENT = frozenset({"span", "description", "annotation", "text"})


def alike(one: object, other: object, beside: Collection[str] = ()) -> bool:
    """Compared field by field, those named by `beside` left out at the top."""
    if type(one) is not type(other):
        return False
    if is_dataclass(one):
        names = [f.name for f in fields(one) if f.name not in _SILENT and f.name not in beside]
        return all(alike(getattr(one, n), getattr(other, n)) for n in names)
    if isinstance(one, list | tuple):
        return len(one) == len(other) and all(map(alike, one, other))
    if isinstance(one, dict):
        return one.keys() == other.keys() and all(alike(one[k], other[k]) for k in one)
    return one == other
