"""Another name for what is at the cursor, wherever it is named; refused where a text would then mean something else."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import groupby
from pathlib import Path

from lacuna.codegen.errors import Span
from lacuna.codegen.syntax.lexer import is_name
from lacuna.lsp.features import Place, Workspace, occurrences


class Refused(Exception):
    """Why something keeps its name."""


def rename(workspace: Workspace, path: Path, line: int, character: int, new: str) -> list[Place]:
    """The places to write `new` at. Raises Refused where it is no name, or would stand for something else too."""
    if not is_name(new):
        raise Refused(f"{new!r} is not a name: letters, digits and _, or in 'quotes', and no keyword")
    places = occurrences(workspace, path, line, character)
    here = next((p for p in places if _holds(p, path, line, character)), None)
    if here is None and places:
        raise Refused("this is another name of it, given where it is imported: rename it where it is declared")
    if here is None or _text(workspace, here) == new:
        return []
    edited = Workspace(workspace.search_path)
    edited.texts = dict(workspace.texts)
    moved: dict[Place, Place] = {}
    for file, spans in _by_file(places):
        edited.texts[file] = _written(workspace.text(file), spans, new)
        moved |= _moved(file, spans, new)
    after = moved[here][1]
    found = occurrences(edited, path, after.line - 1, after.column - 1)
    if {(p, s.line, s.column) for p, s in found} != {(p, s.line, s.column) for p, s in moved.values()}:
        raise Refused(f"{new} stands for something else here already, or names would be left behind")
    for file in dict(_by_file(places)):
        before, then = (sorted(f.code for f in w.view(file).findings) for w in (workspace, edited))
        if before != then:
            raise Refused(f"{file.name} would no longer mean the same: {edited.view(file).findings[0].message}")
    return places


def _holds(place: Place, path: Path, line: int, character: int) -> bool:
    file, span = place
    return file == path and span.line - 1 == line and span.column - 1 <= character <= span.column - 1 + span.length


def _text(workspace: Workspace, place: Place) -> str:
    file, span = place
    row = workspace.text(file).split("\n")[span.line - 1]
    return row[span.column - 1 : span.column - 1 + span.length]


def _by_file(places: Iterable[Place]) -> list[tuple[Path, list[Span]]]:
    ordered = sorted(places, key=lambda p: (str(p[0]), p[1].line, p[1].column))
    return [(file, [span for _, span in group]) for file, group in groupby(ordered, key=lambda p: p[0])]


def _written(text: str, spans: list[Span], new: str) -> str:
    rows = text.split("\n")
    for span in reversed(spans):
        row, start = rows[span.line - 1], span.column - 1
        rows[span.line - 1] = row[:start] + new + row[start + span.length :]
    return "\n".join(rows)


def _moved(file: Path, spans: list[Span], new: str) -> dict[Place, Place]:
    """Where each place lies when all of its line are written anew."""
    found: dict[Place, Place] = {}
    for _, on_line in groupby(spans, key=lambda s: s.line):
        shift = 0
        for span in on_line:
            found[file, span] = (file, Span(span.file, span.line, span.column + shift, len(new)))
            shift += len(new) - span.length
    return found
