"""Parameters to estimate: what is believed of them, their scale and their bounds."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Free:
    """A parameter to estimate. `sigma` is its believed 1-sigma around `centre`; None means no belief (flat).

    `scale` (> 0) is the size of a typical change; finite differences use `step` of it.
    """

    name: str
    centre: float
    scale: float
    lower: float = -np.inf
    upper: float = np.inf
    sigma: float | None = None
    step: float = 1e-2
    start: float | None = None

    def clip(self, value: float) -> float:
        return float(min(max(value, self.lower), self.upper))


def pulls(free: list[Free], values: np.ndarray) -> np.ndarray:
    """How far values (p,) are from what is believed, in believed sigmas; 0 where nothing is."""
    return np.array([(v - f.centre) / f.sigma if f.sigma else 0.0 for f, v in zip(free, values, strict=True)])


def clipped(free: list[Free], values: Iterable[float]) -> np.ndarray:
    """The values (p,) within their bounds."""
    return np.array([f.clip(v) for f, v in zip(free, values, strict=True)])
