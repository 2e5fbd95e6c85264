"""What drives the inputs of a model: constants, samples, columns of recordings."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np

from lacuna.analysis.recording.formats import read_recorded
from lacuna.errors import UserError, nearest
from lacuna.recorded_units import UnitError, factor_into, to_si
from lacuna.runtime import RecordedInput
from lacuna.runtime.model import Variable

ROUNDING = 1e-12  # of times that were written with all their digits


@dataclass(frozen=True, eq=False)
class Measured(RecordedInput):
    """Samples of a file: `values` in `unit`, which is SI, or "" where the file says none. `inferred`: the unit that the
    name of the column ends like, if nothing else says one; it is believed where the input is of that quantity.
    `unread`: what the file says is the unit, and is none. `gap`: the longest stretch in which samples lack, s. `notes`:
    what was assumed of the file."""

    unit: str = ""
    source: str = ""
    inferred: str = ""
    unread: str = ""
    gap: tuple[float, float] | None = None
    notes: tuple[str, ...] = ()


Input = float | RecordedInput | tuple[Any, Any]
"""A constant, a recording, or a pair (times in s, values): linear between samples, the first and last hold outside."""


def recorded(file: str | Path, column: str, *, hold: bool = False) -> RecordedInput:
    """A channel of a recording, in any format that is read, as an input; linear between samples, or held with `hold`.

    Values are converted to SI where the file says a unit, and by a run into the unit that the input declares. A unit
    that is only the end of the name (u_mV) waits for the run: part of the name where the input is of another quantity.
    Raises UserError with the nearest names where there is none of this name.
    """
    found = read_recorded(file)
    try:
        channel = found[column]
    except KeyError:
        names = [c.name for c in found.channels]
        raise UserError(f"{file} has no column called {column}{nearest(column, names)}") from None
    present = np.isfinite(channel.values)
    said = channel.unit if channel.head.sure else ""
    factor, unit = to_si(said) if said else (1.0, "")
    values, inferred = channel.values[present] * factor, "" if said else channel.unit
    source, unread = f"{file}: {column}", channel.head.unread
    gap = _longest_gap(channel.time, present)
    kind: Literal["linear", "hold"] = "hold" if hold else "linear"
    return Measured(channel.time[present], values, kind, unit, source, inferred, unread, gap, tuple(found.notes))


def _longest_gap(time: np.ndarray, present: np.ndarray) -> tuple[float, float] | None:
    """Begin and end of the longest stretch of empty cells that is more than a sample of the channel's own rate, which
    may be lower than that of the file."""
    kept, spacing = np.flatnonzero(present), np.diff(time[present])
    alone = spacing.size == 1  # two samples have no rate that could be lower
    lacking = (
        (np.diff(kept) > 1) & ((spacing > 1.5 * np.median(spacing)) | alone) if spacing.size else np.zeros(0, bool)
    )
    if not lacking.any():
        return None
    longest = int(np.argmax(np.where(lacking, spacing, 0.0)))
    return float(time[kept[longest]]), float(time[kept[longest + 1]])


def as_inputs(given: Mapping[str, Input], variables: Mapping[str, Variable]) -> dict[str, RecordedInput | float]:
    """In the form that the runtime takes; samples with a unit in the unit of the variable that they drive. Raises
    UserError where they are another quantity."""
    refuse_truth(given, variables)
    return {name: _one(name, value, variables) for name, value in given.items()}


def check_kinds(**given: Any) -> None:
    """Raises UserError for what is no mapping from names, or, of `outputs` and `sensitivities`, no list of them."""
    for what, value in given.items():
        listed = what in ("outputs", "sensitivities")
        right = isinstance(value, Mapping) if not listed else isinstance(value, Iterable) and not isinstance(value, str)
        if value is not None and not (right and all(isinstance(name, str) for name in value)):
            wanted = "a list of names" if listed else "values by name, as {'R': 2.0}"
            raise UserError(f"{what} is {wanted}, not {str(value)[:40]}")


def refuse_truth(given: Mapping[str, Any], variables: Mapping[str, Variable]) -> None:
    """Raises UserError where true or false is given to a variable that is a number."""
    for name, value in given.items():
        if isinstance(value, bool | np.bool_) and name in variables and variables[name].type != "Boolean":
            raise UserError(f"{name} cannot be {str(value).lower()}: it is {variables[name].type}")


def as_numbers(given: Mapping[str, Any], variables: Mapping[str, Variable]) -> dict[str, float]:
    """Values of parameters and start values. Raises UserError for what is no number, or none of its variable's type."""
    refuse_truth(given, variables)
    return {name: _number(name, value) for name, value in given.items()}


