"""The programs written by hand, called through ctypes so that they run in the same process as their rivals."""

from __future__ import annotations

import ctypes
from dataclasses import dataclass
from pathlib import Path

import numpy as np

LIBRARY = Path(__file__).parents[2] / "build" / "lib" / "liblacuna_by_hand.so"


class _Counters(ctypes.Structure):
    _fields_ = [(name, ctypes.c_long) for name in ("steps", "residuals", "jacobians", "roots", "events")] + [
        ("seconds", ctypes.c_double)
    ]


@dataclass(frozen=True)
class Problem:
    symbol: str  # in the library
    states: tuple[str, ...]  # their names in the Modelica file
    stop: float  # s
    interval: float  # s

    @property
    def points(self) -> int:
        return round(self.stop / self.interval) + 1


T1 = Problem("servo_t1", ("i", "w"), 10.0, 1e-3)
T2 = Problem("bldc_t2", ("ia", "ib", "w", "th"), 1.0, 1e-4)


@dataclass
class Run:
    states: dict[str, np.ndarray]  # on the output grid, SI
    counters: dict[str, int]
    seconds: float


def with_ida(problem: Problem, rtol: float = 1e-6, atol: float = 1e-8) -> Run:
    return _run(problem, "solve_with_ida", ctypes.c_double(rtol), ctypes.c_double(atol))


def with_rk4(problem: Problem, step: float) -> Run:
    """`step` in s, at most the output interval; events are located exactly."""
    return _run(problem, "solve_with_rk4", ctypes.c_double(step))


def _run(problem: Problem, function: str, *settings: ctypes.c_double) -> Run:
    library = ctypes.CDLL(str(LIBRARY))
    rows = np.empty((problem.points, len(problem.states)))
    counters = _Counters()
    address = ctypes.byref(ctypes.c_char.in_dll(library, problem.symbol))
    status = getattr(library, function)(
        address, *settings, rows.ctypes.data_as(ctypes.POINTER(ctypes.c_double)), ctypes.byref(counters)
    )
    if status != 0:
        raise RuntimeError(f"{function} on {problem.symbol} ended with status {status}")
    counts = {name: getattr(counters, name) for name, _ in _Counters._fields_ if name != "seconds"}
    return Run(dict(zip(problem.states, rows.T.copy(), strict=True)), counts, counters.seconds)
