"""What holds in one recording only: states at its first sample that nobody knows, or only as well as noise lets them,
and parameters with a value of their own there.

They are fitted with the parameters where a recording may be fitted. Of one that only judges they are the least that has
to be known before it can be simulated, and no other recording tells them: with the parameters as they are, they are
fitted to it alone, within what is believed of them. A state that is recorded is believed to be what the first sample
says, within the noise of its column: one that nothing brings back, an angle, would carry the noise of that one sample
to the end.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from itertools import islice

import numpy as np

from lacuna.discovery.case.cases import DEFAULT_UNCERTAINTY, Recording
from lacuna.discovery.case.gaps import JOINED, cut
from lacuna.discovery.case.noise import Noise
from lacuna.discovery.case.values import is_start, own_name, start_name, state_of
from lacuna.discovery.fit.machine import Machine
from lacuna.discovery.fit.objective import Objective, noise_of
from lacuna.discovery.fit.solver.free import Free
from lacuna.discovery.fit.solver.least_squares import Problem, solve
from lacuna.runtime import SimulationError, Variable

LOWER_SHARE = 0.02  # of its believed value, below which no positive parameter is tried
STEP = 1e-3  # of what a state changes by, for differences


def uncertain(name: str, value: float, sigma: float, variable: Variable) -> Free:
    """A parameter with its belief."""
    low, high = (LOWER_SHARE * value, np.inf) if value > 0 else (-np.inf, np.inf)
    step = min(1e-2, 3e-4 * abs(value) / sigma)
    return Free(name, value, sigma, max(low, variable.min), min(high, variable.max), sigma, step=step)


def own_beliefs(machine: Machine, file: str) -> dict[str, tuple[float, float]]:
    """Of each parameter that has a value of its own in a recording: that, and how far it may be off (one sigma)."""
    case, own, found = machine.case, machine.case.own[file], {}
    for name in dict.fromkeys([*own.parameters, *own.uncertainty]):
        value = own.parameters.get(name, case.parameters.get(name, machine.model.variables[name].start))
        share = own.uncertainty.get(name, case.uncertainty.get(name, DEFAULT_UNCERTAINTY))
        found[name] = value, share * abs(value)
    return found


def _own(machine: Machine, recording: Recording) -> list[Free]:
    """The uncertain parameters of its own of a recording that only judges."""
    if recording.file not in machine.case.own or any(r.file == recording.file for r in machine.case.fit):
        return []
    return [
        uncertain(own_name(name, recording.file), value, sigma, machine.model.variables[name])
        for name, (value, sigma) in own_beliefs(machine, recording.file).items() if sigma > 0
    ]  # fmt: skip


def uncertain_starts(machine: Machine, recording: Recording, given: Mapping[str, float]) -> list[Free]:
    """The start values of a recording to be fitted, beside those that are given."""
    unfitted = machine.unfitted_states(given, recording)
    noise = noise_of(machine.case) if unfitted else {}
    found = [_start(machine, s, sample, recording, noise) for s, sample in unfitted.items()]
    hidden = [s for s in unfitted if machine.recorded(s) is None and s in machine.model.variables]
    return as_known_to(machine, _sized(machine, recording, given, found, hidden))


def _sized(
    machine: Machine, recording: Recording, given: Mapping[str, float], starts: list[Free], hidden: list[str]
) -> list[Free]:  # fmt: skip
    """The starts, those of `hidden` states in units of what these change by on a run from here."""
    if not hidden:
        return starts
    try:
        courses = machine.trajectory(dict(given) | {f.name: f.centre for f in starts}, recording, hidden)
    except SimulationError:
        return starts
    reach = {start_name(s, recording): float(np.ptp(course)) for s, course in courses.items()}
    return [replace(f, scale=reach.get(f.name) or f.scale) for f in starts]


def _start(
    machine: Machine, state: str, sample: float | None, recording: Recording, noise: Mapping[str, Noise]
) -> Free:  # fmt: skip
    column, name = machine.recorded(state), start_name(state, recording)
    if sample is not None and column:
        std = noise[column].std
        return Free(name, sample, std, sigma=std, step=1.0)
    seen = recording.columns[column] if column else np.zeros(0)
    seen = seen[np.isfinite(seen)]
    told = machine.model.variables[state]
    guess = float(seen[0]) if len(seen) else told.start
    size = float(np.ptp(seen)) if len(seen) else abs(guess) or told.nominal
    return Free(name, guess, size or 1.0, step=STEP)


def with_starts(machine: Machine, recording: Recording, values: Mapping[str, float]) -> dict[str, float]:
    """The values with those of this recording only that no other one tells, fitted to it; unchanged where none is."""
    missing = [*uncertain_starts(machine, recording, values), *_own(machine, recording)]
    missing = begun(machine, recording, missing, values)
    return dict(values) | {f.name: f.centre if f.start is None else f.start for f in missing}


def begun(
    machine: Machine, recording: Recording, missing: list[Free], values: Mapping[str, float]
) -> list[Free]:  # fmt: skip
    """Missing values, with those to start from that fit the recording: its beginning, and then all of it."""
    parts = [
        *islice(cut(recording, machine.case.inputs, JOINED), int(any(f.sigma is None for f in missing))),
        recording,
    ]
    for part in parts if missing else []:
        found = solve(Problem(missing, Objective(machine, [part], noise_of(machine.case)), 1, dict(values)))
        missing = [replace(f, start=found.point[f.name]) for f in missing] if found else missing
    return missing


def as_known_to(machine: Machine, free: list[Free]) -> list[Free]:
    """Free values with no belief in a start that this machine tells from what was recorded: a hypothesis that adds to
    an equation such as v = vC makes two variables of them, and the first sample is of the one that is no state."""
    return [
        replace(f, sigma=None) if is_start(f.name) and state_of(f.name) not in machine.model.states else f for f in free
    ]


def in_doubt(machine: Machine, free: list[Free], variable: str) -> list[Free]:
    """Free values where the sensor of a variable may be wrong: its first sample is no belief then."""
    column = machine.recorded(variable)
    if column is None:
        return free
    return [replace(f, sigma=None) if machine.recorded(state_of(f.name)) == column else f for f in free]
