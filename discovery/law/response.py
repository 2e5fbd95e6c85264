"""What a small effort at a place changes in the recorded signals, a hat of effort at a time.

The answer to any other effort is the sum of the answers to its hats (to first order), so that every course of effort is
judged without another simulation. Answers to many hats come from the equations linearised along the trajectory, where
these say of one of them what a simulation says; events that a small effort moves are not in them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from lacuna.discovery.catalogue.amend import probe_name
from lacuna.discovery.efforts.latent.linear import Linear
from lacuna.discovery.efforts.latent.numeric import NotNumeric
from lacuna.discovery.fit.fit import Fit, Objective
from lacuna.discovery.fit.machine import Machine
from lacuna.discovery.fit.objective import where_measured
from lacuna.discovery.fit.solver.side_by_side import side_by_side
from lacuna.runtime import RecordedInput, SimulationError

LINEAR = (1e-3, 0.3)  # sizes of an answer that is above rounding and still proportional, in shares of the residual
FOLLOWED = 0.5  # of an effort's power, that hats may miss: what is faster would pass for a slow effort


@dataclass
class Response:
    """`blocks[i]` (rows, hats): change of recording i's residual, in units of noise, for one unit of each hat."""

    nodes: list[np.ndarray]  # times of the hats' peaks in each recording, evenly spaced, s
    blocks: list[np.ndarray]

    def to(self, effort: Sequence[np.ndarray], times: Sequence[np.ndarray]) -> list[np.ndarray]:
        """The change for efforts (n,) on the recordings' samples; none for those that are too fast for the hats."""
        hats = [_hats(n, e, t) for n, e, t in zip(self.nodes, effort, times, strict=True)]
        followed = [np.interp(t, n, h) for n, h, t in zip(self.nodes, hats, times, strict=True)]
        missed = sum(float(np.sum((e - f) ** 2)) for e, f in zip(effort, followed, strict=True))
        if missed > FOLLOWED * sum(float(e @ e) for e in effort):
            return [np.zeros(len(b)) for b in self.blocks]
        return [b @ h for b, h in zip(self.blocks, hats, strict=True)]


def _hats(nodes: np.ndarray, effort: np.ndarray, time: np.ndarray) -> np.ndarray:
    """Amounts of the hats that come closest to an effort: its means under each hat."""
    place = np.clip((time - nodes[0]) / (nodes[1] - nodes[0]), 0.0, len(nodes) - 1.0)
    left = np.minimum(place.astype(int), len(nodes) - 2)
    share = place - left
    total = np.bincount(left, effort * (1 - share), len(nodes)) + np.bincount(left + 1, effort * share, len(nodes))
    weight = np.bincount(left, 1 - share, len(nodes)) + np.bincount(left + 1, share, len(nodes))
    return total / np.maximum(weight, 1e-12)


def respond(machine: Machine, base: Fit, probe: int, hats: int) -> Response:
    """Simulate `hats` hats of effort in each fit recording at the machine's probe of that number."""
    objective = Objective(machine, machine.case.fit, base.noise)
    recordings = objective.recordings
    nodes = [np.linspace(r.time[0], r.time[-1], hats) for r in recordings]
    norm = [np.concatenate([base.level[c] * np.ones(len(r.time)) for c in base.noise]) for r in recordings]
    still = [_residual(objective, base, i, {}) for i in range(len(recordings))]

    def one(task: tuple[int, int, float]) -> np.ndarray:
        i, j, amount = task
        hat = np.zeros(hats)
        hat[j] = amount
        moved = _residual(objective, base, i, {probe_name(probe): RecordedInput(nodes[i], hat)})
        return np.zeros_like(still[i]) if moved is None else (moved - still[i]) / amount

    size = float(np.linalg.norm(still[0] / norm[0]))
    amount = 1e-4
    for _ in range(4):
        answer = amount * float(np.linalg.norm(one((0, hats // 2, amount)) / norm[0]))
        if LINEAR[0] * size < answer < LINEAR[1] * size:
            break
        amount *= min(max(0.03 * size / answer, 1e-4), 1e4) if answer > 0 else 1e4
    blocks = [np.empty((len(s), hats)) for s in still]

    def fill(task: tuple[int, int]) -> None:
        i, j = task
        blocks[i][:, j] = one((i, j, amount))

    side_by_side(fill, [(i, j) for i in range(len(recordings)) for j in range(hats)])
    return Response(nodes, blocks)


def linear(machine: Machine, base: Fit, probe: int, hats: int) -> Response | None:
    """The response to `hats` hats of effort, from the linear equations; None where these do not say what a simulation
    says, or cannot be had."""
    name, recordings = probe_name(probe), machine.case.fit
    try:
        equations = Linear(machine, [name], [])
        along = [equations.along(base.point, r) for r in recordings]
    except (NotNumeric, SimulationError, np.linalg.LinAlgError):
        return None
    objective = Objective(machine, recordings, base.noise)
    order = [list(machine.columns).index(c) for c in objective.columns]
    nodes, blocks = [], []
    for recording, piece, samples in zip(recordings, along, objective.samples, strict=True):
        peaks = np.linspace(recording.time[0], recording.time[-1], min(hats, len(recording.time)))
        tents = np.array([np.interp(recording.time, peaks, row) for row in np.eye(len(peaks))]).T
        answer = piece.response(np.zeros(len(peaks), int), tents)[:, order, :]
        weights = np.stack([samples[c] / base.noise[c].std for c in objective.columns], axis=1)
        nodes.append(peaks)
        blocks.append(np.concatenate(list(np.moveaxis(-answer * weights[:, :, None], 1, 0))))
    found = Response(nodes, blocks)
    return found if _agrees(found, objective, base, name) else None


def _agrees(found: Response, objective: Objective, base: Fit, name: str) -> bool:
    """Whether a simulation with a wide hat of effort, small enough, answers as the linear response does."""
    nodes, block = found.nodes[0], found.blocks[0]
    course = np.interp(np.arange(len(nodes)), [0, len(nodes) / 4, len(nodes) / 2], [0.0, 1.0, 0.0])
    said, still = block @ course, _residual(objective, base, 0, {})
    size = float(np.linalg.norm(said))
    if still is None or not 0 < size < np.inf:
        return False
    amount = np.sqrt(LINEAR[0] * LINEAR[1]) * float(np.linalg.norm(still)) / size
    moved = _residual(objective, base, 0, {name: RecordedInput(nodes, amount * course)})
    missed = np.inf if moved is None else float(np.linalg.norm((moved - still) / amount - said))
    return missed < LINEAR[1] ** 2 * size  # what is no longer proportional of an answer that is just small enough


def _residual(objective: Objective, base: Fit, piece: int, efforts: dict[str, RecordedInput]) -> np.ndarray | None:
    recording = objective.recordings[piece]
    simulated = objective.machine.simulate(base.point, recording, efforts)
    if simulated is None:
        return None
    parts = [
        where_measured(recording.columns[c], simulated[c]) * objective.samples[piece][c] / base.noise[c].std
        for c in objective.columns
    ]
    return np.concatenate(parts)
