"""Where effort is missing: for every place the smallest effort, as a function of time, that would explain the data.

A probe at a place (a torque on a shaft, a voltage in a line) is a piecewise linear function of time. The response to
each of its nodes is simulated, and the nodes follow by least squares together with the parameters, smoothed so that
noise is not turned into effort. Places are ranked by how much of the misfit of all signals one of them explains; an
error of a sensor explains its own signal only.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np
from scipy.linalg import block_diag

from .cases import Case
from .fit import Fit
from .machine import Machine
from .places import Line, Shaft
from .response import respond
from .screen import Screen

NODES = 24  # of a probe in each recording
SMOOTHING = 0.3  # weight of the probe's bends against the misfit
BINS = 25


@dataclass
class PlaceEffort:
    """One place: the share of the misfit it explains and its effort on each recording, (time, effort) at the nodes."""

    location: str
    kind: str  # torque | voltage | sensor error
    unit: str
    explained: float
    effort: dict[str, tuple[np.ndarray, np.ndarray]] = field(default_factory=dict)


@dataclass
class Located:
    """Places, best first; and the variable that organises the best one's effort, binned."""

    places: list[PlaceEffort]
    organiser: str = ""
    organised: float = 0.0
    organiser_values: np.ndarray = field(default_factory=lambda: np.zeros(0))
    organiser_effort: np.ndarray = field(default_factory=lambda: np.zeros(0))
    bin_centres: np.ndarray = field(default_factory=lambda: np.zeros(0))
    bin_means: np.ndarray = field(default_factory=lambda: np.zeros(0))

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
        machine = Machine(case, replace(base.machine.amendment, probes=tuple(probes)), base.machine.solver)
        places += [_probe(machine, screen, base, k, probe) for k, probe in enumerate(probes)]
    places.sort(key=lambda p: -p.explained)
    located = Located(places)
    if located.best is not None:
        _organise(located, base, case)
    return located


def _probe(machine: Machine, screen: Screen, base: Fit, k: int, probe: Shaft | Line) -> PlaceEffort:
    torque = isinstance(probe, Shaft)
    response = respond(machine, base, k, NODES)
    blocks = [b * w[:, None] for b, w in zip(response.blocks, screen.weights, strict=True)]
    share, nodes = _smoothest(screen, block_diag(*blocks))
    location = probe.location if torque else f"{probe.load}{':' + probe.phase if probe.phase else ''}"
    effort = {r.name: (response.nodes[i], nodes[i * NODES : (i + 1) * NODES]) for i, r in enumerate(screen.recordings)}
    return PlaceEffort(location, "torque" if torque else "voltage", "N.m" if torque else "V", share, effort)


def _smoothest(screen: Screen, columns: np.ndarray) -> tuple[float, np.ndarray]:
    """(share of the cost explained, nodes) of the effort with the least bends that explains the residual."""
    pad = np.zeros((len(screen.load) - len(screen.residual), columns.shape[1]))
    stack = np.vstack([columns, pad])
    stack = stack - screen.orthogonal @ (screen.orthogonal.T @ stack)
    target = screen.load - screen.orthogonal @ (screen.orthogonal.T @ screen.load)
    normal, right = stack.T @ stack, -stack.T @ target
    bends = np.kron(np.eye(columns.shape[1] // NODES), np.diff(np.eye(NODES), 2, axis=0))
    smooth = bends.T @ bends * SMOOTHING * float(np.mean(np.diag(normal)))
    nodes = np.linalg.lstsq(normal + 1e-3 * smooth, right, rcond=1e-10)[0]
    left = target + stack @ nodes
    return 1.0 - float(left @ left) / screen.cost, nodes


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
    return PlaceEffort(f"sensor:{column}", "sensor error", case.outputs[k].si_unit, share)


def _organise(located: Located, base: Fit, case: Case) -> None:
    """Find the variable whose value tells the best place's effort (correlation ratio over bins)."""
    best = located.best
    shafts = base.machine.amendment.structure.shafts
    names = [f"{s.location}.{v}" for s in shafts for v in ("w", "phi")] + [s.variable for s in case.signals.values()]
    names = [n for n in dict.fromkeys(names) if n in base.machine.model.variables]
    values: dict[str, list[np.ndarray]] = {n: [] for n in [*names, "time"]}
    effort = []
    for recording in case.fit:
        trajectory = base.machine.trajectory(base.point, recording, names)
        nodes, e = best.effort[recording.name]
        effort.append(np.interp(recording.time, nodes, e))
        for n in names:
            values[n].append(trajectory[n])
        values["time"].append(recording.time)
    pooled = np.concatenate(effort)
    for name, series in values.items():
        x = np.concatenate(series)
        ratio, centres, means = _correlation_ratio(x, pooled)
        if ratio > located.organised:
            keep = slice(None, None, max(1, len(x) // 3000))
            located.organiser, located.organised = name, ratio
            located.organiser_values, located.organiser_effort = x[keep], pooled[keep]
            located.bin_centres, located.bin_means = centres, means


def _correlation_ratio(x: np.ndarray, y: np.ndarray) -> tuple[float, np.ndarray, np.ndarray]:
    """Share of the variance of y between bins of x (equal counts), with the bins' centres and means."""
    edges = np.unique(np.quantile(x, np.linspace(0, 1, BINS + 1)))
    if len(edges) < 3 or np.var(y) == 0:
        return 0.0, np.zeros(0), np.zeros(0)
    index = np.clip(np.searchsorted(edges, x, side="right") - 1, 0, len(edges) - 2)
    counts = np.bincount(index, minlength=len(edges) - 1)
    sums = np.bincount(index, y, minlength=len(edges) - 1)
    means = sums / np.maximum(counts, 1)
    between = float(np.sum(counts * (means - y.mean()) ** 2))
    return between / float(np.sum((y - y.mean()) ** 2)), (edges[1:] + edges[:-1]) / 2, means
