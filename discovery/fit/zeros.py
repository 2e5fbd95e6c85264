"""A fit beside errors of the sensors' zeros, to first order: without another simulation.

A zero is set by a reading and errs by as much as one does. Over thousands of samples that is far more than hypotheses
differ by: of two forms of one law the richer one, or one with a level, takes the zero of a sensor upon itself, and one
that grows with time its drift. So rivals are compared beside zeros, a parameter for each sensor with the noise of a
sample for its belief, and beside how each drifts along each recording, from minus one to plus one of that. To first
order they are one step of Gauss and Newton from the fit, and exact where the outputs are linear in the parameters.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from lacuna.discovery.case.cases import Recording
from lacuna.discovery.fit.evidence import SIGMAS
from lacuna.discovery.fit.fit import Fit, fit
from lacuna.discovery.fit.solver.free import Free, clipped, pulls


def beside_zeros(found: Fit) -> Fit:
    """The fit with a zero (units of its noise) of each output, and its drifts, among its parameters; the same one where
    it has no Jacobian."""
    estimate = found.estimate
    if not estimate.jacobian:
        return found
    if found.zeroed is None:
        found.zeroed = _stepped(found)
    return found.zeroed


def largest_zero(found: Fit) -> float:
    """Of the zeros and drifts that a fit tells beside itself, in units of noise; infinite where it has no Jacobian."""
    told = _told(found)
    return float(np.max(np.abs(told))) if len(told) else float("inf")


def zeros_of(found: Fit) -> dict[str, float]:
    """The zero of each output that a fit tells beside itself, SI; nothing where it has no Jacobian."""
    told = _told(found)
    if not len(told):
        return dict.fromkeys(found.noise, 0.0)
    return {c: float(z) * n.std for (c, n), z in zip(found.noise.items(), told, strict=False)}


def _told(found: Fit) -> np.ndarray:
    """The zeros, then the drifts, in units of noise; none where the fit has no Jacobian."""
    return beside_zeros(found).estimate.values[len(found.estimate.free) :]


def without_zeros(found: Fit) -> Fit:
    """The fit anew, to its recordings less the zeros and the drifts that it tells beside itself; the same one where it
    has no Jacobian, or does not run there. What is not recorded may else take a sensor's zero upon itself."""
    beside = beside_zeros(found)
    if beside is found:
        return found
    told = beside.estimate.point
    recordings = [_less(r, found, told) for r in found.machine.case.fit]
    machine = found.machine.amended(found.machine.amendment, replace(found.machine.case, fit=recordings))
    again = fit(machine, recordings, found.noise, found.estimate.free, found.fixed, start=found.fixed | told,
                known=found.sensitivities())  # fmt: skip
    return again or found


def _less(recording: Recording, found: Fit, told: dict[str, float]) -> Recording:
    """The recording without the zeros of its columns, and without their drifts along it."""
    along = np.linspace(-1.0, 1.0, len(recording.time))
    errors = {c: told[_zero(c)] + told[_drift(c, recording.name)] * along for c in found.noise}
    own = {c: recording.columns[c] - e * found.noise[c].std for c, e in errors.items()}
    return replace(recording, columns={**recording.columns, **own})


def _zero(column: str) -> str:
    return f"zero of {column}"


def _drift(column: str, recording: str) -> str:
    return f"drift of {column} in {recording}"


def _stepped(found: Fit) -> Fit:
    estimate, columns = found.estimate, _columns(found)
    belief = [(f.scale / f.sigma) ** 2 if f.sigma else 0.0 for f in estimate.free]
    every = sum(j.T @ j for j in estimate.jacobian) + np.diag(belief)  # estimate.normal may be that of another point
    inside = np.flatnonzero([not estimate.at_bound(f.name) for f in estimate.free])
    normal = every[np.ix_(inside, inside)]
    cross = sum(j[:, inside].T @ z for j, z in zip(estimate.jacobian, columns, strict=True))
    own = sum(z.T @ z for z in columns) + np.eye(columns[0].shape[1])
    shift = np.linalg.lstsq(normal, cross, rcond=None)[0]  # of the parameters, by each zero
    load = sum(z.T @ r for z, r in zip(columns, estimate.residuals, strict=True))
    zeros = np.linalg.solve(own - cross.T @ shift, load)
    zeros = np.clip(zeros, -SIGMAS, SIGMAS)  # further off, it is what is missing that they stand for
    values = estimate.values.copy()
    values[inside] += np.array([estimate.free[k].scale for k in inside]) * (shift @ zeros)
    moves = [j[:, inside] @ (shift @ zeros) - z @ zeros for j, z in zip(estimate.jacobian, columns, strict=True)]
    residuals = [r + m for r, m in zip(estimate.residuals, moves, strict=True)]
    names = [_zero(c) for c in found.noise]
    names += [_drift(c, name) for name in found.residuals for c in found.noise]
    free = [*estimate.free, *(Free(name, 0.0, 1.0, sigma=1.0) for name in names)]
    values = np.append(clipped(estimate.free, values), zeros)
    data_cost = float(sum(r @ r for r in residuals))
    whole = np.zeros((len(estimate.free), len(zeros)))
    whole[inside] = cross
    stepped = replace(
        estimate,
        free=free,
        values=values,
        cost=data_cost + float(np.sum(pulls(free, values) ** 2)),
        data_cost=data_cost,
        residuals=residuals,
        normal=np.block([[every, -whole], [-whole.T, own]]),
        jacobian=[np.hstack([j, -z]) for j, z in zip(estimate.jacobian, columns, strict=True)],
    )
    moved = {name: found.moved(name, move) for name, move in zip(found.residuals, moves, strict=True)}
    return replace(found, estimate=stepped, residuals=moved, zeroed=None)


def _columns(found: Fit) -> list[np.ndarray]:
    """What the weighted residual (n, outputs) of each recording falls by with each zero, and with each drift along each
    recording."""
    result, count = [], len(found.noise)
    for r, (part, weights) in enumerate(zip(found.estimate.residuals, found.weights.values(), strict=True)):
        own = np.zeros((len(part), count * (1 + len(found.weights))))
        for k, column in enumerate(found.noise):
            weight = weights[column]
            rows, zero = slice(k * len(weight), (k + 1) * len(weight)), weight / found.level[column]
            own[rows, k] = zero
            own[rows, count * (1 + r) + k] = zero * np.linspace(-1.0, 1.0, len(weight))
        result.append(own)
    return result
