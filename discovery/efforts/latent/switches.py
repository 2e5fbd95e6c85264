"""When a command that is held between samples has switched: at some time since the sample that still has the old value.

A logger that is not driven by the clock of what it records sees every switch late, by up to an interval. A switch that
came the share s of an interval earlier acts on the outputs, to first order, as its step over that share of the interval
before: the shares are told by bounded least squares beside the parameters, which have their beliefs.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.linalg import block_diag

from lacuna.discovery.case.cases import Case, Recording
from lacuna.discovery.case.values import is_parameter
from lacuna.discovery.efforts.linear import Linear
from lacuna.discovery.fit.evidence import LEFT
from lacuna.discovery.fit.fit import Fit
from lacuna.discovery.fit.solver.least_squares import bounded_linear


@dataclass(frozen=True)
class Switch:
    """A step of an input (its number and column), first seen at sample `at`, by now `share` of an interval earlier."""

    number: int
    column: str
    at: int
    step: float
    share: float


def switches(case: Case, recording: Recording) -> list[Switch]:
    """Those of the held inputs of a recording: none of an input that is not seen at every sample, nor of one that has
    more of them than the root of the samples, and is sampled itself."""
    found: list[Switch] = []
    for number, signal in enumerate(case.inputs):
        steps, time = np.diff(recording.columns[signal.column]), recording.time
        at, since = np.flatnonzero(steps != 0) + 1, recording.drive(signal.column)[0]
        if signal.interpolation != "hold" or not np.isfinite(steps).all() or len(at) ** 2 > len(steps):
            continue
        if len(since) != len(time):  # known from more samples than the outputs are compared at
            continue
        share = (time[at] - since[at]) / (time[at] - time[at - 1])
        found += [Switch(number, signal.column, *s) for s in zip(at, steps[at - 1], share, strict=True)]
    return found


def placed(base: Fit) -> Case | None:
    """The case of a fit with its switches where the outputs say they were; None where there are none, or where these
    leave more than noise. Raises NotNumeric, SimulationError where the model cannot be linearised."""
    case = base.machine.case
    if base.machine.amendment.trackers or not any(switches(case, r) for r in case.fit):
        return None
    names = [f.name for f in base.estimate.free if is_parameter(f.name)]
    linear = Linear(base.machine, [s.variable for s in case.inputs], names)
    together, left = _placed(linear, base, names, case.fit)
    if left > LEFT:
        return None
    return replace(case, fit=together, validate=[_placed(linear, base, [], [r])[0][0] for r in case.validate])


def _placed(
    linear: Linear, base: Fit, names: list[str], recordings: Sequence[Recording]
) -> tuple[list[Recording], float]:
    """Recordings with their switches placed, beside parameters that all of them have; and the largest RMS of what that
    leaves of an output, in units of its noise."""
    case = base.machine.case
    found = [switches(case, r) for r in recordings]
    if not any(found):
        return list(recordings), np.inf
    free = {f.name: f for f in base.estimate.free}
    believed = [(free[n].centre - base.point[n]) / (free[n].sigma or free[n].scale) for n in names]
    parts = [_answers(linear, base, names, r, own) for r, own in zip(recordings, found, strict=True)]
    steady = np.concatenate([*(answers[:, : len(names)] for _, answers in parts), np.eye(len(names))])
    apart = block_diag(*(answers[:, len(names) :] for _, answers in parts), np.zeros((len(names), 0)))
    matrix, target = np.hstack([steady, apart]), np.concatenate([*(left for left, _ in parts), believed])
    bounds = [(-np.inf, np.inf)] * len(names) + [(-s.share, 1.0 - s.share) for own in found for s in own]
    solved = bounded_linear(matrix, target, np.array(bounds))
    shares = iter(solved[len(names) :])
    moved = [_earlier(r, [(s, s.share + float(next(shares))) for s in own])
             for r, own in zip(recordings, found, strict=True)]  # fmt: skip
    level = np.array([base.level[c] for c in base.machine.columns])
    rest = (target - matrix @ solved)[: len(target) - len(names)].reshape(-1, len(level)) * level
    return moved, float(np.sqrt(np.mean(rest**2, axis=0)).max())


def _answers(
    linear: Linear, base: Fit, names: list[str], recording: Recording, own: list[Switch]
) -> tuple[np.ndarray, np.ndarray]:
    """(residual (n y,), answers (n y, parameters and switches)) in units of what each output leaves, zero where it has
    no sample; parameters in units of belief."""
    along, columns = linear.along(base.point, recording), base.machine.columns
    scale = np.array([base.noise[c].std * base.level[c] for c in columns])
    left = np.stack([recording.columns[c] - linear.of(v, along) for c, v in columns.items()], axis=1)
    samples, first = len(along.time), len(linear.inputs)
    sigma = {f.name: f.sigma or f.scale for f in base.estimate.free}
    steady = along.response(first + np.arange(len(names)), np.ones((samples, len(names))))
    steady = steady * np.array([sigma[n] for n in names])
    pulses = np.zeros((samples, len(own)))
    for k, switch in enumerate(own):
        pulses[switch.at - 1, k] = switch.step
    answers = along.response(np.array([s.number for s in own], dtype=int), pulses, hold=True)
    for k, switch in enumerate(own):  # at that sample itself the input is still the old one
        answers[switch.at - 1, :, k] -= along.feed[switch.at - 1, :, switch.number] * switch.step
    both = np.concatenate([steady, answers], axis=2) / scale[:, None]
    seen = np.isfinite(left)
    return np.where(seen, left / scale, 0.0).ravel(), np.where(seen[:, :, None], both, 0.0).reshape(left.size, -1)


def _earlier(recording: Recording, shares: list[tuple[Switch, float]]) -> Recording:
    """The recording with each switch that share of its interval before the sample that first shows it."""
    since = {switch.column: recording.drive(switch.column)[0].copy() for switch, _ in shares}
    for switch, share in shares:
        first, last = recording.time[switch.at - 1], recording.time[switch.at]
        since[switch.column][switch.at] = max(last - share * (last - first), np.nextafter(first, np.inf))
    return replace(recording, drives=recording.drives | {c: (t, recording.columns[c]) for c, t in since.items()})
