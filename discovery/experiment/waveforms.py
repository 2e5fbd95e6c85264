"""Candidate waveforms: families that differ in what they show (levels, bands of frequency, slow passes, what was done
before but larger), each within the ranges of the inputs.

A course is drawn in [-1, 1] for every input, scaled to its range, and then led from where the input begins no faster
than it may change.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

import numpy as np

from lacuna.discovery.case.cases import Case, Recording
from lacuna.discovery.experiment.limits import Range, derivatives, longest

MOST_SAMPLES = 4000  # of a proposed waveform: what is told by more samples is told by these
FINEST = 10  # samples at least in a period of what is proposed
Course = Callable[[np.random.Generator, int], np.ndarray]  # (n,) in [-1, 1]


@dataclass(frozen=True)
class Waveform:
    """What the inputs do: time (n,) from 0 s, columns (n,) in SI; drawn by `seed`."""

    text: str
    time: np.ndarray
    columns: dict[str, np.ndarray]


def waveforms(case: Case, ranges: Mapping[str, Range], seed: int) -> list[Waveform]:
    """One waveform of each family. Inputs that are derivatives of another follow from that one."""
    time, bound = _time(case), derivatives(case)
    random = np.random.default_rng(seed)
    result = []
    for text, courses in _families(len(time)):
        columns = {}
        for k, (column, of) in enumerate(ranges.items()):
            if column not in bound:
                unit = courses[k % len(courses)](random, len(time))
                columns[column] = _led(unit, _as_slow_as(column, of, ranges, bound), time)
        result.append(Waveform(text, time, columns))
    result += _as_recorded(case, ranges, time, bound)
    for one in result:
        for column in ranges:
            _derive(one, column, bound)
    return [one for one in result if _within(one, ranges)]


def _time(case: Case) -> np.ndarray:
    recording = longest(case)
    duration = float(recording.time[-1] - recording.time[0])
    count = min(MOST_SAMPLES, round(duration / recording.interval) + 1)
    return np.linspace(0.0, duration, count)


def _families(count: int) -> list[tuple[str, list[Course]]]:
    """(description, a course for each input in turn). Bands are in cycles per recording."""
    fast = max(count / FINEST, 4.0)
    middle = np.sqrt(fast)
    return [
        ("steps between levels, long holds", [_steps(8)]),
        ("steps between levels, short holds", [_steps(30)]),
        ("steps between levels, very short holds", [_steps(100)]),
        ("levels held one after another, up and down", [_staircase, _steps(24)]),
        ("a slow ramp to both ends", [_triangle(1.0), _triangle(2.5), _triangle(0.4)]),
        ("a sum of slow sines", [_multisine(1.0, middle)]),
        ("a sum of fast sines", [_multisine(middle, fast)]),
        ("a sum of sines over all frequencies", [_multisine(1.0, fast)]),
        ("a sweep of the frequency", [_chirp(1.0, fast), _chirp(fast, 1.0)]),
        ("a short step to each end, then rest", [_pulses]),
    ]


def _steps(count: int) -> Course:
    def course(random: np.random.Generator, n: int) -> np.ndarray:
        levels = random.permutation(np.linspace(-1.0, 1.0, count))
        return levels[np.arange(n) * count // n]

    return course


def _staircase(random: np.random.Generator, n: int) -> np.ndarray:
    levels = np.concatenate([np.linspace(-1.0, 1.0, 7), np.linspace(1.0, -1.0, 7)[1:]])
    return float(random.choice([-1.0, 1.0])) * levels[np.arange(n) * len(levels) // n]


def _triangle(turns: float) -> Course:
    def course(random: np.random.Generator, n: int) -> np.ndarray:
        phase = turns * np.arange(n) / n
        return float(random.choice([-1.0, 1.0])) * (2 / np.pi) * np.arcsin(np.sin(2 * np.pi * phase))

    return course


def _multisine(slow: float, fast: float) -> Course:
    def course(random: np.random.Generator, n: int) -> np.ndarray:
        cycles = np.unique(np.round(np.geomspace(slow, fast, 16)))
        phase = random.uniform(0, 2 * np.pi, len(cycles))
        sum_of = np.sin(2 * np.pi * np.arange(n)[:, None] / n * cycles + phase).sum(axis=1)
        return sum_of / np.abs(sum_of).max()

    return course


def _chirp(first: float, last: float) -> Course:
    def course(random: np.random.Generator, n: int) -> np.ndarray:
        growth = np.log(last / first)
        turns = first * (np.exp(growth * np.arange(n) / n) - 1.0) / growth
        return np.sin(2 * np.pi * turns + random.uniform(0, 2 * np.pi))

    return course


def _pulses(random: np.random.Generator, n: int) -> np.ndarray:
    sign = float(random.choice([-1.0, 1.0]))
    levels = np.zeros(12)
    levels[[1, 2]], levels[[6, 7]] = sign, -sign
    return levels[np.arange(n) * len(levels) // n]


def _as_recorded(case: Case, ranges: Mapping[str, Range], time: np.ndarray, bound: Mapping[str, str]) -> list[Waveform]:
    """What was recorded, as far out as the ranges let each input go; and the same as slowly as it goes twice."""
    recording = longest(case)
    result = []
    for text, pace in (("the recorded course, over the whole range", 1.0), ("the same at half the pace", 0.5)):
        at = recording.time[0] + time * pace
        columns = {}
        for column, of in ranges.items():
            good = np.isfinite(recording.columns[column])
            course = np.interp(at, recording.time[good], recording.columns[column][good])
            if column not in bound:
                columns[column] = _led(_unit(course), _as_slow_as(column, of, ranges, bound), time)
        result.append(Waveform(text, time, columns))
    return result


def _unit(course: np.ndarray) -> np.ndarray:
    """A course stretched to [-1, 1]."""
    low, high = float(course.min()), float(course.max())
    return 2 * (course - low) / (high - low) - 1.0 if high > low else np.zeros_like(course)


def _as_slow_as(column: str, of: Range, ranges: Mapping[str, Range], bound: Mapping[str, str]) -> Range:
    """A range whose rate keeps the derivatives of the input, where they are inputs, in theirs."""
    for other, source in bound.items():
        if source == column:
            inner = ranges[other]
            of = replace(of, rate=min(of.rate, abs(inner.low), abs(inner.high)))
    return of


def _led(unit: np.ndarray, of: Range, time: np.ndarray) -> np.ndarray:
    """The course over the range, from the start on, changing no faster than it may; of one that counts the nearest
    whole values."""
    wanted = 0.5 * (of.low + of.high) + 0.5 * (of.high - of.low) * unit
    step = of.rate * float(time[1] - time[0])
    result = np.empty_like(wanted)
    here = of.start
    for k, goal in enumerate(wanted):
        here = here if k == 0 else here + float(np.clip(goal - here, -step, step))
        result[k] = here
    return np.round(result) if of.counts else result


def _derive(one: Waveform, column: str, bound: Mapping[str, str]) -> None:
    if column not in one.columns:
        _derive(one, bound[column], bound)
        one.columns[column] = np.gradient(one.columns[bound[column]], one.time)


def _within(one: Waveform, ranges: Mapping[str, Range]) -> bool:
    """Whether all inputs stay in their ranges, and one of them moves."""
    for column, of in ranges.items():
        slack = 1e-9 * (abs(of.low) + abs(of.high))
        if one.columns[column].min() < of.low - slack or one.columns[column].max() > of.high + slack:
            return False
    return any(np.ptp(values) > 0 for values in one.columns.values())


def as_recording(case: Case, one: Waveform, name: str) -> Recording:
    """A recording of these inputs that nothing has answered to yet: outputs stay where the longest one begins."""
    columns = dict(one.columns)
    for signal in case.outputs:
        values = longest(case).columns[signal.column]
        columns[signal.column] = np.full(len(one.time), values[np.flatnonzero(np.isfinite(values))[0]])
    return Recording(name, one.time, columns)
