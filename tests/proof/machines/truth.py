"""What is concealed in a case, integrated until it is true: half of a step moves nothing that could be seen."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from tests.proof.machines.machine import Machine, simulate

if TYPE_CHECKING:
    from tests.proof.machines.generate import Drawn

FINEST = 32  # times the machine's own steps, that its truth may need
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
    """Whether the fit recordings, each effect of several taken away, move by the noise of some output."""
    if len(case.hidden) < 2:
        return True
    values = columns(case.true, case.recordings)
    machine = replace(case.machine, substeps=case.substeps)
    whole = simulate(machine, values, case.drive, case.hidden)
    for left_out in case.hidden:
        others = tuple(h for h in case.hidden if h is not left_out)
        without = simulate(machine, values, case.drive, others)
        moved = [np.sqrt(np.mean((whole[n] - without[n])[:, fit] ** 2)) / case.noise[n] for n in case.outputs]
        if max(moved) < 1.0:
            return False
    return True
