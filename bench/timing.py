"""Fair times on a noisy machine: rivals take turns, a ratio compares neighbours of one round, and what counts is the
processor time of the calling thread (every rival runs in one), which other programs do not lengthen."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
import time

import numpy as np


@dataclass(frozen=True)
class Timing:
    seconds: float  # median over the rounds
    spread: float  # (third quartile - first quartile) / median
    ratio: float  # median over the rounds of this rival's time / the baseline's time in the same round


def take_turns(rivals: Mapping[str, Callable[[], object]], rounds: int) -> dict[str, Timing]:
    """Call every rival once a round; the first one is the baseline. An unmeasured round warms the caches."""
    seconds = np.array([[_seconds(run) for run in rivals.values()] for _ in range(rounds + 1)])[1:]
    quartiles = np.quantile(seconds, [0.25, 0.5, 0.75], axis=0)
    ratios = np.median(seconds / seconds[:, :1], axis=0)
    return {
        name: Timing(float(q[1]), float((q[2] - q[0]) / q[1]), float(ratio))
        for name, q, ratio in zip(rivals, quartiles.T, ratios, strict=True)
    }


def _seconds(run: Callable[[], object]) -> float:
    begin = time.thread_time()
    run()
    return time.thread_time() - begin
