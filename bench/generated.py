"""The same problems through our generator and runtime."""

from __future__ import annotations

from dataclasses import dataclass
import os
from pathlib import Path

import numpy as np

from bench.by_hand import T1, T2, Problem

ROOT = Path(__file__).parents[1]
RTOL, ATOL = 1e-6, 1e-8


@dataclass(frozen=True)
class Lane:
    solver: str
    step: float | None = None  # s; None: step size control at RTOL, ATOL

    @property
    def label(self) -> str:
        return self.solver + (f" at {self.step:g} s" if self.step else "")


LANES = (Lane("ida"), Lane("dopri5"), Lane("rodas4"), Lane("rk4", step=1e-5))


def model_file(problem: Problem) -> Path:
    """The shared benchmark file where it is to be had, else our own statement of the same problem."""
    shared = Path(os.environ.get("LACUNA_SHARED", ROOT.parent / "shared")) / "benchmarks"
    name, own = {T1: ("ServoT1.mo", "SquareWaveServo.mo"), T2: ("BldcT2.mo", "SixStepMotor.mo")}[problem]
    return shared / name if (shared / name).is_file() else ROOT / "tests" / "models" / own


def error_against(reference: dict[str, np.ndarray], states: dict[str, np.ndarray]) -> float:
    """Largest difference on the output grid over the largest magnitude of the reference; the worst of the states."""
    return max(
        float(np.max(np.abs(states[name] - values)) / np.max(np.abs(values))) for name, values in reference.items()
    )
