"""What to say when equations and unknowns do not match: the smallest parts with too many of either, by source line."""

from __future__ import annotations

from collections.abc import Sequence, Set

from lacuna.codegen import flat
from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.structure.sorting.matching import Matching
from lacuna.codegen.structure.system import Row


def _occurring(row: Row) -> set[str]:
    names = set()
    for n in row.leaves:
        while n.op == "der":
            n = n.args[0]
        if n.op == "var":
            names.add(str(n.value))
    return names


def require_regular(rows: list[Row], names: Sequence[str], model: flat.FlatModel) -> None:
    """Refuse a structurally singular system (a variable and its derivatives count as one unknown)."""
    column = {name: k for k, name in enumerate(names)}
    matching = Matching([sorted(column[n] for n in _occurring(r) if n in column) for r in rows], len(names))
    unmatched_rows = matching.match_all()
    unmatched_columns = [k for k, row in enumerate(matching.row_of) if row < 0]
    if not unmatched_rows and not unmatched_columns:
        return
    notes, counts = [], f"{len(rows)} equations for {len(names)} unknowns"
    first, open_ = None, []
    if unmatched_rows:
        over_rows, over_columns = matching.overdetermined(unmatched_rows)
        notes += _notes(rows, names, model, over_rows, over_columns)
        first = f"too many equations: {len(over_rows)} for {_list(names, over_columns)}"
    if unmatched_columns:
        under_rows, under_columns = matching.underdetermined(unmatched_columns)
        notes += _notes(rows, names, model, under_rows, under_columns)
        lacking = f"too few equations: {len(under_rows)} for {_list(names, under_columns)}"
        open_ = _ungiven(rows, names, model, under_columns)
        if open_:
            lacking = f"nothing gives a value to {'the input' if len(open_) == 1 else 'inputs'} {_list(names, open_)}"
            unmatched_columns = open_
        first = f"{first}; {lacking}" if first else lacking
    span = rows[unmatched_rows[0]].source.span if unmatched_rows else model.variables[names[unmatched_columns[0]]].span
    hint = "connect it, or write an equation for it"
    if not open_:
        hint = _hint(rows, column.keys(), unmatched_rows, unmatched_columns)
    raise Diagnostic("S003", f"the model is structurally singular ({counts}): {first}", span, hint, notes)


def _hint(rows: list[Row], unknown: Set[str], unmatched_rows: Sequence[int], unmatched_columns: Sequence[int]) -> str:
    if unmatched_columns and any(rows[r].text.startswith("sum of flows") for r in unmatched_rows):
        return "nothing fixes the potentials of these connections: connect a ground, or a fixed flange"
    if unmatched_rows and not any(_occurring(rows[r]) & unknown for r in unmatched_rows):
        return "remove it: what it holds is known without it, as a parameter, an input or by other equations"
    if unmatched_rows:
        return "remove one of the equations listed"
    return "add an equation or a connection for one of them"


def _ungiven(rows: list[Row], names: Sequence[str], model: flat.FlatModel, columns: Sequence[int]) -> list[int]:
    """Inputs of components that no connection and no equation outside of these gives a value to."""

    def outside(name: str, row: Row) -> bool:
        return not name.startswith(f"{row.source.origin}.") if row.source.origin else True

    awaited = [c for c in columns if model.variables[names[c]].awaited]
    return [c for c in awaited if not any(outside(names[c], r) for r in rows if names[c] in _occurring(r))]


def _component(row: Row) -> str:
    return f"  (of {row.source.origin})" if row.source.origin else ""


def _list(names: Sequence[str], columns: Sequence[int]) -> str:
    if not columns:
        return "no unknown"
    return ", ".join(names[c] for c in columns[:8]) + (f" and {len(columns) - 8} more" if len(columns) > 8 else "")


def _notes(
    rows: list[Row], names: Sequence[str], model: flat.FlatModel, over: Sequence[int], columns: Sequence[int]
) -> list[tuple[flat.Span, str]]:
    equations = [(rows[r].source.span, f"equation  {rows[r].text}{_component(rows[r])}") for r in over[:12]]
    unknowns = [(model.variables[names[c]].span, f"unknown  {names[c]}") for c in columns[:12]]
    return equations + unknowns
