"""What is wrong with a recording, seen before any model is believed: each problem with its column and time.

A `fatal` problem makes every conclusion worthless (time runs backwards, a signal is frozen); the others are
said in the report and the samples concerned are left out.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass

import numpy as np

from lacuna.discovery.case.cases import Case, Recording, Signal
from lacuna.discovery.case.noise import level, quantum

MIN_SAMPLES = 50
GAP = 5.0  # a pause longer than this many sample intervals is a gap
FROZEN_RUN = 25  # equal samples in a row that noise above the resolution cannot give
CLIPPED_RUN, CLIPPED_SHARE = 5, 0.003  # equal samples in a row, and in all, at the end of a noisy signal's range


@dataclass(frozen=True)
class Problem:
    kind: str
    recording: str
    column: str
    time: float | None
    text: str
    fatal: bool

    def __str__(self) -> str:
        where = f"{self.recording}, column `{self.column}`" + (
            f", t = {self.time:.6g} s" if self.time is not None else ""
        )
        return f"{where}: {self.text}"

    def as_dict(self) -> dict:
        return asdict(self)


def check_case(case: Case) -> list[Problem]:
    """Every problem of every recording of the case, fatal ones first."""
    problems = [p for r in case.fit + case.validate for p in check_recording(r, case.signals)]
    problems += _constant(case)
    return sorted(problems, key=lambda p: not p.fatal)


def check_recording(recording: Recording, signals: dict[str, Signal]) -> list[Problem]:
    problems = _check_time(recording)
    if any(p.fatal for p in problems):
        return problems
    for signal in signals.values():
        values = recording.columns[signal.column]
        problems += _missing(recording, signal, values)
        if signal.role == "output":  # a command may stand, jump and end where it likes
            problems += _clipped(recording, signal, values) or _frozen(recording, signal, values)
            problems += _outliers(recording, signal, values)
    return problems


def _check_time(recording: Recording) -> list[Problem]:
    time, name = recording.time, recording.name

    def fatal(kind: str, at: float | None, text: str) -> list[Problem]:
        return [Problem(kind, name, "time", at, text, True)]

    if len(time) < MIN_SAMPLES:
        begin = float(time[0]) if len(time) else None
        return fatal("too_short", begin, f"only {len(time)} samples; at least {MIN_SAMPLES} are needed")
    if not np.all(np.isfinite(time)):
        k = int(np.flatnonzero(~np.isfinite(time))[0])
        return fatal(
            "time_missing", float(time[k - 1]) if k else None, f"the time of sample {k + 1} is missing or not a number"
        )
    steps = np.diff(time)
    if np.any(steps <= 0):
        k = int(np.flatnonzero(steps <= 0)[0])
        return fatal("time_order", float(time[k + 1]), f"time does not increase (after {time[k]:.6g} s)")
    usual = float(np.median(steps))
    gaps = np.flatnonzero(steps > GAP * usual)
    return [
        Problem("gap", name, "time", float(time[k]), f"gap of {steps[k]:.4g} s where samples are {usual:.4g} s apart",
                bool(steps[k] > 0.02 * (time[-1] - time[0])))
        for k in gaps
    ]  # fmt: skip


def _missing(recording: Recording, signal: Signal, values: np.ndarray) -> list[Problem]:
    bad = ~np.isfinite(values)
    if not bad.any():
        return []
    first, share = int(np.flatnonzero(bad)[0]), float(bad.mean())
    longest = longest_run(bad)[1]
    fatal = share > 0.2 or (signal.role == "input" and longest > 3)
    text = f"{bad.sum()} samples are missing or not numbers ({share:.1%}, {longest} in a row)"
    return [Problem("missing_samples", recording.name, signal.column, float(recording.time[first]), text, fatal)]


def _noisy(values: np.ndarray, signal: Signal) -> bool:
    """Whether noise changes the value from sample to sample even at rest (so that equal samples are no rest).

    The noise that the case states counts too: that of a signal which is frozen for long cannot be seen any more.
    """
    finite = values[np.isfinite(values)]
    step = quantum(finite)
    if len(finite) <= 100 or len(np.unique(finite)) < 8:  # too few values to tell its resolution
        return False
    return max(level([finite]), signal.noise_std or 0.0) > 1.5 * step


def _frozen(recording: Recording, signal: Signal, values: np.ndarray) -> list[Problem]:
    same = np.concatenate([np.diff(values) == 0, [False]])
    start, length = longest_run(same)
    if length < FROZEN_RUN:
        return []
    end = start + length
    if _noisy(values, signal):
        reason = "its noise has stopped"
    elif _jumps(values, start - 1, end):
        reason = "it jumps there or away"
    else:
        return []
    time = recording.time
    text = f"frozen at {values[start]:.6g} for {time[end] - time[start]:.4g} s: {reason}"
    return [Problem("frozen", recording.name, signal.column, float(time[start]), text, True)]


def _jumps(values: np.ndarray, before: int, after: int) -> bool:
    """Whether the step after one of these two samples is far beyond every other step of the signal."""
    steps = np.abs(np.diff(values))
    at = [k for k in (before, after) if 0 <= k < len(steps)]
    largest = float(np.nanmax(steps[at], initial=0.0))
    return bool(largest > 8 * np.nanmax(np.delete(steps, at), initial=0.0) and largest > 0)


def _clipped(recording: Recording, signal: Signal, values: np.ndarray) -> list[Problem]:
    if not _noisy(values, signal):
        return []
    problems = []
    for side, extreme in (("upper", np.nanmax(values)), ("lower", np.nanmin(values))):
        at = values == extreme
        start, length = longest_run(at)
        if at.mean() > CLIPPED_SHARE and length >= CLIPPED_RUN:
            text = f"clipped at its {side} end {extreme:.6g} in {at.mean():.1%} of the samples"
            problems.append(Problem("clipped", recording.name, signal.column, float(recording.time[start]), text, True))
    return problems


def _outliers(recording: Recording, signal: Signal, values: np.ndarray) -> list[Problem]:
    """Single samples that leave and return at once, far outside the signal's own steps (but for a few of these)."""
    left = values[1:-1] - values[:-2]
    right = values[1:-1] - values[2:]
    size = np.where(left * right > 0, np.minimum(np.abs(left), np.abs(right)), 0.0)
    steps = np.sort(np.abs(np.diff(values[np.isfinite(values)])))
    few = max(6, len(steps) // 1000)
    if len(steps) <= few:
        return []
    usual = max(float(steps[-1 - few]), 1e-300)
    spikes = np.flatnonzero(np.nan_to_num(size) > 8 * usual)
    if not len(spikes):
        return []
    text = f"{len(spikes)} single samples jump by {np.nanmax(size):.4g} and back"
    return [Problem("outlier", recording.name, signal.column, float(recording.time[spikes[0] + 1]), text, False)]


def _constant(case: Case) -> list[Problem]:
    """An output that never changes; an output without its noise in one recording; inputs that never change."""
    problems = []
    for signal in case.outputs:
        still = [r for r in case.fit if not _changes(r, signal)]
        if len(still) == len(case.fit):
            problems.append(_still(still[0], signal, "constant in every recording that may be fitted"))
            continue
        still += [r for r in case.validate if not _changes(r, signal)]
        others = [r for r in case.fit + case.validate if r not in still]
        if all(_noisy(r.columns[signal.column], signal) for r in others):
            problems += [_still(r, signal, "constant, where other recordings of it are noisy") for r in still]
    if case.inputs and not any(_changes(r, s) for s in case.inputs for r in case.fit):
        text = "no input ever changes: there is nothing to learn from"
        problems.append(_still(case.fit[0], case.inputs[0], text))
    return problems


def _changes(recording: Recording, signal: Signal) -> bool:
    values = recording.columns[signal.column]
    finite = values[np.isfinite(values)]
    return len(finite) > 0 and bool(np.ptp(finite) > 0)


def _still(recording: Recording, signal: Signal, text: str) -> Problem:
    begin = float(recording.time[0]) if len(recording.time) else None
    return Problem("constant", recording.name, signal.column, begin, text, True)


def longest_run(flags: np.ndarray) -> tuple[int, int]:
    """(start, length) of the longest run of true."""
    padded = np.concatenate([[0], flags.astype(int), [0]])
    edges = np.flatnonzero(np.diff(padded))
    starts, ends = edges[::2], edges[1::2]
    if not len(starts):
        return 0, 0
    k = int(np.argmax(ends - starts))
    return int(starts[k]), int(ends[k] - starts[k])
