"""What is wrong with a recording, seen before any model is believed: each problem with its column and time.

A `fatal` problem makes every conclusion worthless (time runs backwards, a signal is frozen); the others are
said in the report and the samples concerned are left out. What stands exactly at zero may be a machine at rest: a
sensor may have no noise there.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass, replace
from itertools import combinations

import numpy as np

from lacuna.analysis.recording.channel import not_rising
from lacuna.discovery.case.cases import Case, Recording
from lacuna.discovery.case.gaps import GAP, MIN_SAMPLES, gaps
from lacuna.discovery.case.noise import level, quantum
from lacuna.discovery.case.signals import Signal
from lacuna.discovery.case.spikes import spikes

FROZEN_RUN = 25  # equal samples in a row that noise above the resolution cannot give
AT_REST = 8.0  # noise levels around zero, within which a signal that comes to rest, or leaves it, may be
UNDRIVEN = "undriven"  # the kind of problem that is none where nothing is to be learned
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
        column = f", column `{self.column}`" if self.column else ""
        time = f", t = {self.time:.6g} s" if self.time is not None else ""
        return f"{self.recording}{column}{time}: {self.text}"

    def as_dict(self) -> dict:
        return asdict(self)


def check_case(case: Case) -> list[Problem]:
    """Every problem of every recording of the case, fatal ones first."""
    problems = [p for r in case.fit + case.validate for p in check_recording(r, case.signals)]
    problems += _constant(case) + _copies(case)
    return sorted(problems, key=lambda p: not p.fatal)


def check_recording(recording: Recording, signals: dict[str, Signal]) -> list[Problem]:
    problems = _check_time(recording)
    if any(p.fatal for p in problems):
        return problems
    problems += _gaps(recording, [s for s in signals.values() if s.role == "input"])
    for signal in signals.values():
        values = recording.columns[signal.column]
        problems += _missing(recording, signal, values)
        if signal.role == "output":  # a command may stand, jump and end where it likes
            seen = _moves(signal, values)
            own = Recording(recording.name, recording.time[seen], {signal.column: values[seen]})
            problems += _clipped(own, signal, values[seen]) or _frozen(own, signal, values[seen])
            problems += _outliers(recording, signal, values)
    return problems


def _copies(case: Case) -> list[Problem]:
    """A file that holds the samples of another one: what it judges was fitted to it, or it counts twice."""
    found = []
    for one, other in combinations(case.fit + case.validate, 2):
        pairs = [(one.time, other.time), *((one.columns[c], other.columns[c]) for c in one.columns)]
        if all(np.array_equal(a, b, equal_nan=True) for a, b in pairs):
            judges = any(other is r for r in case.validate)
            said = "what it judges was fitted to it" if judges else "they count twice"
            text = f"it holds the samples of {one.name}: {said}"
            found.append(Problem("copy", other.name, "", None, text, False))
    return found


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
    if found := not_rising(time):
        after, text = found
        return fatal("time_order", float(time[after]), text)
    return []


def _gaps(recording: Recording, inputs: list[Signal]) -> list[Problem]:
    """Stretches that nothing is known of: the recording is cut there; of no use where nothing is left of it."""
    found, problems, longest = gaps(recording, inputs), [], 0
    edges = [float(recording.time[0]), *(t for _, *ends in found for t in ends), float(recording.time[-1])]
    for begin, end in zip(edges[::2], edges[1::2], strict=True):
        longest = max(longest, int(np.sum((recording.time >= begin) & (recording.time <= end))))
    for column, begin, end in found:
        text = f"gap of {end - begin:.4g} s; what comes after it is taken as a recording of its own"
        problems.append(Problem("gap", recording.name, column, begin, text, longest < MIN_SAMPLES))
    return problems


def _missing(recording: Recording, signal: Signal, values: np.ndarray) -> list[Problem]:
    """Samples that are missing: between those of a signal of a rate of its own the cells are empty, and none is."""
    seen = np.flatnonzero(np.isfinite(values))
    name, begin = recording.name, float(recording.time[0])
    held = signal.role == "input" and signal.interpolation == "hold"
    if len(seen) < (1 if held else MIN_SAMPLES):
        text = f"only {len(seen)} samples; at least {MIN_SAMPLES} are needed"
        return [Problem("missing_samples", name, signal.column, begin, text, True)]
    steps = np.diff(np.concatenate([[-1], seen, [len(values)]]))
    usual = int(np.median(steps))
    lost = steps - usual
    if signal.role == "input":
        lost = np.where(steps > GAP * usual, 0, lost)  # the recording is cut there
    if held or not np.any(lost > 0):
        return []
    missing, longest = int(np.sum(lost[lost > 0]) // usual), int(np.argmax(lost))
    if not missing:
        return []
    at = float(recording.time[max(int(seen[longest - 1]) if longest else 0, 0)])
    text = f"some {missing} samples are missing or not numbers, {int(lost[longest]) // usual} in a row after {at:.6g} s"
    return [Problem("missing_samples", name, signal.column, at, text, False)]


def _noisy(values: np.ndarray, signal: Signal) -> bool:
    """Whether noise changes the value from sample to sample even at rest (so that equal samples are no rest).

    The noise that the case states counts too: that of a signal which is frozen for long cannot be seen any more.
    """
    finite = values[np.isfinite(values)]
    step = quantum(finite)
    if len(finite) <= 100 or len(np.unique(finite)) < 8:  # too few values to tell its resolution
        return False
    return max(level([finite]), signal.noise_std or 0.0) > 1.5 * step


def _rests(values: np.ndarray, signal: Signal) -> np.ndarray:
    """Which samples (n,) are those of a machine at rest: zero for long, and reached and left from near zero, or by no
    larger a step than the signal makes elsewhere."""
    zero = np.concatenate([[False], values == 0.0, [False]])
    edges = np.flatnonzero(np.diff(zero.astype(int)))
    ends = [(a, b) for a, b in zip(edges[::2], edges[1::2], strict=True) if b - a >= CLIPPED_RUN]
    steps = np.abs(np.diff(values, prepend=0.0, append=0.0))
    apart = np.delete(steps, [0, len(values), *(k for pair in ends for k in pair)])
    noise = max(level([values]), signal.noise_std or 0.0, quantum(values))
    near = max(AT_REST * noise, float(np.max(apart, initial=0.0)))
    rests = np.zeros(len(values), dtype=bool)
    for start, end in ends:
        rests[start:end] = (start == 0 or steps[start] <= near) and (end == len(values) or steps[end] <= near)
    return rests


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


def _moves(signal: Signal, values: np.ndarray) -> np.ndarray:
    """Which samples (n,) are there, and are not those of a machine at rest."""
    seen = np.isfinite(values)
    seen[seen] = ~_rests(values[seen], signal)
    return seen


def _spikes(signal: Signal, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    return spikes(np.where(_moves(signal, values), values, np.nan))


def without_spikes(case: Case) -> Case:
    """The case with single samples that a logger spoilt as missing ones of their outputs."""

    def cleared(recording: Recording) -> Recording:
        columns = dict(recording.columns)
        for signal in case.outputs:
            found, _ = _spikes(signal, columns[signal.column])
            if len(found):
                columns[signal.column] = columns[signal.column].copy()
                columns[signal.column][found] = np.nan
        return replace(recording, columns=columns)

    return replace(case, fit=[cleared(r) for r in case.fit], validate=[cleared(r) for r in case.validate])


def _outliers(recording: Recording, signal: Signal, values: np.ndarray) -> list[Problem]:
    found, size = _spikes(signal, values)
    if not len(found):
        return []
    count = "1 single sample jumps" if len(found) == 1 else f"{len(found)} single samples jump"
    text = f"{count} by {np.max(size):.4g} and back: left out"
    return [Problem("outlier", recording.name, signal.column, float(recording.time[found[0]]), text, False)]


def _constant(case: Case) -> list[Problem]:
    """An output that never changes; an output without its noise in one recording; inputs that never change."""
    problems = []
    for signal in case.outputs:
        still = [r for r in case.fit if not _changes(r, signal)]
        if len(still) == len(case.fit):
            problems.append(_still("constant", still[0], signal, "constant in every recording that may be fitted"))
            continue
        still += [r for r in case.validate if not _changes(r, signal)]
        others = [r for r in case.fit + case.validate if r not in still]
        still = [r for r in still if not _at_rest(case, r, signal, others)]
        if all(_noisy(r.columns[signal.column], signal) for r in others):
            said = "constant, where other recordings of it are noisy"
            problems += [_still("constant", r, signal, said) for r in still]
    if case.inputs and not any(_changes(r, s) for s in case.inputs for r in case.fit):
        text = "no input ever changes: there is nothing to learn from"
        problems.append(_still(UNDRIVEN, case.fit[0], case.inputs[0], text))
    return problems


def _at_rest(case: Case, recording: Recording, signal: Signal, others: list[Recording]) -> bool:
    """Whether a signal that stands at zero may be that of a machine which is not driven as far as where it moves."""
    values = recording.columns[signal.column]
    less = any(_largest(recording, s) < min((_largest(r, s) for r in others), default=0.0) for s in case.inputs)
    return less and not np.any(values[np.isfinite(values)])


def _largest(recording: Recording, signal: Signal) -> float:
    return float(np.nanmax(np.abs(recording.columns[signal.column]), initial=0.0))


def _changes(recording: Recording, signal: Signal) -> bool:
    values = recording.columns[signal.column]
    finite = values[np.isfinite(values)]
    return len(finite) > 0 and bool(np.ptp(finite) > 0)


def _still(kind: str, recording: Recording, signal: Signal, text: str) -> Problem:
    begin = float(recording.time[0]) if len(recording.time) else None
    return Problem(kind, recording.name, signal.column, begin, text, True)


def longest_run(flags: np.ndarray) -> tuple[int, int]:
    """(start, length) of the longest run of true."""
    padded = np.concatenate([[0], flags.astype(int), [0]])
    edges = np.flatnonzero(np.diff(padded))
    starts, ends = edges[::2], edges[1::2]
    if not len(starts):
        return 0, 0
    k = int(np.argmax(ends - starts))
    return int(starts[k]), int(ends[k] - starts[k])
