"""The ground around the end of a fit: sensitivities over a standard error, and what the solver's own error and the
rounding of recorded inputs move.

The differences that lead a fit are taken over short steps, and carry the noise of events and of the solver's steps.
Along parameters that the data tells only together that noise is most of what they say, and would pass for information.
So sensitivities are taken anew as central differences, a standard error to both sides along conjugate axes of the
normal equations: principal ones of what all pieces share, and of what is a piece's own, of all pieces at once.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import zip_longest

import numpy as np

from lacuna.discovery.case.cases import Recording
from lacuna.discovery.case.noise import last_digit, of_few_levels
from lacuna.discovery.fit.fit import Fit
from lacuna.discovery.fit.machine import Machine
from lacuna.discovery.fit.objective import Objective
from lacuna.discovery.fit.solver.free import clipped
from lacuna.discovery.fit.solver.least_squares import Estimate, Problem

ROUNDS = 2  # of differences: the axes of the first are those of the noisy ones
FINE = 0.01  # of the solver's tolerance, with which its error is measured
DRAWS = 16  # of the digits of inputs that are not written
UNSEEN = 1e-14  # of the largest eigenvalue of the normal equations, below which nothing is known of an axis


def with_secants(found: Fit) -> Fit:
    """The fit with its Jacobian and normal equations from secants; as it is where it does not run that far to all
    sides."""
    problem, _ = _around(found, found.machine)
    estimate: Estimate | None = found.estimate
    for _ in range(ROUNDS):
        estimate = estimate and problem and _with_secants(problem, estimate)
    return found if estimate is None else replace(found, estimate=estimate, zeroed=None)


def _around(found: Fit, machine: Machine) -> tuple[Problem | None, list[np.ndarray]]:
    """The residual of a fit as a function of its parameters, weighted and held as it is, and its value at the fit's
    own; None where it does not run."""
    objective = Objective(machine, machine.case.fit, found.noise)
    free = found.estimate.free
    problem = Problem(free, objective, len(objective.recordings), found.fixed, objective.readers(f.name for f in free))
    here = problem.evaluate(found.estimate.values)
    if here is None:
        return None, []
    problem.weights = objective.weights(objective.measure(here[2]) | found.level)
    return problem, [p * w for p, w in zip(here[2], problem.weights, strict=True)]


def _with_secants(problem: Problem, estimate: Estimate) -> Estimate | None:
    free, values = estimate.free, estimate.values
    scales = np.array([f.scale for f in free])
    shared, own = _axes(problem, estimate)
    ends = [
        clipped(free, values + side * scales * axis) for axis in [*shared.T, *_at_once(own)] for side in (1.0, -1.0)
    ]
    outputs = problem.evaluate_each(ends)
    if not outputs or any(o is None for o in outputs):
        return None
    moves = np.array([(a - b) / scales for a, b in zip(ends[::2], ends[1::2], strict=True)])
    responses = list(zip(outputs[::2], outputs[1::2], strict=True))
    jacobian = []
    for k in range(problem.pieces):
        read = [n for n in range(len(free)) if k in problem.reading(n)]
        answers = np.linalg.pinv(moves[:, read]) @ np.array([a[k] - b[k] for a, b in responses])
        block = np.zeros((answers.shape[1], len(free)))
        block[:, read] = answers.T
        jacobian.append(block)
    beliefs = np.diag([(f.scale / f.sigma) ** 2 if f.sigma else 0.0 for f in free])
    return replace(estimate, jacobian=jacobian, normal=sum(b.T @ b for b in jacobian) + beliefs)


def _axes(problem: Problem, estimate: Estimate) -> tuple[np.ndarray, list[np.ndarray]]:
    """Axes of the normal equations in scaled coordinates, conjugate and a standard error long; parameters at a bound
    stay there: (p, m) of what several pieces read, where the rest follows, and (p, m) of what each one reads alone."""
    inside = [k for k, f in enumerate(estimate.free) if not estimate.at_bound(f.name)]
    own = [[k for k in inside if problem.reading(k) == [piece]] for piece in range(problem.pieces)]
    rest = [k for ks in own for k in ks]
    shared = [k for k in inside if k not in rest]
    normal = estimate.normal
    follow = -np.linalg.pinv(normal[np.ix_(rest, rest)], hermitian=True) @ normal[np.ix_(rest, shared)]
    along = np.zeros((len(normal), len(shared)))
    along[shared], along[rest] = np.eye(len(shared)), follow
    return along @ _principal(normal[np.ix_(shared, shared)] + normal[np.ix_(shared, rest)] @ follow), [
        np.eye(len(normal))[:, ks] @ _principal(normal[np.ix_(ks, ks)]) for ks in own
    ]


def _principal(normal: np.ndarray) -> np.ndarray:
    """Principal axes (p, m) of normal equations (p, p), a standard error long, of what is known."""
    values, vectors = np.linalg.eigh(normal)
    seen = values > UNSEEN * np.max(values, initial=0.0)
    return vectors[:, seen] / np.sqrt(values[seen])


def _at_once(own: list[np.ndarray]) -> list[np.ndarray]:
    """The first axes of all pieces together, the second ones, and so on: none answers to another one's."""
    return [sum(axis for axis in axes if axis is not None) for axes in zip_longest(*(axes.T for axes in own))]


def solver_shift(found: Fit) -> np.ndarray:
    """How far (p,), to first order, a finer tolerance of the solver would move the values; 0 where it does not run."""
    machine = found.machine
    finer = Machine(machine.case, machine.amendment, machine.solver, source=machine.path, rtol=FINE * machine.rtol)
    return _shifts(found, [finer])[0]


def input_shift(found: Fit) -> np.ndarray:
    """How far (p,), RMS to first order, the digits that are not written of the inputs may move the values."""
    case, random = found.machine.case, np.random.default_rng(0)
    digits = {s.column: s.scale * last_digit([r.columns[s.column] / s.scale for r in case.fit]) for s in case.inputs}
    if not any(digits.values()):
        return np.zeros(len(found.estimate.free))
    open_ended = {
        r.name: [c for c, d in digits.items() if d and not of_few_levels(r.columns[c])] for r in case.fit
    }  # fmt: skip

    def other_digits(recording: Recording) -> Recording:
        count, columns = len(recording.time), recording.columns
        other = {c: columns[c] + digits[c] * random.uniform(-0.5, 0.5, count) for c in open_ended[recording.name]}
        return replace(recording, columns=columns | other)

    drawn = [replace(case, fit=[other_digits(r) for r in case.fit]) for _ in range(DRAWS)]
    machines = [found.machine.amended(found.machine.amendment, c) for c in drawn]
    return np.sqrt(np.mean(_shifts(found, machines) ** 2, axis=0))


def _shifts(found: Fit, machines: list[Machine]) -> np.ndarray:
    """How far (m, p), to first order, each of these machines would move the values; 0 where one does not run."""
    estimate, (problem, here) = found.estimate, _around(found, found.machine)
    outputs = [_around(found, machine)[1] for machine in machines]
    if problem is None or not all(outputs) or not estimate.jacobian:
        return np.zeros((len(machines), len(estimate.free)))
    loads = [sum(b.T @ (t - h) for b, h, t in zip(estimate.jacobian, here, there, strict=True)) for there in outputs]
    shared, own = _axes(problem, estimate)
    axes, scales = np.hstack([shared, *own]), np.array([f.scale for f in estimate.free])
    return -(np.array(loads) @ axes @ axes.T) * scales
