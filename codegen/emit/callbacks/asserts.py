"""Asserts: their order in the table, the C of their checks, and the values that a violated one shows.

One of level warning is noted, once in a run, where it is violated at a point that the run has accepted. Functions are
evaluated at others too: there only those of level error count.
"""

from __future__ import annotations

from collections.abc import Callable

from lacuna.codegen import flat
from lacuna.codegen.dae.discrete.events import DiscreteEquation
from lacuna.codegen.dae.prepared import Prepared
from lacuna.codegen.dae.storage import Storage
from lacuna.codegen.emit.functions.endless import has_row, row_of
from lacuna.codegen.emit.text.body import Body
from lacuna.codegen.errors import Span
from lacuna.codegen.symbolic.expr import FALSE, Expr, walk
from lacuna.codegen.symbolic.leaves import leaves
from lacuna.codegen.symbolic.rewrite import all_statements


def all_asserts(p: Prepared) -> list[flat.Assert]:
    """Asserts in the order of the descriptor: those of the model, of its when clauses, of its functions, and
    functions themselves."""
    functions = p.model.functions
    inside = [a for a in _inside([f.body for f in functions.values()]) if a.level == "error"]
    ends = [row_of(f) for f in functions.values() if has_row(f, functions)]
    return [*_told(p.model.asserts), *_told(_event_asserts(p)), *inside, *ends]


def assert_rows(p: Prepared) -> Callable[[flat.Assert], int]:
    """What gives the row of an assert in the table."""
    rows: dict[tuple[Span, str], int] = {}
    for k, a in enumerate(all_asserts(p)):
        rows.setdefault((a.span, a.origin), k)
    return lambda s: rows[s.span, s.origin]


def of_parameters(p: Prepared) -> list[tuple[int, flat.Assert]]:
    """(row, assert) of those of the model that depend on parameters alone: they are checked before anything else."""
    return [(k, a) for k, a in enumerate(_told(p.model.asserts)) if _is_of_parameters(p.storage, a.condition)]


def of_the_run(p: Prepared) -> list[tuple[int, flat.Assert]]:
    """(row, assert) of those of the model that depend on what changes."""
    early = {k for k, _ in of_parameters(p)}
    return [(k, a) for k, a in enumerate(_told(p.model.asserts)) if k not in early]


def can_be_violated(p: Prepared) -> bool:
    """Whether anything is left to check, or to tell, once a run has its parameters."""
    return len(all_asserts(p)) > len(of_parameters(p))


def write_assert(body: Body, check: flat.Assert, row: int) -> None:
    condition = check.condition
    if check.level == "warning":
        body.line(warned(body.value(condition), row))
        return
    body.line(f"if (!({body.value(condition)})) {{")
    body.line(f"  (void)mdl_fail(m, MDL_FAILURE_ASSERT, {row}, 0.0);")
    body.line("  return -1;")
    body.line("}")


def warned(condition: str, row: int | str) -> str:
    return f"if (!({condition})) m->warned[{row}] |= 1;"


def shown_values(p: Prepared) -> list[list[str]]:
    """Of each assert in the table, the variables whose values explain a violation, in the order of its condition and
    its message.

    In a when clause a discrete variable may be about to change: what is stored is not what was compared, and it is left
    out. The variables of a function have no place in the table.
    """
    values = [_variables(a) for a in _told(p.declared.asserts)]
    for a in _told(_event_asserts(p)):
        values.append([n for n in _variables(a) if (slot := p.storage.slot(n)) and slot.array != "d"])
    return values + [[] for _ in range(len(all_asserts(p)) - len(values))]


def is_told(check: flat.Assert) -> bool:
    """False for what stands for the call of a function that prints."""
    return check.level == "error" or check.condition is not FALSE


def _told(asserts: list[flat.Assert]) -> list[flat.Assert]:
    return [a for a in asserts if is_told(a)]


def _event_asserts(p: Prepared) -> list[flat.Assert]:
    return _inside([[step] if isinstance(step, flat.When) else step.statements for step in p.events
                    if not isinstance(step, DiscreteEquation)])  # fmt: skip


def _inside(bodies: list[list[flat.Statement]]) -> list[flat.Assert]:
    return [s for body in bodies for s in all_statements(body) if isinstance(s, flat.Assert)]


def _is_of_parameters(storage: Storage, condition: Expr) -> bool:
    slots = [storage.slot(str(n.value)) if n.op == "var" else None for n in leaves(condition)]
    return all(slot is not None and slot.array == "p" for slot in slots)


def _variables(check: flat.Assert) -> list[str]:
    found = leaves(check.condition)
    compared = [str(n.value) for n in walk(check.condition) if n.op == "var" and n in found]
    return list(dict.fromkeys([*compared, *check.shown]))
