"""Values of states at the first sample of a recording that nobody knows.

They are fitted with the parameters where a recording may be fitted. Of one that only judges they are the least that has
to be known before it can be simulated at all: with the parameters as they are, they are fitted to it alone.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from lacuna.discovery.case.cases import Recording
from lacuna.discovery.case.values import start_name
from lacuna.discovery.fit.machine import Machine
from lacuna.discovery.fit.objective import Objective, noise_of
from lacuna.discovery.fit.solver.free import Free
from lacuna.discovery.fit.solver.least_squares import Problem, solve

STEP = 1e-3  # of what a state changes by, for differences


def unknown_starts(machine: Machine, recording: Recording, given: Mapping[str, float]) -> list[Free]:
    """The start values of a recording to be fitted, without a belief, beside those that are given."""
    found = []
    for state in machine.unfitted_states(given, recording):
        guess, size = _guess(machine, state, recording)
        found.append(Free(start_name(state, recording), guess, size, step=STEP))
    return found


def _guess(machine: Machine, state: str, recording: Recording) -> tuple[float, float]:
    """(a value of a state at the first sample, the size of a typical change): as recorded, where it is."""
    column = machine.recorded(state)
    values = recording.columns[column] if column else np.zeros(0)
    seen = values[np.isfinite(values)]
    if len(seen):
        return float(seen[0]), float(np.ptp(seen)) or 1.0
    return 0.0, machine.model.variables[state].nominal or 1.0


def with_starts(machine: Machine, recording: Recording, values: Mapping[str, float]) -> dict[str, float]:
    """The values with the start values that they lack for this recording, fitted to it; unchanged where none is."""
    missing = unknown_starts(machine, recording, values)
    if not missing:
        return dict(values)
    objective = Objective(machine, [recording], noise_of(machine.case))
    found = solve(Problem(missing, objective, 1, dict(values)))
    return dict(values) | (found.point if found else {})
