"""Where effort is missing: for every place the smallest effort, as a function of time, that would explain the data.

A probe at a place (a torque on a shaft, a voltage in a line) is a piecewise linear function of time. The response to
each of its nodes is simulated, and the nodes follow by least squares together with the parameters, smoothed so that
noise is not turned into effort. Places are ranked by how much of the misfit of all signals one of them explains; an
error of a sensor explains its own signal only.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from itertools import pairwise

import numpy as np
from scipy.linalg import block_diag

from lacuna.discovery.case.cases import Case
from lacuna.discovery.catalogue.amend import tracker_name
from lacuna.discovery.catalogue.places import Line, Shaft
from lacuna.discovery.fit.fit import Fit, falling_bandwidths
from lacuna.discovery.fit.machine import Machine
from lacuna.discovery.fit.objective import Objective
from lacuna.discovery.fit.tracking import trackable
from lacuna.discovery.law.organise import Organiser, organiser
from lacuna.discovery.law.response import respond
from lacuna.discovery.naming.screen import Screen

NODES = 24  # of a probe in each recording
SMOOTHING = 0.3  # weight of the probe's bends against the misfit


@dataclass
class PlaceEffort:
    """One place: the share of the misfit it explains and its effort on each recording, (time, effort) at the nodes.

    `error` is its 1-sigma there."""

    location: str
    kind: str  # torque | voltage | sensor error
    unit: str
    explained: float
    effort: dict[str, tuple[np.ndarray, np.ndarray]] = field(default_factory=dict)
    error: dict[str, np.ndarray] = field(default_factory=dict)


@dataclass
class Located:
    """Places, best first; and the variable that organises the best one's effort."""

    places: list[PlaceEffort]
    organiser: Organiser | None = None
    values: np.ndarray = field(default_factory=lambda: np.zeros(0))  # of the organiser, on the recordings' samples
    effort: np.ndarray = field(default_factory=lambda: np.zeros(0))

    @property
    def best(self) -> PlaceEffort | None:
        """The best place where an effort can act."""
        return next((p for p in self.places if p.effort), None)


def locate(case: Case, base: Fit) -> Located:
    """Rank the places of the fitted model by what an effort there could explain."""
    structure = base.machine.amendment.structure
    probes: list[Shaft | Line] = [*structure.shafts, *structure.lines]
    screen = Screen(base)
    places = [_sensor(case, screen, k) for k in range(len(case.outputs))]
    if probes:
        machine = base.machine.amended(replace(base.machine.amendment, probes=tuple(probes)), case)
        places += [_probe(machine, screen, base, k, probe) for k, probe in enumerate(probes)]
    places.sort(key=lambda p: -p.explained)
    located = Located(places)
    if located.best is not None:
        located.organiser, located.values, located.effort = _organised(located.best, base, case)
    return located


def effort_at(case: Case, base: Fit, location: str) -> PlaceEffort | None:
    """What is missing at one place of a model; None where no effort can act there."""
    structure = base.machine.amendment.structure
    for probe in (*structure.shafts, *structure.lines):
        if location == place_of(probe):
            machine = base.machine.amended(replace(base.machine.amendment, probes=(probe,)), case)
            return _probe(machine, Screen(base), base, 0, probe)
    return None


def place_of(probe: Shaft | Line) -> str:
    """What the place of an effort is called."""
    if isinstance(probe, Shaft):
        return probe.location
    return f"{probe.load}{':' + probe.phase if probe.phase else ''}"


def _probe(machine: Machine, screen: Screen, base: Fit, k: int, probe: Shaft | Line) -> PlaceEffort:
    torque = isinstance(probe, Shaft)
    response = respond(machine, base, k, NODES)
    for block, weight in zip(response.blocks, screen.weights, strict=True):
        block *= weight[:, None]
    share, nodes, errors = _smoothest(screen, response.blocks)
    own = {r.name: slice(i * NODES, (i + 1) * NODES) for i, r in enumerate(screen.recordings)}
    effort = {name: (response.nodes[i], nodes[rows]) for i, (name, rows) in enumerate(own.items())}
    error = {name: errors[rows] for name, rows in own.items()}
    return PlaceEffort(
        place_of(probe), "torque" if torque else "voltage", "N.m" if torque else "V", share, effort, error
    )


