"""From one instant to the next along a linear model: exact for what is constant in between."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from scipy.linalg import expm

NUMBERS = 4_000_000  # 32 MB: in an array of unknowns by all that they answer to, at samples that are solved together


def blocks(samples: int, each: int) -> Iterator[slice]:
    """Samples in blocks, of which arrays of so many numbers `each` take little."""
    size = max(1, NUMBERS // each)
    return (slice(first, min(first + size, samples)) for first in range(0, samples, size))


def flows(rates: np.ndarray, owner: np.ndarray, lasting: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Of each segment its flow (x, x), and what inputs (x, b) that are held do in it; `rates` (n, x, x + b) are those
    at the samples, of which `owner` says between which one and the next a segment lies, `lasting` (s) how long."""
    width, count = rates.shape[1], len(owner)
    flow, source = np.empty((count, width, width)), np.empty((count, width, rates.shape[2] - width))
    for block in blocks(count, (2 * width) ** 2):
        mean = 0.5 * (rates[owner[block]] + rates[owner[block] + 1])
        both = np.zeros((len(mean), 2 * width, 2 * width))
        both[:, :width, :width] = mean[:, :, :width] * lasting[block, None, None]
        both[:, :width, width:] = np.eye(width) * lasting[block, None, None]
        exponential = expm(both)
        flow[block] = exponential[:, :width, :width]
        source[block] = exponential[:, :width, width:] @ mean[:, :, width:]
    return flow, source
