"""Recordings with stretches in which nobody knows what drove the machine: cut there, and taken up again after it.

Outputs may be missing as long as they like; a run does not need them. But no run can go on through a gap of the time,
or of an input that is interpolated. What comes after it is a recording of its own, whose states at its first sample
are unknown.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from lacuna.discovery.case.cases import Case, Recording, Signal

GAP = 5.0  # a pause longer than this many intervals of a signal is a gap: an odd sample may be lost
MIN_SAMPLES = 50  # fewer say nothing of noise


def gaps(recording: Recording, inputs: list[Signal]) -> list[tuple[str, float, float]]:
    """(column, begin, end) in s of each stretch through which no run can go, in the order of time."""
    times = {"time": recording.time}
    for signal in inputs:
        if signal.interpolation == "linear":
            times[signal.column] = recording.time[np.isfinite(recording.columns[signal.column])]
    found = sorted((*ends, column) for column, own in times.items() for ends in _pauses(own))
    apart = [g for k, g in enumerate(found) if not any(g[0] < end for _, end, _ in found[:k])]
    return [(column, begin, end) for begin, end, column in apart]


def _pauses(time: np.ndarray) -> Iterator[tuple[float, float]]:
    steps = np.diff(time)
    for k in np.flatnonzero(steps > GAP * np.median(steps)) if len(steps) else ():
        yield float(time[k]), float(time[k + 1])


def without_gaps(case: Case) -> Case:
    """The case with its recordings cut at gaps; parts that are too short are left out."""
    return replace(
        case,
        fit=[part for r in case.fit for part in _parts(r, case.inputs)],
        validate=[part for r in case.validate for part in _parts(r, case.inputs)],
    )


def before_gaps(case: Case) -> tuple[Case, list[str]]:
    """(a case that was cut at gaps without what comes after one: its states are unknown, and a model file as it is
    written fits none; what was left out)."""
    fit, validate = ([r for r in some if not r.after_gap] for some in (case.fit, case.validate))
    left_out = [r.name for r in (*case.fit, *case.validate) if r.after_gap]
    return replace(case, fit=fit, validate=validate), left_out


def _parts(recording: Recording, inputs: list[Signal]) -> list[Recording]:
    found = gaps(recording, inputs)
    if not found:
        return [recording]
    begins = [float(recording.time[0]), *(end for _, _, end in found)]
    ends = [*(begin for _, begin, _ in found), float(recording.time[-1])]
    parts = []
    for number, (begin, end) in enumerate(zip(begins, ends, strict=True), 1):
        rows = (recording.time >= begin) & (recording.time <= end)
        if rows.sum() < MIN_SAMPLES:
            continue
        name = recording.name if number == 1 else f"{recording.name}[{number}]"
        columns = {c: v[rows] for c, v in recording.columns.items()}
        parts.append(Recording(name, recording.time[rows], columns, recording.file, after_gap=number > 1))
    return parts
