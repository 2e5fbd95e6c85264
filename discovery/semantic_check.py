"""Slips that only a model shows: a reversed sign, a unit off by 1000 or in degrees, a signal shifted in time.

Each output is compared with the believed model's simulation: a slip leaves the shape and changes the scale, or leaves
the scale and moves the time. A machine that merely misbehaves changes both a little, so the thresholds are far from
what an effect does.
"""

from __future__ import annotations

import math

import numpy as np

from .cases import Recording
from .least_squares import Free
from .machine import Machine
from .recordings_check import Problem

SCALES = {
    -1.0: "its sign is reversed", 1000.0: "it is 1000 times too large", 1e-3: "it is 1000 times too small",
    -1000.0: "it is 1000 times too large, with the sign reversed",
    -1e-3: "it is 1000 times too small, with the sign reversed",
    180 / math.pi: "it is in degrees where radians are stated",
    math.pi / 180: "it is in radians where degrees are stated",
    30 / math.pi: "it is in rpm where rad/s is stated", math.pi / 30: "it is in rad/s where rpm is stated",
}  # fmt: skip
SHAPE = 0.9  # least correlation with the simulation at which a scale is read
WITHIN = 0.25  # relative distance from a listed scale
LATE, EARLY = 50, 8  # samples: a signal may be somewhat late by a sensor or a drive, but not early
CHANGE = 10  # samples over which changes are compared when looking for a shift


def check_against_model(machine: Machine, start: tuple[list[Free], dict[str, float]]) -> list[Problem]:
    """Problems of the case's recordings (all fatal) by comparison with the believed model at its believed values."""
    free, fixed = start
    point = fixed | {f.name: f.centre for f in free}
    problems: list[Problem] = []
    for recording in machine.case.fit + machine.case.validate:
        simulated = machine.simulate(point, recording)
        if simulated is not None:
            problems += _check(machine, recording, simulated)
    return problems


def _check(machine: Machine, recording: Recording, simulated: dict[str, np.ndarray]) -> list[Problem]:
    outputs = machine.case.outputs
    scales = {s.column: _scale(recording.columns[s.column], simulated[s.column]) for s in outputs}
    slips = {c: text for c, scale in scales.items() if scale and (text := _slip(scale)) is not None}
    begin = float(recording.time[0])
    if slips and len(slips) == len(outputs) and len(outputs) > 1 and len(set(slips.values())) == 1:
        column = machine.case.inputs[0].column
        slip = next(iter(slips.values())).replace("it is", "the input were")
        text = f"all outputs answer as if {slip}: input or outputs slipped"
        return [Problem("scale", recording.name, column, begin, text, True)]
    found = [
        Problem("scale", recording.name, c, begin, text + " (against the model)", True) for c, text in slips.items()
    ]
    return found or _shifts(machine, recording, simulated)


def _scale(measured: np.ndarray, simulated: np.ndarray) -> float | None:
    """Slope of measured over simulated where their shapes agree, else None."""
    good = np.isfinite(measured)
    m, s = measured[good] - measured[good].mean(), simulated[good] - simulated[good].mean()
    power = math.sqrt(float(m @ m) * float(s @ s))
    if power <= 0 or abs(float(m @ s)) / power < SHAPE:
        return None
    return float(m @ s) / float(s @ s)


def _slip(scale: float) -> str | None:
    for factor, text in SCALES.items():
        if abs(scale / factor - 1.0) < WITHIN:
            return text
    return None


def _shifts(machine: Machine, recording: Recording, simulated: dict[str, np.ndarray]) -> list[Problem]:
    lags = {s.column: _lag(recording.columns[s.column], simulated[s.column]) for s in machine.case.outputs}
    found = []
    together = len(lags) > 1 and np.ptp([lag for lag, _ in lags.values()]) <= 4  # that is the drive, or a delay
    for column, (lag, gain) in lags.items():
        late, early = lag >= LATE and gain > 0.8, lag <= -EARLY and gain > 0.97
        if (late or early) and not together:
            seconds = lag * recording.interval
            text = f"shifted in time by {seconds:+.4g} s against the other signals"
            found.append(Problem("shift", recording.name, column, float(recording.time[0]), text, True))
    return found


def _lag(measured: np.ndarray, simulated: np.ndarray, reach: int = 400) -> tuple[int, float]:
    """(samples by which `measured` is late, share of the squared difference that moving it takes away).

    Changes over a few samples are compared, not values: a wrong parameter lets an angle drift, which is no shift.
    """
    measured = np.nan_to_num(measured, nan=float(np.nanmean(measured)))
    measured, simulated = (v[CHANGE:] - v[:-CHANGE] for v in (measured, simulated))
    reach = min(reach, len(measured) // 4)
    inner = slice(reach, len(measured) - reach)
    best, least = 0, math.inf
    base = float(np.sum((measured[inner] - simulated[inner]) ** 2))
    for lag in range(-reach, reach + 1, 2):
        moved = measured[inner.start + lag : inner.stop + lag]
        error = float(np.sum((moved - simulated[inner]) ** 2))
        if error < least:
            best, least = lag, error
    return best, 1.0 - least / base if base > 0 else 0.0
