"""What errors of the recorded inputs do to the simulated outputs: a resolution is an error that a fit must allow for.

A simulation is driven by what the instruments wrote down. Where an input is recorded in steps, the machine saw
something else by up to half a step, and integrates it: an angle walks away at random. Drawn, not linearised.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from runtime import RecordedInput

from .cases import Recording
from .machine import Machine
from .noise import quantum

DRAWS = 6
LEVELS = 50  # different values, from which on an input is taken for a measured signal and not for a set one


def input_errors(
    machine: Machine, recordings: Sequence[Recording], point: Mapping[str, float]
) -> dict[str, list[dict[str, np.ndarray]]]:
    """For each recording, changes of the output columns (n,) under `DRAWS` draws of its inputs' rounding errors.

    No entry for a recording whose inputs have no visible resolution.
    """
    result = {}
    for recording in recordings:
        steps = {s: _resolution(recording.columns[s.column]) for s in machine.case.inputs if s.interpolation != "hold"}
        if not any(steps.values()):
            continue
        plain = machine.simulate(point, recording)
        draws = []
        for k in range(DRAWS):
            random = np.random.default_rng(k)
            inputs = {}
            for signal, step in steps.items():
                values = recording.columns[signal.column]
                good = np.isfinite(values)
                error = step * (random.random(int(good.sum())) - 0.5)
                inputs[signal.variable] = RecordedInput(recording.time[good], values[good] + error)
            moved = machine.simulate(point, recording, inputs)
            if plain is not None and moved is not None:
                draws.append({c: moved[c] - plain[c] for c in moved})
        if draws:
            result[recording.name] = draws
    return result


def _resolution(values: np.ndarray) -> float:
    return quantum(values) if len(np.unique(values[np.isfinite(values)])) >= LEVELS else 0.0
