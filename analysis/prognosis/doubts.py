"""Why no number may be trusted of a history whose rows contradict each other in how they count use."""

from __future__ import annotations

from collections.abc import Sequence
import math

import numpy as np

from lacuna.analysis.errors import AnalysisError

UNITS = ("cycles", "hours")
SAME_SCALE = 8.0  # by which hours a cycle may differ within one actuator before units are taken to be mixed


def doubts_of(file: object, lines: Sequence[int], use: np.ndarray, other: np.ndarray, unit: str) -> tuple[str, ...]:
    """Sentences, none where all is well. `use` [rows] rises strictly, in `unit`; `other` is use in the other unit, NaN
    where it is not known; `lines` say where in `file` a row is. Raises AnalysisError where `other` falls."""
    return (*_mixed(file, lines, use, other, unit), *_spacing(file, lines, use))


def _mixed(file: object, lines: Sequence[int], use: np.ndarray, other: np.ndarray, unit: str) -> list[str]:
    """A doubt where use in one unit and in the other do not go together."""
    known = np.flatnonzero(np.isfinite(other))
    steps, others = np.diff(use[known]), np.diff(other[known])
    if len(steps) < 2:
        return []
    if np.any(others <= 0):
        line = lines[known[int(np.flatnonzero(others <= 0)[0]) + 1]]
        raise AnalysisError(f"{file}:{line}: {UNITS[1 - UNITS.index(unit)]} do not increase with {unit}")
    ratio = others / steps
    far = np.abs(np.log(ratio / np.median(ratio))) > math.log(SAME_SCALE)
    if not far.any():
        return []
    line = lines[known[int(np.flatnonzero(far)[0]) + 1]]
    return [f"{file}:{line}: hours and cycles do not go together here as in the other rows: are units mixed?"]


def _spacing(file: object, lines: Sequence[int], use: np.ndarray) -> list[str]:
    """A doubt where from some row on tests are spaced as if counted in another unit: all of them wider, or all closer,
    than all before."""
    steps = np.log(np.diff(use))
    if len(steps) < 6:
        return []
    below, above = np.minimum.accumulate(steps)[:-1], np.maximum.accumulate(steps)[:-1]  # of the steps before each
    least, most = (f.accumulate(steps[::-1])[::-1][1:] for f in (np.minimum, np.maximum))  # and of those from it on
    for k in np.flatnonzero((least > above) | (most < below)) + 1:
        if 3 <= k < len(steps) - 2 and abs(np.median(steps[k:]) - np.median(steps[:k])) > math.log(SAME_SCALE):
            return [f"{file}:{lines[k + 1]}: from here on tests are spaced otherwise: are hours and cycles mixed?"]
    return []