def _smoothest(screen: Screen, blocks: list[np.ndarray]) -> tuple[float, np.ndarray, np.ndarray]:
    """(share of the cost explained, nodes, their 1-sigma) of the effort with the least bends for the residual.

    `blocks[i]` (rows, nodes) answers in recording i alone: so the normal equations are built a recording at a time.
    """
    target = screen.load - screen.orthogonal @ (screen.orthogonal.T @ screen.load)
    ends = np.cumsum([0, *(len(b) for b in blocks)])
    rows = [slice(a, b) for a, b in pairwise(ends)]
    taken = np.hstack([screen.orthogonal[r].T @ b for r, b in zip(rows, blocks, strict=True)])  # by the parameters
    normal = block_diag(*(b.T @ b for b in blocks)) - taken.T @ taken
    right = -np.concatenate([b.T @ target[r] for r, b in zip(rows, blocks, strict=True)])
    bends = np.kron(np.eye(len(blocks)), np.diff(np.eye(NODES), 2, axis=0))
    smoothed = normal + bends.T @ bends * 1e-3 * SMOOTHING * float(np.mean(np.diag(normal)))
    nodes = np.linalg.lstsq(smoothed, right, rcond=1e-10)[0]
    left = max(float(target @ target) - 2 * float(right @ nodes) + float(nodes @ normal @ nodes), 0.0)
    errors = np.sqrt(np.maximum(np.diag(np.linalg.pinv(smoothed, hermitian=True)), 0.0))
    return 1.0 - left / screen.cost, nodes, errors


def _sensor(case: Case, screen: Screen, k: int) -> PlaceEffort:
    """An error of one sensor: it can take away all of its own signal's misfit and nothing else."""
    column = case.outputs[k].column
    parts, start = [], 0
    for recording in screen.recordings:
        size = len(recording.time)
        own = screen.residual[start + k * size : start + (k + 1) * size]
        parts.append(float(own @ own))
        start += size * len(case.outputs)
    share = sum(parts) / screen.norm**2
    return PlaceEffort(f"sensor:{column}", "sensor error", case.outputs[k].model_unit, share)


def _organised(best: PlaceEffort, base: Fit, case: Case) -> tuple[Organiser, np.ndarray, np.ndarray]:
    """(organiser of the best place's effort, its values and the effort, both on the samples of the fit recordings)."""
    structure = base.machine.amendment.structure
    angles = [f"{s.location}.phi" for s in structure.shafts]
    names = [f"{s.location}.w" for s in structure.shafts] + angles + [f"{line.load}.i" for line in structure.lines]
    names += [s.variable for s in case.signals.values()]
    known = base.machine.model.variables
    names = [n for n in dict.fromkeys(names) if n in known]
    runs = [base.machine.trajectory(base.point, r, names) for r in case.fit]
    variables = {n: (known[n].unit or "1", np.concatenate([run[n] for run in runs])) for n in names}
    variables["time"] = ("s", np.concatenate([r.time for r in case.fit]))
    courses = _tracked_effort(best, base, case) or [np.interp(r.time, *best.effort[r.name]) for r in case.fit]
    effort = np.concatenate(courses)
    found = organiser(effort, variables, {n for n in angles if n in known})
    return found, variables[found.variable][1], effort


def _tracked_effort(best: PlaceEffort, base: Fit, case: Case) -> list[np.ndarray] | None:
    """The torque (n,) that holds a shaft to its recorded motion, on each recording; None where none is recorded."""
    shafts = trackable(case, base.machine.model, base.machine.amendment.structure)
    shaft = next((s for s in shafts if s.location == best.location), None)
    if shaft is None:
        return None
    machine = base.machine.amended(replace(base.machine.amendment, trackers=[shaft]), case)
    objective = Objective(machine, case.fit, base.noise)
    objective.track(falling_bandwidths(case, machine)[0], base.point)
    runs = [machine.simulate(base.point | objective.stiffness, r) for r in case.fit]
    return None if any(run is None for run in runs) else [run[tracker_name(0)] for run in runs]
