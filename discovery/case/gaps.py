"""Recordings with stretches in which nobody knows what drove the machine: cut there, and taken up again after it.

Outputs may be missing as long as they like; a run does not need them. But no run can go on through a gap of the time,
or of an input that is interpolated. What comes after it is a recording of its own, whose states at its first sample
are unknown. In such pieces a recording may be cut on purpose, too: a run of one cannot go far from what was recorded.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise

import numpy as np

from lacuna.discovery.case.cases import Case, Recording
from lacuna.discovery.case.signals import Signal

GAP = 5.0  # a pause longer than this many intervals of a signal is a gap: an odd sample may be lost
MIN_SAMPLES = 50  # fewer say nothing of noise
JOINED = 4  # pieces that are made one at a time, where a run has been cut into some


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


def in_pieces(case: Case, count: int) -> Case:
    """The case with each of its recordings cut into `count` pieces of equal length."""
    fit, validate = ([piece for r in rs for piece in cut(r, case.inputs, count)] for rs in (case.fit, case.validate))
    return replace(case, fit=fit, validate=validate)


def cut(recording: Recording, inputs: list[Signal], count: int) -> Iterator[Recording]:
    """The recording in `count` pieces of equal length, the first with the start of the whole."""
    edges = np.linspace(0, len(recording.time), count + 1).astype(int)
    for begin, end in pairwise(edges):
        time, rows = recording.time[begin:end], slice(begin, end)
        piece = f"{recording.piece}+{begin}" if begin else recording.piece
        columns = {c: v[rows] for c, v in recording.columns.items()}
        drives = {s.column: _around(*recording.drive(s.column), time) for s in inputs}
        name, after_gap = f"{recording.name} from {time[0]:.6g} s", recording.after_gap or begin > 0
        yield replace(recording, name=name, piece=piece, time=time, columns=columns, drives=drives, after_gap=after_gap)


def _around(time: np.ndarray, values: np.ndarray, piece: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The samples of an input that drive a piece: those next to its ends too, as it holds or is on its way there."""
    good = np.isfinite(values)
    time, values = time[good], values[good]
    begin = max(int(np.searchsorted(time, piece[0], "right")) - 1, 0)
    rows = slice(begin, int(np.searchsorted(time, piece[-1])) + 1)
    return time[rows], values[rows]
