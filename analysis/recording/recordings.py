"""Recordings of a pre-flight test from CSV or MAT files, and what makes one unfit to be assessed.

Every check raises Refusal with the channel, the time and the reason. Nothing is repaired.
"""

from __future__ import annotations

from collections.abc import Sequence
import csv
from dataclasses import dataclass
from itertools import permutations, product
from pathlib import Path

import numpy as np

from lacuna.analysis.errors import AnalysisError
from lacuna.analysis.settings import Settings

SLOWEST = 5000.0  # Hz; below, the third harmonic of the commutation ripple folds into the analysed band

LARGEST = 1 << 30  # bytes of a file: a hundred times a second of three currents at 100 kHz as text
LIKENESS = 0.9  # of the first instants of a test to those on the map: a cosine


class Refusal(AnalysisError):
    """The recording cannot be assessed; the message says why."""


@dataclass(frozen=True)
class Recording:
    names: tuple[str, ...]
    sampling_rate: float  # Hz
    currents: np.ndarray  # A, [channels, samples]


def read_recording(path: Path | str, settings: Settings, columns: Sequence[str] | None = None) -> Recording:
    """One test of the settings' duration, from the file's first sample on.

    `columns` name the phase currents in the order of the map's channels; by default they are called as in the map.
    """
    path = Path(path)
    if path.exists() and not (path.is_file() and path.stat().st_size <= LARGEST):
        raise Refusal(f"{path}: not a file of at most {LARGEST >> 20} MB, as a recording of this test would be")
    names = tuple(columns or settings.currents)
    if len(names) != len(settings.currents):
        raise Refusal(f"{len(names)} currents named where the map has {len(settings.currents)}")
    table = _read_mat(path) if path.suffix == ".mat" else _read_csv(path)
    missing = [name for name in ("time", *names) if name not in table]
    if missing:
        raise Refusal(f"{path}: there is no {', '.join(missing)}; it has {', '.join(table)}")
    rate = _sampling_rate(path, table["time"], settings.duration)
    currents = np.array([table[name][: round(rate * settings.duration)] for name in names])
    for name, current in zip(names, currents, strict=True):
        _check_channel(name, current, rate)
    return Recording(names, rate, currents)


def _read_csv(path: Path) -> dict[str, np.ndarray]:
    header, _, body = path.read_text(encoding="utf-8", errors="replace").partition("\n")
    names = [name.strip() for name in next(csv.reader([header]), [])]
    lines = body.splitlines()
    if not names or not lines:
        raise Refusal(f"{path}: this is no table with a header and rows")
    try:
        data = np.loadtxt(lines, delimiter=",", ndmin=2)
    except ValueError:  # empty fields and the like: slower, and they become missing samples
        try:
            data = np.genfromtxt(lines, delimiter=",", ndmin=2)
        except ValueError as error:
            raise Refusal(f"{path}: the rows differ in length: {str(error).splitlines()[-1].strip()}") from None
    if data.shape[1] != len(names):
        raise Refusal(f"{path}: {len(names)} columns in the header, {data.shape[1]} in the rows")
    if "event" in names:  # rows that a simulation added at its events, off the sampling grid
        data = data[data[:, names.index("event")] == 0]
    return dict(zip(names, data.T, strict=True))


def _read_mat(path: Path) -> dict[str, np.ndarray]:
    from scipy.io import loadmat

    try:
        content = loadmat(path)
    except FileNotFoundError:
        raise
    except Exception as error:  # a damaged file may trip its parser anywhere
        raise Refusal(f"{path}: not a MAT file that can be read (version 7 or older): {error}") from None
    vectors = {name: value for name, value in content.items() if isinstance(value, np.ndarray) and value.ndim == 2}
    return {name: value.ravel().astype(float) for name, value in vectors.items() if value.dtype.kind in "fiu"}


def _sampling_rate(path: Path, time: np.ndarray, duration: float) -> float:
    """Of a recording that is uniform and long enough."""
    if not np.isfinite(time).all() or len(time) < 2:
        raise Refusal(f"{path}: time has missing values")
    steps = np.diff(time)
    rate = 1 / float(np.median(steps)) if np.median(steps) > 0 else float("inf")
    odd = np.flatnonzero(np.abs(steps * rate - 1) > 0.02)
    if len(odd):
        at, step = time[odd[0]], steps[odd[0]]
        raise Refusal(f"{path}: time is not uniform: at {at:g} s the next sample is {step:g} s later")
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
