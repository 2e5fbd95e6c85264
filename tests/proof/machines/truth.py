"""What is concealed in a case, integrated until it is true: half of a step moves nothing that could be seen."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from tests.proof.machines.machine import Machine, simulate

if TYPE_CHECKING:
    from tests.proof.machines.generate import Drawn

FINEST = 32  # times the machine's own steps, that its truth may need
STEP = 0.01  # believed sigmas, by which a parameter is moved for its response
TRUE = 0.1  # of the noise, by which a truth may differ from that of half the step


def columns(values: dict[str, float], count: int) -> dict[str, np.ndarray]:
    """Each value for so many recordings."""
    return {n: np.full(count, v) for n, v in values.items()}


def truth(case: Drawn) -> dict[str, np.ndarray] | None:
    """The machine with what is concealed, its steps halved until half of one changes nothing that could be seen; None
    where no step does."""
    values = columns(case.true, case.recordings)

    def at(machine: Machine) -> dict[str, np.ndarray]:
        with np.errstate(all="ignore"):
            return simulate(machine, values, case.drive, case.hidden)

    machine = replace(case.machine, substeps=case.substeps or case.machine.substeps)
    coarse = at(machine)
    while machine.substeps <= FINEST * case.machine.substeps:
        finer = replace(machine, substeps=2 * machine.substeps)
        fine = at(finer)
        apart = [float(np.sqrt(np.mean((fine[n] - coarse[n]) ** 2))) / case.noise[n] for n in case.noise]
        if max(apart, key=lambda a: np.inf if np.isnan(a) else a) < TRUE:
            case.substeps = machine.substeps
            return coarse
        machine, coarse = finer, fine
    return None


def each_shows(case: Drawn, fit: slice) -> bool:
    """Whether the fit recordings, each effect of several taken away, move by the noise of some output, and by more than
    parameters within their beliefs stand in for (to first order): what they do is no physics that anyone could find."""
    if len(case.hidden) < 2:
        return True
    values = columns(case.true, case.recordings)
    machine = replace(case.machine, substeps=case.substeps)

    def outputs(values: dict[str, np.ndarray], hidden: tuple) -> np.ndarray:
        run = simulate(machine, values, case.drive, hidden)
        return np.stack([run[n][:, fit] / case.noise[n] for n in case.outputs])

    whole = outputs(values, case.hidden)
    believed = {n: p.sigma for n, p in machine.parameters.items() if p.sigma}
    for left_out in case.hidden:
        others = tuple(h for h in case.hidden if h is not left_out)
        without = outputs(values, others)
        moved = [outputs(values | {n: values[n] * (1 + STEP * s)}, others) for n, s in believed.items()]
        answers = np.stack([((m - without) / STEP).ravel() for m in moved], axis=1)
        shown = (whole - without).ravel()
        normal = answers.T @ answers + np.eye(len(believed))  # in believed sigmas
        left = (shown - answers @ np.linalg.solve(normal, answers.T @ shown)).reshape(whole.shape)
        if np.sqrt(np.mean(left**2, axis=(1, 2))).max() < 1.0:
            return False
    return True
