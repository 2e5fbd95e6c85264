"""Shapes: where the parameters of an effect that have no neutral value start, and how far they may go.

The place of a stop, a Stribeck speed, a time constant: the catalogue lists values, in units of what a variable reaches.
"""

from __future__ import annotations

from itertools import product

import numpy as np

from lacuna.discovery.catalogue.attachment import Attachment
from lacuna.discovery.fit.machine import Machine

ONE_SIDED = 0.05  # of the greatest size of a variable, below which it is not taken to go to that side
RANGE = 10.0  # how far beyond its start values a parameter without a neutral value may go


def shape_starts(
    attachment: Attachment, machine: Machine, names: list[str], point: dict[str, float]
) -> list[dict[str, float]]:
    """Combinations of start values of the parameters that have no neutral value, by full name."""
    effect = attachment.effect
    shape = [n for n in names if n not in effect.neutral and n not in effect.polar]
    shape += [n for n in effect.fixed if n in effect.starts]
    units = {effect.relative[name] for name in shape if name in effect.relative}
    of_time = _times(machine)
    reached = _reached(machine, {u: f"{attachment.component}.{u}" for u in units - of_time.keys()}, point)
    lists = []
    for name in shape:
        starts = effect.starts.get(name, [effect.parameter(name).default])
        unit = effect.relative.get(name)
        if unit in of_time:
            starts = [s * of_time[unit] for s in starts]
            starts = [s for s in starts if unit == "duration" or s < of_time["duration"]] or starts[:1]
        elif unit:
            side = reached[unit] if effect.two_sided(unit) else (0.0, 0.0)
            starts = [s * _size(side[s < 0], max(reached[unit])) for s in starts]
        lists.append([(attachment.full_name(name), s) for s in starts])
    return [dict(combination) for combination in product(*lists)]


def _times(machine: Machine) -> dict[str, float]:
    """The interval of the samples and the length of the longest recording, s."""
    longest = max(machine.case.fit, key=lambda r: r.time[-1] - r.time[0])
    return {"interval": longest.interval, "duration": float(longest.time[-1] - longest.time[0])}


def _reached(
    machine: Machine, variables: dict[str, str], point: dict[str, float]
) -> dict[str, tuple[float, float]]:  # fmt: skip
    """How far each variable goes above and below zero: as recorded, where it is, or else as simulated."""
    columns = {key: machine.recorded(variable) for key, variable in variables.items()}
    unseen = [variable for key, variable in variables.items() if not columns[key]]
    result = dict.fromkeys(variables, (0.0, 0.0))
    for recording in machine.case.fit:
        simulated = machine.trajectory(point, recording, unseen) if unseen else {}
        for key, (high, low) in result.items():
            course = recording.columns[columns[key]] if columns[key] else simulated[variables[key]]
            result[key] = max(high, float(np.nanmax(course))), max(low, -float(np.nanmin(course)))
    return result


def _size(side: float, largest: float) -> float:
    """How far a variable goes to one side; the greatest of both where it hardly goes there, or where none is asked."""
    return (side if side > ONE_SIDED * largest else largest) or 1.0


def limits_of(shapes: list[dict[str, float]]) -> dict[str, tuple[float, float]]:
    """Bounds of the parameters without a neutral value: the range of their starts, widened on a logarithmic scale; none
    where they start at zero."""
    limits = {}
    for name in shapes[0]:
        values = [s[name] for s in shapes]
        sizes = [abs(v) for v in values]
        low, high = min(sizes) / RANGE, max(sizes) * RANGE
        if high:
            limits[name] = (low, high) if values[0] > 0 else (-high, -low)
    return limits
