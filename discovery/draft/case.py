"""A case folder from a model and recordings: columns matched, units proposed, noise estimated, recordings divided."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
import shutil

import numpy as np

from lacuna.analysis.recording.channel import not_rising
from lacuna.analysis.recording.heads import Head
from lacuna.codegen.compile import compile_model
from lacuna.codegen.library.search_path import search_path, split_name
from lacuna.discovery.case import noise
from lacuna.discovery.case.problem import CaseError
from lacuna.discovery.case.signals import in_unit, signal_of
from lacuna.discovery.draft.match import Match, Target, matched
from lacuna.discovery.draft.recorded import Recording, parted, read_recording, write_recorded
from lacuna.discovery.draft.write import Column, Draft, case_toml
from lacuna.recorded_units import ZERO_CELSIUS
from lacuna.runtime import Model
from lacuna.written import whole_files

AT_REST = 3.0  # standard deviations of its noise that the first sample of a machine at rest may be away from zero
JUDGES = 4  # one of so many recordings is kept to judge


@dataclass(frozen=True)
class NewCase:
    """`path` of case.toml, what each column was taken for, and what somebody who knows the machine should look at."""

    path: Path
    matches: tuple[Match, ...]
    unsure: tuple[str, ...]


def new_case(name: str, data: Sequence[Path], out: Path, libraries: Sequence[Path] = ()) -> NewCase:
    """Write `out`/case.toml, the recordings beside it in the format of a case, and a copy of a model's own file.

    `name` is the model as everywhere: a qualified name, a .mo file, or a class in one. Raises Diagnostic where it is no
    model, CaseError and RecordingError where the recordings do not fit; then nothing is written.
    """
    if (out / "case.toml").exists():
        raise CaseError(f"{out / 'case.toml'}: is there already; choose another folder")
    if not data:
        raise CaseError("no recordings are given")
    model = Model(compile_model(name, search_path=search_path(libraries)).path)
    recorded = _distinct([read_recording(path) for path in data])
    for one in recorded:
        if disorder := not_rising(one.time):
            raise CaseError(f"{one.name}: {disorder[1]}; was it written with too few digits?")
    matches = matched(_common_heads(recorded), _targets(model))
    recorded = [_kelvins(one, matches) for one in recorded]
    matches = matched(recorded[0].heads, _targets(model))
    recorded = [replace(one, heads=tuple(match.head for match in matches)) for one in recorded]
    if not any(m.target and not m.target.is_input for m in matches):
        raise CaseError(f"no column of {recorded[0].name} fits a variable of {name} by its name or its unit")
    missing = sorted(
        set(model.inputs) - {m.target.name for m in matches if m.target} - _aliases_of_matched(model, matches)
    )
    fit, validate = _divided(recorded)
    draft = Draft(
        model=_beside(name),
        libraries=tuple(str(path.resolve()) for path in libraries),
        recordings=tuple(r.name for r in recorded),
        columns=tuple(_column(match, recorded) for match in matches),
        initial=_initial(model, matches, recorded),
        parameters={n: (v.start, v.unit, v.description) for n, v in model.parameters.items()},
        fit=tuple(r.name for r in fit),
        validate=tuple(r.name for r in validate),
        notes=tuple(f"{r.name}: {note}" for r in recorded for note in r.notes),
        missing=tuple(missing),
        parted=len(recorded) == 1,
    )
    text, unsure = case_toml(draft)
    kept = [k for k, match in enumerate(matches) if match.target]
    _write(out, text, [*fit, *validate], kept, split_name(name)[0])
    return NewCase(out / "case.toml", tuple(matches), unsure)


def _beside(name: str) -> str:
    """The model as case.toml names it, beside which its own file is copied."""
    file, inner = split_name(name)
    return name if file is None else file.name + (f":{inner}" if inner else "")


def _kelvins(recorded: Recording, matches: Sequence[Match]) -> Recording:
    """Temperatures on the scale of the variable that they record: the scales differ by more than a factor."""
    heads, columns, notes = list(recorded.heads), list(recorded.columns), list(recorded.notes)
    for k, (head, match) in enumerate(zip(recorded.heads, matches, strict=True)):
        pair = (head.unit, match.target.unit if match.target else "")
        if pair in (("degC", "K"), ("K", "degC")):
            columns[k] = columns[k] + (ZERO_CELSIUS if pair[0] == "degC" else -ZERO_CELSIUS)
            heads[k] = replace(head, unit=pair[1])
            notes.append(f"`{head.text}` was converted from {pair[0]} to {pair[1]}, the unit of {match.target.name}")
    return replace(recorded, heads=tuple(heads), columns=tuple(columns), notes=tuple(notes))


def _targets(model: Model) -> list[Target]:
    """All variables that may be recorded: parameters and derivatives are not, and a switch only where it drives."""
    return [
        Target(name, v.unit, v.kind == "input", v.description, discrete=v.type != "Real")
        for name, v in model.variables.items()
        if v.kind not in ("parameter", "derivative") and (v.type == "Real" or v.kind == "input")
    ]


def _aliases_of_matched(model: Model, matches: Sequence[Match]) -> set[str]:
    """Inputs that are driven already under another name."""
    driven = {model.variables[m.target.name].index for m in matches if m.target and m.target.is_input}
    return {name for name, v in model.inputs.items() if v.index in driven}


def _common_heads(recorded: Sequence[Recording]) -> tuple[Head, ...]:
    first = recorded[0]
    for other in recorded[1:]:
        if [h.text for h in other.heads] != [h.text for h in first.heads]:
            raise CaseError(
                f"{other.name} has the columns {', '.join(h.text for h in other.heads)}, {first.name} has "
                f"{', '.join(h.text for h in first.heads)}: recordings of one case record the same signals"
            )
    return first.heads


def _distinct(recorded: list[Recording]) -> list[Recording]:
    names = [r.name for r in recorded]
    twice = {name for name in names if names.count(name) > 1}
    if twice:
        raise CaseError(f"two recordings would both be called {', '.join(sorted(twice))}; rename one")
    return recorded


def _divided(recorded: Sequence[Recording]) -> tuple[list[Recording], list[Recording]]:
    """To fit and to judge: the last fourth judges, of a single recording its last stretch."""
    if len(recorded) == 1:
        fit, validate = parted(recorded[0])
        return [fit], [validate]
    judges = max(1, len(recorded) // JUDGES)
    return list(recorded[:-judges]), list(recorded[-judges:])


def _column(match: Match, recorded: Sequence[Recording]) -> Column:
    k = recorded[0].heads.index(match.head)
    pieces = [r.columns[k] for r in recorded]
    finite = np.concatenate([p[np.isfinite(p)] for p in pieces])
    level = noise.estimate(pieces).std if len(finite) else 0.0
    steps = len(finite) > noise.MANY and noise.of_few_levels(finite)
    return Column(match, level, steps)


def _initial(model: Model, matches: Sequence[Match], recorded: Sequence[Recording]) -> dict[str, str]:
    """Of each state: "recorded" where a column records it; "unknown" where the machine is not at rest at the start."""
    seen = {m.target.name: m for m in matches if m.target and not m.target.is_input}
    by_storage = {(model.variables[n].kind, model.variables[n].index): n for n in seen}
    result: dict[str, str] = {}
    for name, state in {
        v.index: (n, v) for n, v in reversed(model.states.items())
    }.values():  # each once, not its aliases
        recorded_as = by_storage.get((state.kind, state.index))
        if recorded_as:
            result[recorded_as] = "recorded"
        elif len(recorded) == 1 or not _at_rest(model, seen.values(), recorded):
            result[name] = "unknown"  # the second stretch of a single recording begins anywhere
    return result


def _at_rest(model: Model, outputs: Iterable[Match], recorded: Sequence[Recording]) -> bool:
    """Every output begins in every recording where the model has it at the start, as far as its noise tells."""
    for match in outputs:
        k = recorded[0].heads.index(match.head)
        level = noise.estimate([r.columns[k] for r in recorded]).std
        variable = model.variables[match.target.name]
        column = signal_of(Path("case.toml"), match.head.name, {"role": "output", "unit": match.head.unit or "1"})
        column = in_unit(column, variable.unit)
        start = (variable.start - column.offset) / column.scale
        if any(not abs(r.columns[k][0] - start) <= AT_REST * level for r in recorded):
            return False
    return True


def _write(out: Path, text: str, recorded: Sequence[Recording], kept: Sequence[int], file: Path | None) -> None:
    """All of it, or nothing."""
    with whole_files(out) as scratch:
        (scratch / "case.toml").write_text(text, encoding="utf-8")
        for one in recorded:
            write_recorded(one, kept, scratch / one.name)
        if file is not None:
            (shutil.copytree if file.is_dir() else shutil.copy2)(file, scratch / file.name)
