"""One step of least squares: damped until it lowers the cost, within bounds, and longer where it was too short."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from lacuna.discovery.fit.solver.free import Free, clipped

TRIES = 8  # of a step, at most: with more damping each time, or twice as far
SHORT = 1.5  # times the predicted drop of the cost, from which a step was too short

Evaluation = tuple[float, float, list[np.ndarray]]  # cost, cost of the data alone, residual of each piece
Evaluate = Callable[[np.ndarray], Evaluation | None]


@dataclass
class Step:
    """The outcome of one damped step: `flat` where none is worth taking; `ratio` of actual to predicted drop."""

    taken: bool
    flat: bool
    damping: float
    ratio: float = 0.0
    values: np.ndarray | None = None
    evaluation: Evaluation | None = None


def downhill(
    evaluate: Evaluate, free: list[Free], values: np.ndarray, cost: float, normal: np.ndarray, gradient: np.ndarray,
    damping: float, tolerance: float,
) -> Step:  # fmt: skip
    """Raise the damping until a step lowers the cost, or until none is predicted to matter."""
    scales = np.array([f.scale for f in free])
    for _ in range(TRIES):
        step = _bounded_step(free, values, normal, gradient, damping)
        predicted = -(2 * gradient @ step + step @ normal @ step)
        if predicted < tolerance * len(free):
            return Step(False, True, damping)
        moved = clipped(free, values + step * scales)
        there = evaluate(moved)
        if there is not None and there[0] < cost:
            ratio = (cost - there[0]) / predicted
            if ratio > SHORT:
                moved, there = _further(evaluate, free, values, moved, there)
            damping = max(damping * (0.1 if ratio > 0.5 else 1.0 if ratio > 0.1 else 4.0), 1e-9)
            return Step(True, False, damping, ratio, moved, there)
        damping = max(damping, 1e-6) * 8
    return Step(False, False, damping)


def _further(
    evaluate: Evaluate, free: list[Free], values: np.ndarray, moved: np.ndarray, there: Evaluation
) -> tuple[np.ndarray, Evaluation]:
    """A step doubled while that lowers the cost: noise in a Jacobian of differences makes all of its steps short."""
    for _ in range(TRIES):
        further = clipped(free, 2 * moved - values)
        beyond = evaluate(further)
        if beyond is None or beyond[0] >= there[0]:
            break
        moved, there = further, beyond
    return moved, there


def _bounded_step(
    free: list[Free], values: np.ndarray, normal: np.ndarray, gradient: np.ndarray, damping: float
) -> np.ndarray:
    """Damped Gauss-Newton step; parameters that would leave their bounds are set onto them one by one."""
    size = len(free)
    step, active = np.zeros(size), np.ones(size, dtype=bool)
    lower = np.array([(f.lower - v) / f.scale for f, v in zip(free, values, strict=True)])
    upper = np.array([(f.upper - v) / f.scale for f, v in zip(free, values, strict=True)])
    damped = normal + damping * np.diag(np.maximum(np.diag(normal), 1e-12 * np.max(np.diag(normal), initial=1e-30)))
    for _ in range(size):
        index = np.flatnonzero(active)
        if not len(index):
            break
        load = -gradient[index] - damped[np.ix_(index, ~active)] @ step[~active]
        step[index] = np.linalg.lstsq(damped[np.ix_(index, index)], load, rcond=1e-14)[0]
        outside = index[(step[index] < lower[index]) | (step[index] > upper[index])]
        if not len(outside):
            break
        step[outside] = np.clip(step[outside], lower[outside], upper[outside])
        active[outside] = False
    return step
