"""Weighted nonlinear least squares: Levenberg-Marquardt with bounds and Gaussian beliefs.

The residual is split into pieces (one a recording), so that a Jacobian by finite differences is a list of
independent tasks: a simulation releases the interpreter lock, and threads use all cores. Work is done in the
scaled coordinates z = (value - centre) / scale of each parameter, where one unit is a believed sigma.

Reference: J. J. More, The Levenberg-Marquardt algorithm: implementation and theory, 1978.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
import os

import numpy as np
from scipy.optimize import lsq_linear

from lacuna.discovery.fit import time_limit

WORKERS = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
_pool = ThreadPoolExecutor(max_workers=WORKERS)

TRIES = 8  # of a step, at most: with more damping each time, or twice as far
SHORT = 1.5  # times the predicted drop of the cost, from which a step was too short

Residual = Callable[[dict[str, float], int], np.ndarray | None]


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


@dataclass
class Estimate:
    """Where a fit ended. `cost` is the sum of squares of data and belief; `data_cost` of the data alone; `begun` the
    cost where it began."""

    free: list[Free]
    values: np.ndarray
    begun: float
    cost: float
    data_cost: float
    residuals: list[np.ndarray]
    normal: np.ndarray  # J'J of data and belief in scaled coordinates, at `values`
    converged: bool
    iterations: int
    simulations: int
    jacobian: list[np.ndarray] = field(default_factory=list, repr=False)

    def __getitem__(self, name: str) -> float:
        return float(self.values[[f.name for f in self.free].index(name)])

    @property
    def point(self) -> dict[str, float]:
        return {f.name: float(v) for f, v in zip(self.free, self.values, strict=True)}

    def at_bound(self, name: str) -> bool:
        k = [f.name for f in self.free].index(name)
        f, v = self.free[k], self.values[k]
        return min(v - f.lower, f.upper - v) < 1e-6 * f.scale

    def covariance(self, inflation: float = 1.0) -> np.ndarray:
        """Covariance (p, p) in the parameters' units; `inflation` multiplies it (misfit, coloured residuals).

        Parameters at a bound are held: their rows are zero.
        """
        held = [self.at_bound(f.name) for f in self.free]
        inside = np.flatnonzero(~np.array(held, dtype=bool))
        result = np.zeros((len(self.free),) * 2)
        scales = np.array([self.free[k].scale for k in inside])
        block = np.linalg.pinv(self.normal[np.ix_(inside, inside)], hermitian=True)
        result[np.ix_(inside, inside)] = block * np.outer(scales, scales) * inflation
        return result


class Problem:
    """Pieces of whitened residuals as a function of the free parameters."""

    def __init__(self, free: list[Free], residual: Residual, pieces: int, fixed: dict[str, float] | None = None):
        self.free, self.residual, self.pieces = free, residual, pieces
        self.fixed = dict(fixed or {})
        self.weights: list[np.ndarray] | None = None  # of each sample of each piece; None: all one
        self.simulations = 0

    def evaluate_each(self, points: list[np.ndarray]) -> list[list[np.ndarray] | None]:
        """Weighted residuals of all pieces at each point; None where the simulation fails."""
        time_limit.check()
        tasks = [(self._named(p), k) for p in points for k in range(self.pieces)]
        self.simulations += len(tasks)
        parts = list(_pool.map(self._weighted, tasks))
        groups = [parts[k : k + self.pieces] for k in range(0, len(parts), self.pieces)]
        return [None if any(r is None or not np.all(np.isfinite(r)) for r in group) else group for group in groups]

    def _weighted(self, task: tuple[dict[str, float], int]) -> np.ndarray | None:
        result = self.residual(*task)
        return result if result is None or self.weights is None else result * self.weights[task[1]]

    def _named(self, values: np.ndarray) -> dict[str, float]:
        return self.fixed | {f.name: float(v) for f, v in zip(self.free, values, strict=True)}

    def evaluate(self, values: np.ndarray) -> tuple[float, float, list[np.ndarray]] | None:
        """(cost, data cost, residuals) at a point; None where the simulation fails."""
        (parts,) = self.evaluate_each([values])
        if parts is None:
            return None
        data = float(sum(r @ r for r in parts))
        return data + float(np.sum(pulls(self.free, values) ** 2)), data, parts

    def jacobian(self, values: np.ndarray, parts: list[np.ndarray], columns: list[int]) -> dict[int, list[np.ndarray]]:
        """Forward differences of the chosen columns, stepping away from a near bound; failed columns are zero."""
        points, steps = [], []
        for k in columns:
            f = self.free[k]
            h = f.step * f.scale
            if values[k] + h > f.upper:
                h = -h
            point = values.copy()
            point[k] += h
            points.append(point)
            steps.append(h / f.scale)
        result = {}
        for k, h, moved in zip(columns, steps, self.evaluate_each(points), strict=True):
            result[k] = [np.zeros_like(r) for r in parts] if moved is None else [
                (m - r) / h for m, r in zip(moved, parts, strict=True)
            ]  # fmt: skip
        return result


def solve(
    problem: Problem,
    start: np.ndarray | None = None,
    *,
    iterations: int = 30,
    tolerance: float = 1e-4,
    known: dict[int, list[np.ndarray]] | None = None,
    damping: float = 1e-3,
) -> Estimate | None:
    """Minimise the cost from `start` (default: each parameter's start or centre). None if it cannot be simulated there.

    Stops when a step is predicted to lower the cost by less than `tolerance` times the number of parameters.
    `known` columns of the Jacobian (in scaled coordinates) are used as they are while they still lead downhill.
    """
    free = problem.free
    values = clipped(free, [f.centre if f.start is None else f.start for f in free]) if start is None else start.copy()
    here = problem.evaluate(values)
    if here is None:
        return None
    begun, frozen = here[0], dict(known or {})
    converged, count, normal, columns = False, 0, np.zeros((len(free),) * 2), {}
    while count < iterations and free and not converged:
        count += 1
        columns = frozen | problem.jacobian(values, here[2], [k for k in range(len(free)) if k not in frozen])
        normal, gradient = _normal_equations(problem, values, here[2], columns)
        step = _downhill(problem, values, here[0], normal, gradient, damping, tolerance)
        if step.taken:
            values, here, damping = step.values, step.evaluation, step.damping
        elif not frozen:
            converged = step.flat
            break
        if frozen and (not step.taken or step.ratio < 0.3):
            frozen, damping = {}, 1e-3 if not step.taken else damping
    cost, data, parts = here
    return Estimate(
        free, values, begun, cost, data, parts, normal, converged, count, problem.simulations,
        _blocks(columns, problem.pieces),
    )  # fmt: skip


@dataclass
class _Step:
    """The outcome of one damped step: `flat` where none is worth taking; `ratio` of actual to predicted drop."""

    taken: bool
    flat: bool
    damping: float
    ratio: float = 0.0
    values: np.ndarray | None = None
    evaluation: tuple[float, float, list[np.ndarray]] | None = None


def _downhill(
    problem: Problem, values: np.ndarray, cost: float, normal: np.ndarray, gradient: np.ndarray, damping: float,
    tolerance: float,
) -> _Step:  # fmt: skip
    """Raise the damping until a step lowers the cost, or until none is predicted to matter."""
    free = problem.free
    scales = np.array([f.scale for f in free])
    for _ in range(TRIES):
        step = _bounded_step(free, values, normal, gradient, damping)
        predicted = -(2 * gradient @ step + step @ normal @ step)
        if predicted < tolerance * len(free):
            return _Step(False, True, damping)
        moved = clipped(free, values + step * scales)
        there = problem.evaluate(moved)
        if there is not None and there[0] < cost:
            ratio = (cost - there[0]) / predicted
            if ratio > SHORT:
                moved, there = _further(problem, values, moved, there)
            damping = max(damping * (0.1 if ratio > 0.5 else 1.0 if ratio > 0.1 else 4.0), 1e-9)
            return _Step(True, False, damping, ratio, moved, there)
        damping = max(damping, 1e-6) * 8
    return _Step(False, False, damping)


def _further(
    problem: Problem, values: np.ndarray, moved: np.ndarray, there: tuple[float, float, list[np.ndarray]]
) -> tuple[np.ndarray, tuple[float, float, list[np.ndarray]]]:  # fmt: skip
    """A step doubled while that lowers the cost: noise in a Jacobian of differences makes all of its steps short."""
    for _ in range(TRIES):
        further = clipped(problem.free, 2 * moved - values)
        beyond = problem.evaluate(further)
        if beyond is None or beyond[0] >= there[0]:
            break
        moved, there = further, beyond
    return moved, there


def _blocks(columns: dict[int, list[np.ndarray]], pieces: int) -> list[np.ndarray]:
    """The Jacobian of each piece, a column for each parameter."""
    return [np.column_stack([columns[k][piece] for k in sorted(columns)]) for piece in range(pieces)] if columns else []


def _normal_equations(
    problem: Problem, values: np.ndarray, parts: list[np.ndarray], columns: dict[int, list[np.ndarray]]
):
    size = len(problem.free)
    normal, gradient = np.zeros((size, size)), np.zeros(size)
    for piece, residual in enumerate(parts):
        block = np.column_stack([columns[k][piece] for k in range(size)])
        normal += block.T @ block
        gradient += block.T @ residual
    beliefs = pulls(problem.free, values)
    for k, f in enumerate(problem.free):
        if f.sigma:
            weight = f.scale / f.sigma
            normal[k, k] += weight**2
            gradient[k] += weight * beliefs[k]
    return normal, gradient


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


def bounded_linear(columns: np.ndarray, target: np.ndarray, bounds: np.ndarray | None) -> np.ndarray:
    """Coefficients (p,) of columns (rows, p) that come nearest to the target (rows,), within bounds (p, 2) if given."""
    scale = np.linalg.norm(columns, axis=0)
    basis, triangle = np.linalg.qr(columns / scale)
    right = basis.T @ target
    if bounds is None:
        return np.linalg.lstsq(triangle, right, rcond=1e-8)[0] / scale
    # its interior-point method may search for a step for ever where an interval is as good as empty
    return lsq_linear(triangle, right, (bounds[:, 0] * scale, bounds[:, 1] * scale), method="bvls").x / scale
