"""How far an experiment sets two fitted explanations apart, once the wrong one has been fitted to it as well.

With d the difference of the predictions and J what the rival's parameters do to its own, both in units of noise, and N
what is known of the parameters from the recordings there are (the normal matrix of its fit, beliefs included), the
refitted rival misses by

    s^2 = min over z of |d - J z|^2 + z' N z = d'd - (J'd)' (J'J + N)^-1 (J'd)

to first order: s is the distance in standard deviations, and s^2 what a likelihood ratio would gain on average.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from lacuna.discovery.case.cases import Recording
from lacuna.discovery.fit.fit import Fit
from lacuna.discovery.fit.objective import Objective
from lacuna.discovery.fit.solver.least_squares import Problem

Outputs = dict[str, np.ndarray]


@dataclass(frozen=True)
class Rival:
    """An explanation with its name; fitted, and free of anything that holds it near a recording."""

    label: str
    fit: Fit

    def predicted(self, recording: Recording) -> Outputs | None:
        """What it says of the outputs, SI; None where it cannot be simulated."""
        found = self.fit.machine.simulate(self.fit.point, recording)
        return found if found is not None and all(np.isfinite(v).all() for v in found.values()) else None


def released(label: str, fit: Fit) -> Rival:
    """A rival of a fit whose shafts may be held: they are let go."""
    machine = fit.machine
    if machine.amendment.trackers:
        machine = machine.amended(replace(machine.amendment, trackers=[]))
        fit = replace(fit, machine=machine)
    return Rival(label, fit)


def spread(first: Fit, correlation: Mapping[str, float]) -> dict[str, float]:
    """What counts as one standard deviation of each output: its noise, or what the best explanation leaves while that
    is larger, as few samples of it as are independent."""
    return {c: n.std * first.level[c] * float(np.sqrt(correlation[c])) for c, n in first.noise.items()}


def distance(one: Outputs, other: Outputs, sigma: Mapping[str, float]) -> dict[str, float]:
    """Of two predictions in each output, nothing refitted."""
    return {c: float(np.linalg.norm((one[c] - other[c]) / s)) for c, s in sigma.items()}


def refitted_distance(truth: Outputs, rival: Rival, recording: Recording, sigma: Mapping[str, float]) -> float:
    """What the rival misses an experiment by that goes as `truth` says, once it is fitted to it too; 0 where it cannot
    be simulated."""
    fit = rival.fit
    seen = replace(recording, columns=recording.columns | truth)
    objective = Objective(fit.machine, [seen], fit.noise)
    problem = Problem(fit.estimate.free, objective, 1, fit.fixed)
    # Objective divides by noise and weighs samples by what repeats in them: here each counts by `sigma` alone
    objective.samples = [{c: np.full(len(seen.time), fit.noise[c].std / sigma[c]) for c in sigma}]
    here = problem.evaluate(fit.estimate.values)
    if here is None:
        return 0.0
    columns = problem.jacobian(fit.estimate.values, here[2], list(range(len(fit.estimate.free))))
    left, known = here[2][0], _known(fit)
    if not columns:
        return float(np.linalg.norm(left))
    jacobian = np.column_stack([columns[k][0] for k in sorted(columns)])
    pull = jacobian.T @ left
    step = np.linalg.lstsq(jacobian.T @ jacobian + known, pull, rcond=1e-12)[0]
    return float(np.sqrt(max(left @ left - pull @ step, 0.0)))


def _known(fit: Fit) -> np.ndarray:
    """(p, p): what recordings and beliefs say of the parameters, in scaled coordinates; samples that are alike count
    as one. A parameter at its bound is known."""
    free = fit.estimate.free
    beliefs = np.diag([(f.scale / f.sigma) ** 2 if f.sigma else 0.0 for f in free])
    normal = fit.estimate.normal
    data = (normal - beliefs) / fit.inflation() if normal.any() else np.zeros_like(beliefs)
    return data + beliefs
