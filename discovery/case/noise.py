"""The noise of a recorded signal, estimated from the recording alone.

Level: a signal that is smooth from sample to sample leaves in its third differences only noise; the median
absolute difference ignores the few places where the signal itself jumps (J. W. Tukey's MAD). Quantisation: the
smallest step between the values that occur; its uniform error has the variance q^2 / 12. Colour: the sum of
autocorrelations of a residual says how many samples carry the information of one.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

_THIRD = np.array([1.0, -3.0, 3.0, -1.0])
_MAD_TO_SIGMA = 1.4826  # of a normal distribution
MANY, DIGITS, FINE = 100, 9, 1e-6  # values of a column, digits, and share of the range, for a last digit to matter
PARTS = 8  # steps that the least difference may have: of a shaft that turns on, no two angles need be neighbours


@dataclass(frozen=True)
class Noise:
    """`std` is the level that weights a residual; `quantum` the resolution of the column (0: none seen)."""

    std: float
    quantum: float
    given: bool


def quantum(values: np.ndarray) -> float:
    """Resolution of a column: the step that all its values are whole multiples of; 0 where there is none.

    Values are printed with few digits, so the step is refined on ever larger differences before it is believed.
    """
    levels = np.unique(values[np.isfinite(values)])
    if len(levels) < 8:
        return float(np.min(np.diff(levels))) if len(levels) > 1 else 0.0
    gaps = np.sort(np.diff(levels))
    gaps = gaps[gaps > 1e-9 * (levels[-1] - levels[0])]
    least = float(np.median(gaps[gaps < 1.5 * gaps[0]]))
    steps = (_refined(gaps[:: max(1, len(gaps) // 200)], least / parts) for parts in range(1, PARTS + 1))
    return next((s for s in steps if s), 0.0)


def _refined(gaps: np.ndarray, step: float) -> float:
    """The step near this one that all gaps, in rising order, are whole multiples of; 0 where it is not."""
    for gap in gaps:
        count = round(gap / step)
        if abs(gap / step - count) > 0.2:
            return 0.0
        if count < 200:
            step += (gap / count - step) * min(1.0, count / 200)
    return step


def level(pieces: list[np.ndarray]) -> float:
    """Standard deviation of white noise on a smooth signal, pooled over recordings (each with NaN where missing).

    Differences are those of the signal's own samples: between them other signals of a recording may have theirs."""
    seen = [p[np.isfinite(p)] for p in pieces]
    differences = np.concatenate([_third_differences(p) if len(p) > 3 else p[:0] for p in seen])
    if not len(differences):
        return 0.0
    spread = float(np.median(np.abs(differences)))
    if spread == 0.0:  # quantised and mostly at rest: the few moving samples decide
        spread = float(np.mean(np.abs(differences)))
    return _MAD_TO_SIGMA * spread / float(np.linalg.norm(_THIRD))


def _third_differences(values: np.ndarray) -> np.ndarray:
    """Those of a signal, without stretches that stand at zero: a machine at rest may have a sensor without noise."""
    rest = np.convolve(values == 0.0, np.ones(4), mode="valid") == 4
    return np.convolve(values, _THIRD, mode="valid")[~rest]


def estimate(pieces: list[np.ndarray], given: float | None = None) -> Noise:
    """Noise of one signal from all its recordings; a given level stands, but never below the quantisation's."""
    step = max((quantum(p) for p in pieces), default=0.0)
    floor = step / np.sqrt(12)
    if given is not None:
        return Noise(max(given, floor * 0.99), step, True)
    spread = float(np.nanstd(np.concatenate(pieces)))
    return Noise(max(level(pieces), floor, 1e-9 * spread, 1e-300), step, False)


def of_few_levels(values: np.ndarray) -> bool:
    """Whether a column takes so few values that they are taken to be exact: a command that stands and jumps."""
    return len(np.unique(values[np.isfinite(values)])) < MANY


def last_digit(pieces: list[np.ndarray]) -> float:
    """The place of the last digit that a column is written with, of all its recordings, as a power of ten.

    0 where no power of ten divides all values or it is negligible, and for a column of few levels.
    """
    values = np.unique(np.concatenate([p[np.isfinite(p)] for p in pieces]))
    if of_few_levels(values):
        return 0.0
    scaled = ((d, values * 10.0**d) for d in range(-DIGITS, DIGITS + 1))
    place = next((10.0**-d for d, v in scaled if np.ptp(v) > 1.0 and np.all(np.abs(v - np.round(v)) < 1e-3)), 0.0)
    return place if place > FINE * np.ptp(values) else 0.0


def is_coarse(noise: Noise) -> bool:
    """Whether a signal's error is rounding: its noise is well below its resolution, so that nothing dithers it."""
    return noise.quantum > 0 and noise.std <= 0.5 * noise.quantum


def sample_weights(values: np.ndarray, noise: Noise) -> np.ndarray:
    """Weight (n,) of each sample: 0 where missing; 1/sqrt(k) in a run of k equal samples of a signal without dither.

    Where noise is well below the resolution, equal samples in a row carry one and the same rounding error.
    """
    weights = np.isfinite(values).astype(float)
    if not is_coarse(noise):
        return weights
    seen = values[weights > 0]
    change = np.flatnonzero(np.diff(seen) != 0) + 1
    lengths = np.diff(np.concatenate([[0], change, [len(seen)]]))
    weights[weights > 0] = 1.0 / np.sqrt(np.repeat(lengths, lengths))
    return weights


def correlation_time(residual: np.ndarray) -> float:
    """Samples that count as one: 1 + 2 sum of autocorrelations, up to their first zero (>= 1)."""
    r = residual[np.isfinite(residual)]
    r = r - r.mean() if len(r) else r
    power = float(r @ r)
    if len(r) < 16 or power <= 0:
        return 1.0
    size = 1 << (2 * len(r) - 1).bit_length()
    spectrum = np.abs(np.fft.rfft(r, size)) ** 2
    correlation = np.fft.irfft(spectrum)[: len(r) // 2] / power
    negative = np.flatnonzero(correlation <= 0)
    end = negative[0] if len(negative) else len(correlation)
    return float(max(1.0, 1.0 + 2.0 * correlation[1:end].sum()))
