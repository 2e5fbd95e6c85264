"""What the inputs may do in a further experiment: what case.toml allows, else what has been recorded."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lacuna.discovery.case.cases import Case, Limit, Recording
from lacuna.discovery.case.signals import Signal

ALIKE = 0.95  # correlation from which one input is the derivative of another


@dataclass(frozen=True)
class Range:
    """An input's least and greatest value and its fastest change per second, in the model's unit; `start` is where it
    begins. One that `counts` has whole values only."""

    low: float
    high: float
    rate: float
    start: float
    counts: bool = False

    @property
    def moves(self) -> bool:
        """Whether it may change at all: an input that was held as it was has no limits that a case could name."""
        return self.low < self.high and self.rate > 0


def ranges(case: Case) -> dict[str, Range]:
    """The range of every input. What case.toml leaves out is as recorded."""
    return {s.column: _range(case, s) for s in case.inputs}


def _range(case: Case, signal: Signal) -> Range:
    limit = case.limits.get(signal.column, Limit())
    recorded = [r.columns[signal.column] for r in [*case.fit, *case.validate]]
    rates = [_fastest(r, signal.column) for r in [*case.fit, *case.validate]]
    low = min(float(np.nanmin(v)) for v in recorded) if limit.min is None else limit.min
    high = max(float(np.nanmax(v)) for v in recorded) if limit.max is None else limit.max
    first = longest(case).columns[signal.column]
    start = float(first[np.flatnonzero(np.isfinite(first))[0]])
    rate = max(rates) if limit.rate is None else limit.rate
    return Range(low, max(low, high), rate, float(np.clip(start, low, high)), signal.counts)


def longest(case: Case) -> Recording:
    """The recording of the longest time: so long, at least, the machine can be recorded."""
    return max(case.fit, key=lambda r: r.time[-1] - r.time[0])


def _fastest(recording: Recording, column: str) -> float:
    good = np.isfinite(recording.columns[column])
    time, values = recording.time[good], recording.columns[column][good]
    return float(np.max(np.abs(np.diff(values) / np.diff(time)), initial=0.0))


def derivatives(case: Case) -> dict[str, str]:
    """Inputs that are the derivative of another one (an imposed speed beside its angle), with that one."""
    found: dict[str, str] = {}
    for b in case.inputs:
        for a in case.inputs:
            if a is not b and found.get(a.column) != b.column and _is_derivative(longest(case), a.column, b.column):
                found[b.column] = a.column
    return found


def _is_derivative(recording: Recording, of: str, column: str) -> bool:
    slope = np.gradient(np.nan_to_num(recording.columns[of]), recording.time)
    other = np.nan_to_num(recording.columns[column])
    power = float(np.linalg.norm(slope) * np.linalg.norm(other))
    return power > 0 and float(slope @ other) > ALIKE * power
