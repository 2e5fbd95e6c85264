"""Whether a finding is told from what else the inputs say: an offset of what is recorded of one, another one that moves
as the one does of which it is a law."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from lacuna.discovery.case.cases import Recording
from lacuna.discovery.case.signals import Signal
from lacuna.discovery.efforts.laws.screening import SAME
from lacuna.discovery.explanation.explanation import Explanation
from lacuna.discovery.fit.fit import Fit
from lacuna.discovery.fit.starts import STEP


def offset_instead(result: Explanation) -> tuple[Signal, float] | None:
    """(input, offset in SI) where a constant error of a recorded input does in all recordings what the only number of
    the only finding does, and is no larger than the input itself; None where there is no such input."""
    (first, *others), final, recordings = result.findings, result.final, result.case.fit
    if others or len(first.ranked.candidate.free) != 1 or first.ranked.attachment.variable:
        return None
    (number,) = (f.name for f in first.ranked.candidate.free)
    before = _outputs(final, final.point, recordings)
    after = _outputs(final, final.point | {number: final.point[number] * (1 + STEP)}, recordings)
    if before is None or after is None:
        return None
    own = after - before
    for signal in (s for s in result.case.inputs if not s.counts):
        column = signal.column
        largest = max(float(np.nanmax(np.abs(r.columns[column]))) for r in recordings)
        shift = STEP * largest
        moving = {column: lambda values, shift=shift: values + shift}
        shifted = _outputs(final, final.point, [r.redriven(f"{column}{shift:+g}", moving) for r in recordings])
        if shifted is None or not np.any(moved := shifted - before):
            continue
        share = float(own @ moved) / float(moved @ moved)
        offset = -share * shift / STEP  # what is recorded less what acts
        if np.sum((own - share * moved) ** 2) < SAME * float(own @ own) and abs(offset) <= largest:
            return signal, offset
    return None


def moved_as_one(result: Explanation) -> tuple[Signal, Signal] | None:
    """(the input that the only finding is a law of alone, another one that is in proportion to it in all recordings):
    a law of either would do the same. None where there are no such inputs."""
    (first, *others), inputs = result.findings, result.case.inputs
    read = {variable for _, variable in first.ranked.attachment.signals}
    own = next((s for s in inputs if {s.variable} == read), None)
    if others or own is None:
        return None
    course = _course(result, own)
    for signal in inputs:
        if signal is not own and _in_proportion(course, _course(result, signal)):
            return own, signal
    return None


def _course(result: Explanation, signal: Signal) -> np.ndarray:
    return np.concatenate([r.columns[signal.column] for r in (*result.case.fit, *result.case.validate)])


def _in_proportion(one: np.ndarray, other: np.ndarray) -> bool:
    both = np.isfinite(one) & np.isfinite(other)
    one, other = one[both], other[both]
    left = one - other * (one @ other) / max(float(other @ other), 1e-300)
    return bool(np.ptp(one) > 0 and np.sum(left**2) < SAME**2 * float(one @ one))


def _outputs(final: Fit, point: Mapping[str, float], recordings: Sequence[Recording]) -> np.ndarray | None:
    """All outputs along recordings, in units of their noise; None where a run fails."""
    runs = [final.machine.simulate(point, r) for r in recordings]
    if any(run is None for run in runs):
        return None
    return np.concatenate([run[c] / noise.std for run in runs for c, noise in final.noise.items()])
