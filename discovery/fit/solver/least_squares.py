"""Weighted nonlinear least squares: Levenberg-Marquardt with bounds and Gaussian beliefs.

The residual is split into pieces (one a recording), so that a Jacobian by finite differences is a list of
independent tasks: a simulation releases the interpreter lock, and threads use all cores. Work is done in the
scaled coordinates z = (value - centre) / scale of each parameter, where one unit is a believed sigma.

References: J. J. More, The Levenberg-Marquardt algorithm: implementation and theory, 1978; L. K. Schubert, Modification
of a quasi-Newton method for nonlinear equations with a sparse Jacobian, 1970.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from itertools import islice

import numpy as np
from scipy.optimize import lsq_linear

from lacuna.discovery.fit.solver import time_limit
from lacuna.discovery.fit.solver.free import Free, clipped, pulls
from lacuna.discovery.fit.solver.side_by_side import side_by_side
from lacuna.discovery.fit.solver.step import Evaluation, downhill

TRUSTED = 0.3  # times the predicted drop, below which a Jacobian is taken anew
LARGEST = np.finfo(float).max ** 0.25  # a residual beyond it has no J'J: it is squared, as is its quotient by a step

Residual = Callable[[dict[str, float], int], np.ndarray | None]


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
    exact: bool = False  # whether the Jacobian was taken where it ended

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
    """Pieces of whitened residuals as a function of the free parameters; `readers` are the pieces that depend on one,
    where they are not all."""

    def __init__(
        self, free: list[Free], residual: Residual, pieces: int, fixed: dict[str, float] | None = None,
        readers: Mapping[str, list[int]] | None = None,
    ) -> None:  # fmt: skip
        self.free, self.residual, self.pieces, self.readers = free, residual, pieces, dict(readers or {})
        self.fixed = dict(fixed or {})
        self.weights: list[np.ndarray] | None = None  # of each sample of each piece; None: all one
        self.simulations = 0

    def reading(self, k: int) -> list[int]:
        """The pieces that depend on a free parameter."""
        return self.readers.get(self.free[k].name, list(range(self.pieces)))

    def evaluate_each(
        self, points: list[np.ndarray], pieces: list[list[int]] | None = None
    ) -> list[list[np.ndarray] | None]:  # fmt: skip
        """Weighted residuals at each point, of all pieces or of those asked for there; None where the simulation fails
        or leaves all bounds."""
        time_limit.check()
        asked = pieces or [list(range(self.pieces))] * len(points)
        tasks = [(self._named(p), k) for p, ks in zip(points, asked, strict=True) for k in ks]
        self.simulations += len(tasks)
        parts = iter(side_by_side(self._weighted, tasks))
        groups = [list(islice(parts, len(ks))) for ks in asked]
        return [None if any(r is None or not np.all(np.abs(r) < LARGEST) for r in group) else group for group in groups]

    def _weighted(self, task: tuple[dict[str, float], int]) -> np.ndarray | None:
        result = self.residual(*task)
        return result if result is None or self.weights is None else result * self.weights[task[1]]

    def _named(self, values: np.ndarray) -> dict[str, float]:
        return self.fixed | {f.name: float(v) for f, v in zip(self.free, values, strict=True)}

    def evaluate(self, values: np.ndarray) -> Evaluation | None:
        """What the problem is at a point; None where the simulation fails."""
        (parts,) = self.evaluate_each([values])
        return None if parts is None else self.evaluation(values, parts)

    def evaluation(self, values: np.ndarray, parts: list[np.ndarray]) -> Evaluation:
        data = float(sum(r @ r for r in parts))
        return data + float(np.sum(pulls(self.free, values) ** 2)), data, parts

    def jacobian(self, values: np.ndarray, parts: list[np.ndarray], columns: list[int]) -> dict[int, list[np.ndarray]]:
        """Forward differences of the chosen columns, stepping away from a near bound; failed columns are zero."""
        points, steps, readers = [], [], [self.reading(k) for k in columns]
        for k in columns:
            f = self.free[k]
            h = f.step * f.scale
            if values[k] + h > f.upper:
                h = -h
            point = values.copy()
            point[k] += h
            points.append(point)
            steps.append(h / f.scale)
        result = {k: [np.zeros_like(r) for r in parts] for k in columns}
        for k, h, read, moved in zip(columns, steps, readers, self.evaluate_each(points, readers), strict=True):
            for piece, part in zip(read, moved or [], strict=False):
                result[k][piece] = (part - parts[piece]) / h
        return result

    def renewed(self, found: Estimate) -> Estimate:
        """An estimate with its Jacobian taken where it ended."""
        if not self.free:
            return found
        columns = self.jacobian(found.values, found.residuals, list(range(len(self.free))))
        normal, _ = _normal_equations(self, found.values, found.residuals, columns)
        return replace(found, normal=normal, jacobian=_blocks(columns, self.pieces), simulations=self.simulations,
                       exact=True)  # fmt: skip


def solve(
    problem: Problem,
    start: np.ndarray | None = None,
    *,
    iterations: int = 30,
    tolerance: float = 1e-4,
    known: dict[int, list[np.ndarray]] | None = None,
    damping: float = 1e-3,
    here: Evaluation | None = None,
    renewed: bool = True,
    sure: bool = True,
) -> Estimate | None:
    """Minimise the cost from `start` (default: each parameter's start or centre). None if it cannot be simulated there.

    Stops when a step is predicted to lower the cost by less than `tolerance` times the number of parameters, by a
    Jacobian taken there. `known` columns of it (in scaled coordinates) serve while they lead downhill as they say, and
    so does the Jacobian of a step, corrected by what the step has shown (Broyden 1965): differences anew cost a
    simulation a parameter, and are taken where a step misses its prediction; one that is never `renewed` ends
    there. Nor are they taken only to be `sure` that nothing is left to win. `here` is what the problem is at the start.
    """
    free = problem.free
    values = clipped(free, [f.centre if f.start is None else f.start for f in free]) if start is None else start.copy()
    here = here or problem.evaluate(values)
    if here is None:
        return None
    begun, columns, renew, exact = here[0], dict(known or {}), False, False
    converged, count, normal = False, 0, np.zeros((len(free),) * 2)
    while count < iterations and free and not converged:
        count += 1
        missing = [k for k in range(len(free)) if renew or k not in columns]
        columns |= problem.jacobian(values, here[2], missing)
        normal, gradient = _normal_equations(problem, values, here[2], columns)
        step = downhill(problem.evaluate, free, values, here[0], normal, gradient, damping, tolerance)
        if step.taken:
            columns = _corrected(problem, columns, step.values - values, here[2], step.evaluation[2])
            values, here, damping = step.values, step.evaluation, step.damping
        elif len(missing) == len(free) or not renewed or (step.flat and not sure):
            exact = len(missing) == len(free)
            converged = step.flat and exact
            break
        renew = renewed and (not step.taken or step.ratio < TRUSTED)
        damping = damping if step.taken else 1e-3
    cost, data, parts = here
    return Estimate(
        free, values, begun, cost, data, parts, normal, converged, count, problem.simulations,
        _blocks(columns, problem.pieces), exact,
    )  # fmt: skip


def _corrected(
    problem: Problem, columns: dict[int, list[np.ndarray]], moved: np.ndarray, before: list[np.ndarray],
    after: list[np.ndarray],
) -> dict[int, list[np.ndarray]]:  # fmt: skip
    """The Jacobian after a step `moved` (p,): the least change of it that tells what the residuals did, parameters
    measured by the size of their columns (Broyden 1965); of each piece where it may change at all (Schubert 1970)."""
    sizes = {k: np.sqrt(sum(float(c @ c) for c in pieces)) for k, pieces in columns.items()}
    result = {k: list(pieces) for k, pieces in columns.items()}
    for piece, (old, new) in enumerate(zip(before, after, strict=True)):
        read = [k for k in columns if piece in problem.reading(k)]
        step = {k: sizes[k] * moved[k] / problem.free[k].scale for k in read}
        length = sum(v * v for v in step.values())
        if not length > 0:
            continue
        missed = new - old - sum(columns[k][piece] * (moved[k] / problem.free[k].scale) for k in read)
        for k in read:
            result[k][piece] = columns[k][piece] + sizes[k] * step[k] / length * missed
    return result


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


def bounded_linear(columns: np.ndarray, target: np.ndarray, bounds: np.ndarray | None) -> np.ndarray:
    """Coefficients (p,) of columns (rows, p) that come nearest to the target (rows,), within bounds (p, 2) if given;
    any of one that does nothing."""
    scale = np.linalg.norm(columns, axis=0)
    scale[scale == 0] = 1.0
    basis, triangle = np.linalg.qr(columns / scale)
    right = basis.T @ target
    if bounds is None:
        return np.linalg.lstsq(triangle, right, rcond=1e-8)[0] / scale
    # its interior-point method may search for a step for ever where an interval is as good as empty
    return lsq_linear(triangle, right, (bounds[:, 0] * scale, bounds[:, 1] * scale), method="bvls").x / scale
