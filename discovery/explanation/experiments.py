"""Which further recording would tell two explanations apart: both are simulated under variants of the recorded inputs.

A variant stays within twice the amplitude that was used. What counts is the difference of the outputs against the
noise: explanations that agree on the recordings differ most where neither was fitted.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from lacuna.discovery.case.cases import Case, Recording, Signal
from lacuna.discovery.fit.fit import Fit
from lacuna.discovery.fit.least_squares import _pool

SEEN = 1.0  # RMS difference in standard deviations of the noise from which a recording tells the two apart
LEVELS = 6  # of a held input


@dataclass(frozen=True)
class Experiment:
    """A variant of a recording, with what each explanation says of the output that differs most (n,), SI."""

    text: str
    recording: Recording
    column: str
    sigmas: float  # RMS difference over the noise
    first: np.ndarray
    second: np.ndarray

    def sentence(self, names: tuple[str, str]) -> str:
        if self.sigmas < SEEN:
            return (
                f"no variant of the recorded inputs up to twice their size would tell {names[0]} from {names[1]}: the "
                f"best, {self.text}, lets {self.column} differ by {self.sigmas:.2g} sigma; record a further quantity"
            )
        return (
            f"record {self.text}: {names[0]} and {names[1]} then differ in {self.column} by {self.sigmas:.3g} times "
            "its noise (RMS)"
        )


def separate(case: Case, first: Fit, second: Fit) -> Experiment | None:
    """The variant of a fit recording under which two fitted explanations differ most; None where none simulates."""
    variants = [v for recording in case.fit for v in _variants(case, recording)]
    tried = [e for e in _pool.map(lambda v: _compare(first, second, *v), variants) if e is not None]
    return max(tried, key=lambda e: e.sigmas, default=None)


def _compare(first: Fit, second: Fit, text: str, recording: Recording) -> Experiment | None:
    one, other = first.machine.simulate(first.point, recording), second.machine.simulate(second.point, recording)
    if one is None or other is None:
        return None
    size = {c: float(np.sqrt(np.mean((one[c] - other[c]) ** 2))) / noise.std for c, noise in first.noise.items()}
    column = max(size, key=lambda c: size[c])
    return Experiment(text, recording, column, size[column], one[column], other[column])


def _variants(case: Case, recording: Recording) -> list[tuple[str, Recording]]:
    """Each input changed alone; inputs that are each other's derivatives, which are imposed motions, together."""
    together = len(case.inputs) > 1 and _derivatives(recording, case.inputs)
    result = []
    for inputs in [case.inputs] if together else [[s] for s in case.inputs]:
        if any(np.ptp(np.nan_to_num(recording.columns[s.column])) == 0 for s in inputs):
            continue
        for words, change in _changes(recording, inputs, together):
            text = f"{recording.name} with {words.format(name=' and '.join(s.column for s in inputs))}"
            columns = dict(recording.columns)
            columns |= {s.column: change(np.nan_to_num(columns[s.column])) for s in inputs}
            size = ", ".join(f"{s.column} up to {np.max(np.abs(columns[s.column])):.3g} {s.si_unit}" for s in inputs)
            result.append((f"{text} ({size})", Recording(f"{recording.name}: {text}", recording.time, columns)))
    return result


def _changes(
    recording: Recording, inputs: list[Signal], together: bool
) -> list[tuple[str, Callable[[np.ndarray], np.ndarray]]]:
    n = len(recording.time)
    index = np.arange(n)
    changes: list[tuple[str, Callable[[np.ndarray], np.ndarray]]] = [
        ("{name} twice as large", lambda v: 2 * v), ("{name} half as large", lambda v: 0.5 * v),
    ]  # fmt: skip
    if all(np.nanmin(recording.columns[s.column]) < 0 or together for s in inputs):
        changes.append(("{name} reversed", lambda v: -v))
    if not together:
        changes += [
            ("{name} at half the pace", lambda v: np.interp(index / 2, index, v)),
            ("{name} at twice the pace, repeated", lambda v: v[(2 * index) % n]),
            ("{name} held at steady levels", _held),
            ("{name} held at steady levels, twice as large", lambda v: 2 * _held(v)),
        ]  # fmt: skip
    return changes


def _held(values: np.ndarray) -> np.ndarray:
    length = len(values) // LEVELS + 1
    return values[np.arange(len(values)) // length * length]


def _derivatives(recording: Recording, inputs: list[Signal]) -> bool:
    """Whether one input is the derivative of another."""
    for a in inputs:
        slope = np.gradient(np.nan_to_num(recording.columns[a.column]), recording.time)
        for b in inputs:
            other = np.nan_to_num(recording.columns[b.column])
            power = float(np.linalg.norm(slope) * np.linalg.norm(other))
            if a is not b and power > 0 and float(slope @ other) > 0.95 * power:
                return True
    return False
