"""C that a user's model brings along: what is compiled into it, and one call."""

from __future__ import annotations

from dataclasses import dataclass, field

from lacuna.codegen.errors import Span


@dataclass
class ForeignCode:
    """`texts` stand at the head of the generated C; `libraries` are options and files for the linker. `spans` are those
    of the functions."""

    texts: list[str] = field(default_factory=list)
    libraries: list[str] = field(default_factory=list)
    spans: dict[str, Span] = field(default_factory=dict)


@dataclass
class Foreign:
    """A statement of a function: result := function(arguments); where the C calls ModelicaError, the function fails.

    An argument is a variable of the function by name, or characters, or a whole number."""

    function: str
    arguments: tuple[tuple[str, str | int], ...]  # ("variable" | "text" | "number", which)
    places: frozenset[str]  # variables that the C sets through pointers
    result: str | None
    declared: bool  # by a text of the model; else we declare it
    span: Span