def _number(name: str, value: Any) -> float:
    try:
        if isinstance(value, str):
            raise TypeError
        return float(value)
    except (TypeError, ValueError, OverflowError):
        raise UserError(f"{name} cannot be {str(value)[:40]!r}: that is no number") from None


def uncovered(given: Mapping[str, Input], start: float, stop: float) -> list[str]:
    """A warning for each input whose samples begin later than the run from `start` to `stop` (s) does, rounding aside,
    or end earlier by more than their spacing: there a sample is held. Raises UserError where none is inside."""
    said = []
    for name, value in given.items():
        if not isinstance(value, RecordedInput):
            continue
        first, last, spacing = float(value.time[0]), float(value.time[-1]), np.diff(value.time)
        late = first - start > ROUNDING * max(abs(first), abs(start), stop - start)
        if late or stop - last > spacing[-1:].sum():
            span = f"samples from {first:.9g} to {last:.9g} s, a run from {start:.9g} to {stop:.9g} s"
            if first > stop or last < start:
                raise UserError(f"input {name}: {span}: none is in the run; begin it there by --start")
            said.append(f"warning: input {name}: {span}; outside of them the first or last value is held")
    return said


def assumed(given: Mapping[str, Input], variables: Mapping[str, Variable]) -> list[str]:
    """A warning for each input of samples of which some lack, or whose unit is not known, or hangs on the end of their
    name alone."""
    said = []
    for name, value in given.items():
        said += [f"warning: input {name}: {note}" for note in value.notes] if isinstance(value, Measured) else []
        if isinstance(value, Measured) and value.gap is not None:
            bridged = "held" if value.interpolation == "hold" else "bridged by a straight line"
            between = f"between {value.gap[0]:g} and {value.gap[1]:g} s, the longest gap"
            said.append(f"warning: input {name}: {value.source} lacks samples, {between}; they are {bridged}")
        if isinstance(value, Measured) and value.unread:
            said.append(
                f"warning: input {name}: {value.source} is taken as it is: {value.unread} is no unit known here"
            )
        elif isinstance(value, Measured) and value.inferred and name in variables:
            fits = _inferred_factor(value, variables[name].unit) is not None
            own = value.source.endswith(f": {name}")  # the end of the variable's own name is no unit
            if to_si(value.inferred)[0] != 1.0 if fits else not own:
                taken = f"taken to be in {value.inferred}" if fits else f"taken as it is, not in {value.inferred}"
                said.append(f"warning: input {name}: {value.source} is {taken}; write units in brackets: name [unit]")
    return said


def _inferred_factor(value: Measured, declared: str) -> float | None:
    """By what samples are multiplied if their inferred unit is one of the variable's; None where it is not."""
    try:
        factor, si = to_si(value.inferred)
        return factor * factor_into(declared, si) if declared else None
    except UnitError:
        return None


def _one(name: str, value: Input, variables: Mapping[str, Variable]) -> RecordedInput | float:
    if isinstance(value, tuple):
        try:
            times, values = (np.asarray(part, dtype=float) for part in value)
        except (TypeError, ValueError):
            raise UserError(
                f"the input {name} is a number, a recording, or (times, values): two lists of numbers"
            ) from None
        return RecordedInput(times, values)
    if isinstance(value, Measured) and value.inferred and name in variables:
        factor = _inferred_factor(value, variables[name].unit) or 1.0
        return RecordedInput(value.time, factor * value.values, value.interpolation)
    if isinstance(value, Measured) and value.unit and name in variables:
        try:
            factor = factor_into(variables[name].unit, value.unit)
        except UnitError as error:
            raise UserError(f"{value.source} cannot drive {name}: {error}") from None
        return RecordedInput(value.time, factor * value.values, value.interpolation)
    return value if isinstance(value, RecordedInput) else _number(name, value)
