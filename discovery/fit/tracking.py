"""The recorded motion of a shaft: what a tracker follows.

A tracker of bandwidth `w_t` holds the simulated shaft near its recorded motion. It decouples the fit of what lies
beyond the shaft (a machine commutates at the recorded angle), and its torque is the effort missing there. Lowered
step by step to zero it leads a fit from the equation error to the output error without the roughness between.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lacuna.discovery.case.cases import Case, Recording
from lacuna.discovery.case.noise import estimate
from lacuna.discovery.catalogue.places import Shaft, Structure
from lacuna.runtime import Model


@dataclass(frozen=True)
class Motion:
    """Columns that give a shaft's angle and speed; one of them may be missing."""

    angle: str | None
    speed: str | None

    def of(self, recording: Recording) -> tuple[np.ndarray, np.ndarray]:
        """(angle, speed) on the recording's samples, rad and rad/s, smoothed over a few samples."""
        step = recording.interval
        if self.angle is not None:
            angle = smooth(filled(recording.columns[self.angle]))
            speed = np.gradient(angle, step)
            return angle, smooth(speed)
        speed = smooth(filled(recording.columns[self.speed]))
        return np.concatenate([[0.0], np.cumsum((speed[1:] + speed[:-1]) / 2 * np.diff(recording.time))]), speed


def filled(values: np.ndarray) -> np.ndarray:
    """Missing samples replaced by linear interpolation."""
    good = np.isfinite(values)
    return values if good.all() else np.interp(np.arange(len(values)), np.flatnonzero(good), values[good])


def smooth(values: np.ndarray, half: int = 8) -> np.ndarray:
    """Local quadratic fit over 2 half + 1 samples (Savitzky, Golay 1964)."""
    half = min(half, (len(values) - 1) // 2)
    offsets = np.arange(-half, half + 1)
    kernel = np.linalg.pinv(np.vander(offsets, 3, increasing=True))[0]
    padded = np.concatenate([2 * values[0] - values[half:0:-1], values, 2 * values[-1] - values[-2 : -half - 2 : -1]])
    return np.convolve(padded, kernel[::-1], mode="valid")


def recorded_motion(case: Case, model: Model, shaft: Shaft) -> Motion | None:
    """Which outputs record the angle or the speed of a shaft, aliases of the model considered; None if none does."""
    location = shaft.location
    angle = recorded_column(case, model, f"{location}.phi")
    speed = recorded_column(case, model, f"{location}.w")
    return Motion(angle, speed) if angle or speed else None


def recorded_column(case: Case, model: Model, name: str) -> str | None:
    """The output that records a variable or an alias of it; None if none does."""
    target = model.variables.get(name)
    for signal in case.outputs:
        found = model.variables.get(signal.variable)
        if target and found and (found.kind, found.index, found.sign) == (target.kind, target.index, target.sign):
            return signal.column
    return None


def trackable(case: Case, model: Model, structure: Structure) -> list[Shaft]:
    """Shafts whose motion is recorded."""
    return [s for s in structure.shafts if recorded_motion(case, model, s) is not None]


def noise_bandwidth(case: Case, motion: Motion) -> float:
    """Bandwidth (rad/s) that a tracker can have before it mostly follows noise: a twelfth of the sampling rate."""
    interval = float(np.median([r.interval for r in case.fit]))
    column = motion.angle or motion.speed
    level = estimate([r.columns[column] for r in case.fit], case.signals[column].noise_std).std
    return 0.5 / interval if level > 0 else 1.0 / interval
