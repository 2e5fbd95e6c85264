"""Annotations that change what a model does are read; a name that is nearly one of these is nothing, and a slip."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import lru_cache

from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.flatten.names.context import Context
from lacuna.codegen.syntax import ast
from lacuna.suggest import did_you_mean, nearest


def warn_of_slips(annotation: ast.Modification | None, read: Sequence[str], context: Context) -> None:
    """One warning for each name that is like one of `read`: other names mean something to other tools (18.1)."""
    slips = [
        a for a in (annotation.arguments if annotation else ()) if a.name not in read and _is_slip(a.name, tuple(read))
    ]
    if slips:
        warn(slips, "the annotation {} means nothing here", read, context)


@lru_cache(maxsize=4096)
def _is_slip(name: str, read: tuple[str, ...]) -> bool:
    return not name.startswith("__") and bool(nearest(name, read, 1))


def warn(found: Iterable[ast.Argument], message: str, read: Sequence[str], context: Context) -> None:
    """Say of each that it is not read, once a place."""
    said = {w.span for w in context.warnings if w.code == "W013"}
    for a in found:
        if a.span not in said:
            hint = did_you_mean(a.name, read, f"it has {', '.join(read)}")
            context.warnings.append(Diagnostic("W013", message.format(a.name), a.span, hint, severity="warning"))
