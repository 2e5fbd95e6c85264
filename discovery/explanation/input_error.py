"""Whether a finding is told from an error of what is recorded of an input: its offset."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from lacuna.discovery.case.cases import Recording, Signal
from lacuna.discovery.efforts.laws.screening import SAME
from lacuna.discovery.explanation.explanation import Explanation
from lacuna.discovery.fit.starts import STEP


def offset_instead(result: Explanation) -> tuple[Signal, float] | None:
    """(input, offset in SI) where a constant error of a recorded input does in all recordings what the only number of
    the only finding does, and is no larger than the input itself; None where there is no such input."""
    (first, *others), final = result.findings, result.final
    if others or len(first.ranked.candidate.free) != 1 or first.ranked.attachment.variable:
        return None
    (number,) = (f.name for f in first.ranked.candidate.free)
    value = final.point[number]
    own = _response(result, lambda r: (r, final.point | {number: value * (1 + STEP)}))
    for signal in result.case.inputs:
        largest = max(float(np.nanmax(np.abs(r.columns[signal.column]))) for r in result.case.fit)
        shift = STEP * largest
        moved = _response(result, lambda r, c=signal.column, by=shift: (_shifted(r, c, by), final.point))
        if own is None or moved is None or not np.any(moved):
            continue
        share = float(own @ moved) / float(moved @ moved)
        offset = -share * shift / STEP  # what is recorded less what acts
        if np.sum((own - share * moved) ** 2) < SAME * float(own @ own) and abs(offset) <= largest:
            return signal, offset
    return None


def _response(
    result: Explanation, changed: Callable[[Recording], tuple[Recording, dict[str, float]]]
) -> np.ndarray | None:
    """All outputs of the fit recordings, in units of their noise, less those of the final model as it is."""
    machine, point, rows = result.final.machine, result.final.point, []
    for recording in result.case.fit:
        before = machine.simulate(point, recording)
        other, there = changed(recording)
        after = machine.simulate(there, other)
        if before is None or after is None:
            return None
        rows += [(after[c] - before[c]) / noise.std for c, noise in result.final.noise.items()]
    return np.nan_to_num(np.concatenate(rows))


def _shifted(recording: Recording, column: str, offset: float) -> Recording:
    columns = recording.columns | {column: recording.columns[column] + offset}
    drives = {c: (t, v + offset if c == column else v) for c, (t, v) in recording.drives.items()}
    return replace(recording, name=f"{recording.name}/{column}+{offset:g}", columns=columns, drives=drives)
