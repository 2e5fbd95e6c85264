"""When a command that is held between samples has switched: at some time since the sample that still has the old value.

A logger that is not driven by the clock of what it records sees every switch late, by up to an interval. A switch that
came the share s of an interval earlier acts on the outputs, to first order, as its step over that share of the interval
before. The shares are told by bounded least squares beside the parameters, which have their beliefs, and beside what
else is missing, an effort of any course: what it leaves is white (Whitener).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from lacuna.discovery.case.cases import Case, Recording
from lacuna.discovery.case.values import is_parameter
from lacuna.discovery.efforts.latent.chains import Latent, Piece
from lacuna.discovery.efforts.latent.linear import Linear
from lacuna.discovery.efforts.latent.numeric import NotNumeric
from lacuna.discovery.efforts.latent.smoother import Whitener
from lacuna.discovery.efforts.located import Locator
from lacuna.discovery.efforts.opened import opened
from lacuna.discovery.fit.fit import Fit
from lacuna.discovery.fit.solver.least_squares import bounded_linear
from lacuna.runtime import SimulationError


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


def switched(base: Fit) -> Case | None:
    """The case of a fit with its switches where the outputs say they were, beside the effort that explains most; None
    where they say nothing of them, or where the model cannot be linearised."""
    machine = base.machine
    if not any(switches(machine.case, r) for r in machine.case.fit):
        return None
    names = [f.name for f in base.estimate.free if is_parameter(f.name)]
    try:
        door = opened(machine.case, machine.amendment, machine.case.library(), names, machine)
        locator = Locator(machine.case, door, base)
        return placed(locator, locator.latent(locator.ranked()[0]))
    except (NotNumeric, SimulationError, np.linalg.LinAlgError):
        return None


def placed(locator: Locator, beside: Latent) -> Case | None:
    """The case of a locator with its switches where the outputs say they were, `beside` an effort of any course; None
    where there are none, or where they explain no more than so many numbers have to."""
    case, found = locator.case, [switches(locator.case, r) for r in locator.case.fit]
    count = sum(map(len, found))
    if not count:
        return None
    rows = _rows(locator, beside, list(zip(case.fit, locator.pieces, found, strict=True)))
    target, steady, apart = rows[:, 0], rows[:, 1 : rows.shape[1] - count], rows[:, rows.shape[1] - count :]
    believed = len(steady.T)
    steady = np.vstack([steady, np.eye(believed)])
    target, apart = np.append(target, np.zeros(believed)), np.vstack([apart, np.zeros((believed, count))])
    without = target - steady @ np.linalg.lstsq(steady, target, rcond=None)[0]
    matrix = np.hstack([steady, apart])
    solved = bounded_linear(matrix, target, np.array([(-np.inf, np.inf)] * believed + _bounds(found)))
    left = target - matrix @ solved
    if 0.5 * (without @ without - left @ left) < 0.5 * count * np.log(len(rows)):
        return None
    shares = iter(solved[believed:])
    fit = [_earlier(r, own, [next(shares) for _ in own]) for r, own in zip(case.fit, found, strict=True)]
    return replace(case, fit=fit, validate=[_alone(locator, beside, r, solved[:believed]) for r in case.validate])


def _alone(locator: Locator, beside: Latent, recording: Recording, parameters: np.ndarray) -> Recording:
    """A recording that only judges, its switches placed with the parameters as they are."""
    own = switches(locator.case, recording)
    if not own:
        return recording
    rows = _rows(locator, beside, [(recording, locator.piece(locator.point, recording), own)])
    target = rows[:, 0] - rows[:, 1 : 1 + len(parameters)] @ parameters
    return _earlier(recording, own, bounded_linear(rows[:, -len(own) :], target, np.array(_bounds([own]))))


def _bounds(found: Sequence[list[Switch]]) -> list[tuple[float, float]]:
    return [(-s.share, 1.0 - s.share) for own in found for s in own]


def _rows(
    locator: Locator, beside: Latent, recordings: Sequence[tuple[Recording, Piece, list[Switch]]]
) -> np.ndarray:  # fmt: skip
    """(rows, 1 + parameters + switches) residuals and answers, whitened; parameters in units of belief."""
    linear = Linear(locator.base.machine, [s.variable for s in locator.case.inputs], [])
    answers = [_pulses(linear, locator.point, r, own) for r, _, own in recordings]
    count, before, columns = sum(len(own) for *_, own in recordings), 0, []
    for (_, piece, own), answer in zip(recordings, answers, strict=True):
        apart = np.zeros((*answer.shape[:2], count))
        apart[:, :, before : before + len(own)] = answer
        columns.append(np.concatenate([piece.data[:, :, :1], -piece.data[:, :, 1:], apart], axis=2))
        before += len(own)
    return Whitener([piece for _, piece, _ in recordings], beside)(columns)


def _pulses(linear: Linear, point: dict[str, float], recording: Recording, own: list[Switch]) -> np.ndarray:
    """(n, y, switches) outputs to each step over the whole interval before the sample that first shows it."""
    along = linear.along(point, recording)
    courses = np.zeros((len(along.time), len(own)))
    for k, switch in enumerate(own):
        courses[switch.at - 1, k] = switch.step
    result = along.response(np.array([s.number for s in own], dtype=int), courses, hold=True)
    for k, switch in enumerate(own):  # at that sample itself the input is still the old one
        result[switch.at - 1, :, k] -= along.feed[switch.at - 1, :, switch.number] * switch.step
    return result


def _earlier(recording: Recording, own: list[Switch], shares: Sequence[float]) -> Recording:
    """The recording with each switch by a share of its interval earlier than it was."""
    since = {switch.column: recording.drive(switch.column)[0].copy() for switch in own}
    for switch, more in zip(own, shares, strict=True):
        first, last = recording.time[switch.at - 1], recording.time[switch.at]
        there = last - (switch.share + float(more)) * (last - first)
        since[switch.column][switch.at] = max(there, np.nextafter(first, np.inf))
    return replace(recording, drives=recording.drives | {c: (t, recording.columns[c]) for c, t in since.items()})
