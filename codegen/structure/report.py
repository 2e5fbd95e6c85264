"""What the structural passes found, as text: states, dummy derivatives, blocks, tears, relations, aliases."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from lacuna.codegen.dae.discrete.events import DiscreteEquation, targets
from lacuna.codegen.dae.prepared import Prepared
from lacuna.codegen.emit.source import generate
from lacuna.codegen.flat.text import dump_flat
from lacuna.codegen.structure.causal import Division, LinearBlock, NonlinearBlock, Step
from lacuna.codegen.structure.nominal import difference
from lacuna.codegen.structure.sizes import Size
from lacuna.codegen.structure.sorting.tearing import Assignment
from lacuna.codegen.structure.system import Row
from lacuna.codegen.symbolic.expr import Expr, relation, to_text, var


def dump(prepared: Prepared, what: str) -> str:
    """`what` is flat, structure or c."""
    return {"flat": lambda: dump_flat(prepared.declared), "structure": lambda: structure(prepared),
            "c": lambda: generate(prepared)}[what]()  # fmt: skip


def structure(prepared: Prepared) -> str:
    """The structure report of a model."""
    system, form = prepared.system, prepared.residual
    sections = [
        ("states", system.states),
        ("dummy derivatives", system.dummies),
        ("differentiated equations", _differentiated(system.rows)),
        ("aliases", [f"{n} = {'-' if s < 0 else ''}{t}" for n, (t, s) in sorted(prepared.aliases.items())]),
        ("explicit form", _steps(prepared.explicit)),
        ("residual form: unknowns besides the states", [str(z.value) for z in form.tears]),
        ("residual form: residuals", [_row(row) for row in form.residuals]),
        ("relations", [_relation(prepared, k) for k in range(len(prepared.relations))]),
        ("nominal values", _nominals(prepared)),
        ("sample clocks", [f"{to_text(start)}, every {to_text(interval)} s" for start, interval in prepared.samples]),
        ("events, in order", [_event(step) for step in prepared.events]),
        ("initial system", ["start values of all states"] if prepared.initial.from_start
         else _steps(prepared.initial.steps)),
    ]  # fmt: skip
    return f"structure of {prepared.declared.name}\n" + "".join(_section(*s) for s in sections)


def _section(title: str, lines: Sequence[str]) -> str:
    body = "".join(f"  {line}\n" for line in lines)
    return f"\n{title} ({len(lines)})\n{body}"


def _row(row: Row) -> str:
    return f"{' '.join(row.text.split())}  // {row.source.span.line}"


def _differentiated(rows: Iterable[Row]) -> list[str]:
    return [_row(row) for row in rows if row.integral]


def _names(unknowns: Iterable[Expr]) -> str:
    return ", ".join(to_text(u) for u in unknowns)


def _steps(steps: Iterable[Step]) -> list[str]:
    lines = []
    for step in steps:
        match step:
            case Assignment():
                lines.append(f"{to_text(step.unknown)} := {to_text(step.value)}")
            case Division():
                lines.append(f"{to_text(step.unknown)} := from {_row(step.row)}, divisor checked")
            case LinearBlock() | NonlinearBlock():
                kind = "linear" if isinstance(step, LinearBlock) else "nonlinear"
                size = len(step.tears) + len(step.assignments)
                chain = _names(a.unknown for a in step.assignments)
                lines.append(f"{kind} block of {size}: tears {_names(step.tears)}; then {chain or 'nothing'}")
    return lines


def _relation(prepared: Prepared, k: int) -> str:
    r = prepared.relations[k]
    kind = "time" if r.slope is not None else "root"
    return f"rel[{k}] {kind}: {to_text(relation('>', r.left, r.right))}"


def _nominals(prepared: Prepared) -> list[str]:
    """Sizes by which tolerances and the hysteresis of events are measured, for the declared parameters, with the rule
    that gave each (codegen/structure/nominal.py)."""
    sizes, relations, model = prepared.nominals, prepared.relations, prepared.model
    unknowns = [*map(var, prepared.system.states), *prepared.residual.tears]
    lines = [f"{to_text(u)} {_size(sizes.get(u), 'its start, or 1')}" for u in unknowns]
    guards = (difference(r.left, r.right, sizes, model) for r in relations)
    return lines + [f"rel[{k}] {_size(g, 'its own range')}" for k, g in enumerate(guards) if relations[k].slope is None]


def _size(size: Size | None, unknown: str) -> str:
    if size is None:
        return f"= {unknown}"
    sign = ">=" if size.at_least else "="
    return f"{sign} {size.value:.6g}  // {to_text(size.expression)}{', ' if size.reason else ''}{size.reason}"


def _event(step: object) -> str:
    kind = "equation" if isinstance(step, DiscreteEquation) else type(step).__name__.lower()
    line = step.source.span.line if isinstance(step, DiscreteEquation) else step.span.line
    return f"{kind} for {', '.join(targets(step)) or 'nothing discrete'}  // {line}"
