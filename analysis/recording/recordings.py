"""Recordings of a pre-flight test, and what makes one unfit to be assessed.

Every check raises Refusal with the channel, the time and the reason. Nothing is repaired.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import permutations, product
from pathlib import Path

import numpy as np

from lacuna.analysis.errors import AnalysisError
from lacuna.analysis.recording.channel import Channel, RecordingError, on_one_time
from lacuna.analysis.recording.formats import read_recorded
from lacuna.analysis.settings import Settings
from lacuna.recorded_units import to_si

SLOWEST = 5000.0  # Hz; below, the third harmonic of the commutation ripple folds into the analysed band

LIKENESS = 0.9  # of the first instants of a test to those on the map: a cosine


class Refusal(AnalysisError):
    """The recording cannot be assessed; the message says why."""


@dataclass(frozen=True)
class Recording:
    names: tuple[str, ...]
    sampling_rate: float  # Hz
    currents: np.ndarray  # A, [channels, samples]
    notes: tuple[str, ...] = ()  # what was assumed in reading it


def read_recording(path: Path | str, settings: Settings, columns: Sequence[str] | None = None) -> Recording:
    """One test of the settings' duration, from the file's first sample on.

    `columns` name the phase currents in the order of the map's channels; by default they are called as in the map.
    """
    path = Path(path)
    names = tuple(columns or settings.currents)
    if len(names) != len(settings.currents):
        raise Refusal(f"{len(names)} currents named where the map has {len(settings.currents)}")
    table, notes = _table(path, names)
    rate = _sampling_rate(path, table["time"], settings.duration)
    currents = np.array([table[name][: round(rate * settings.duration)] for name in names])
    for name, current in zip(names, currents, strict=True):
        _check_channel(name, current, rate)
    return Recording(names, rate, currents, notes)


def _table(path: Path, names: Sequence[str]) -> tuple[dict[str, np.ndarray], tuple[str, ...]]:
    """`time` in s and each named current in A, without the rows that a simulation added at its events; and what was
    assumed."""
    try:
        recorded = read_recorded(path)
    except RecordingError as error:
        raise Refusal(str(error)) from None
    missing = [name for name in names if not any(name in (c.name, c.head.text) for c in recorded.channels)]
    if missing:
        raise Refusal(
            f"{path}: there is no {', '.join(missing)}; it has {', '.join(c.head.text for c in recorded.channels)}"
        )
    channels = [recorded[name] for name in names]
    time, currents = on_one_time(channels)
    kept = np.ones(len(time), bool)
    if any(c.name == "event" for c in recorded.channels):
        kept = recorded["event"].values == 0
    amperes = {
        name: current[kept] * _amperes(path, channel)
        for name, channel, current in zip(names, channels, currents, strict=True)
    }
    return {"time": time[kept]} | amperes, recorded.notes


def _amperes(path: Path, channel: Channel) -> float:
    factor, si = to_si(channel.unit or "A")
    if si != "A":
        if not channel.head.sure:
            return 1.0  # i_C is the current of phase C
        raise Refusal(f"{path}: {channel.head.text} is recorded in {channel.unit}, which is no current")
    return factor


def _sampling_rate(path: Path, time: np.ndarray, duration: float) -> float:
    """Of a recording that is uniform and long enough."""
    if not np.isfinite(time).all() or len(time) < 2:
        raise Refusal(f"{path}: time has missing values")
    steps = np.diff(time)
    interval = float(np.median(steps))
    odd = np.flatnonzero((steps <= 0) | (np.abs(steps - interval) > 0.02 * interval))
    if len(odd):
        at, step = time[odd[0]], steps[odd[0]]
        raise Refusal(f"{path}: time is not uniform: at {at:g} s the next sample is {step:g} s later")
    rate = 1 / interval
    if rate < SLOWEST:
        raise Refusal(f"{path}: sampled at {rate:g} Hz; at least {SLOWEST:g} Hz are needed")
    length = len(time) / rate
    if length < duration * (1 - 1e-6):
        raise Refusal(f"{path}: {length:g} s long; the test takes {duration:g} s")
    return float(f"{rate:.9g}")


def _check_channel(name: str, current: np.ndarray, rate: float) -> None:
    lost = np.flatnonzero(~np.isfinite(current))
    if len(lost):
        raise Refusal(f"{name}: {len(lost)} samples are missing, the first at {lost[0] / rate:g} s")
    if np.ptp(current) < 1e-3:
        raise Refusal(f"{name}: constant at {current[0]:g} A: the channel is dead")
    for extreme, side in ((current.max(), "upper"), (current.min(), "lower")):
        at = np.flatnonzero(current == extreme)
        if len(at) > 0.002 * len(current) and len(at) > 8 * _next_level(current, extreme):
            raise Refusal(f"{name}: saturated at its {side} limit of {extreme:g} A, first at {at[0] / rate:g} s")


def _next_level(current: np.ndarray, extreme: float) -> int:
    """How many samples have the value next to the extreme one. A rounded peak has about 2.4 times fewer there than at
    the extreme, whatever the converter's step; a clipped one far fewer."""
    others = current[current != extreme]
    nearest = others[np.abs(others - extreme).argmin()]
    return int((current == nearest).sum())


def check_phases(recording: Recording, starts: np.ndarray, rate: float) -> None:
    """Refuse swapped or reversed phases: the first instants of the test must look as on the map.

    `starts` [severities, channels, samples] at `rate` (Hz): the inductive rise of the currents while the motor gathers
    speed. All orders and signs are tried, each against the severity that it is most like.
    """
    times = np.arange(starts.shape[2]) / rate
    recorded_times = np.arange(recording.currents.shape[1]) / recording.sampling_rate
    measured = np.array([np.interp(times, recorded_times, current) for current in recording.currents])
    starts = starts / np.linalg.norm(starts, axis=(1, 2), keepdims=True)
    measured /= np.abs(measured).max() or 1.0  # before its square: of 1e200 A that has no number
    measured /= np.linalg.norm(measured) or 1.0
    channels = range(len(measured))
    likeness = {
        (order, signs): float((starts * (measured[list(order)].T * signs).T).sum(axis=(1, 2)).max())
        for order in permutations(channels)
        for signs in product((1, -1), repeat=len(measured))
    }
    as_named = likeness[tuple(channels), (1,) * len(measured)]
    (order, signs), best = max(likeness.items(), key=lambda item: item[1])
    if best > as_named + 0.02 and best > LIKENESS:
        raise Refusal(_wiring(recording.names, order, signs))
    if as_named < LIKENESS:
        raise Refusal(
            "the first instants are not those of this test: the currents must be recorded from the step command at "
            f"standstill on (likeness {as_named:.2f}, at least {LIKENESS} expected)"
        )


def _wiring(names: Sequence[str], order: Sequence[int], signs: Sequence[int]) -> str:
    wrong = [f"{names[k]} holds the current of {names[place]}" for place, k in enumerate(order) if k != place]
    wrong += [f"{names[k]} is reversed" for k, sign in zip(order, signs, strict=True) if sign < 0]
    return "phases are swapped or reversed: " + ", ".join(wrong)
