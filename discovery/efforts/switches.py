"""When a command that is held between samples has switched: at some time since the sample that still has the old value.

A logger that is not driven by the clock of what it records sees every switch late, by up to an interval. A switch that
came the share s of an interval earlier acts on the outputs, to first order, as its step over that share of the interval
before. The shares are told by bounded least squares beside the parameters, which have their beliefs, and beside what
else is missing, an effort of any course: what it leaves is white (Whitener).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from lacuna.discovery.case.cases import Case, Recording
from lacuna.discovery.efforts.instruments import locator_of
from lacuna.discovery.efforts.latent.chains import Latent, Piece
from lacuna.discovery.efforts.latent.linear import Linear
from lacuna.discovery.efforts.latent.numeric import NotNumeric
from lacuna.discovery.efforts.latent.smoother import Whitener
from lacuna.discovery.efforts.located import Locator
from lacuna.discovery.fit.fit import Fit
from lacuna.discovery.fit.solver.least_squares import bounded_linear
from lacuna.runtime import SimulationError


@dataclass(frozen=True)
class Switch:
    """A step of an input (its number and column), first seen at sample `at`."""

    number: int
    column: str
    at: int
    step: float


def switches(case: Case, recording: Recording) -> list[Switch]:
    """Those of the held inputs of a recording: none of an input that is not seen at every sample, of one that has more
    of them than the root of the samples, and is sampled itself, or of one that is known from more samples."""
    found: list[Switch] = []
    for number, signal in enumerate(case.inputs):
        steps = np.diff(recording.columns[signal.column])
        at = np.flatnonzero(steps != 0) + 1
        sampled = not np.isfinite(steps).all() or len(at) ** 2 > len(steps)
        if signal.interpolation != "hold" or sampled or signal.column in recording.drives:
            continue
        found += [Switch(number, signal.column, *s) for s in zip(at, steps[at - 1], strict=True)]
    return found


def switched(base: Fit) -> Case | None:
    """The case of a fit with its switches where the outputs say they were, beside the effort that explains most; None
    where they say nothing of them, where that leaves more than noise, whose memory switches would stand for, or where
    the model cannot be linearised."""
    machine = base.machine
    locator = locator_of(machine.case, machine.amendment, base)
    try:
        if locator is None or not locator.white(best := locator.ranked()[0]):
            return None
        return placed(locator, locator.latent(best))
    except (NotNumeric, SimulationError, np.linalg.LinAlgError):
        return None


def placed(locator: Locator, beside: Latent) -> Case | None:
    """The case of a locator with its switches where the outputs say they were, `beside` an effort of any course; None
    where they explain no more than so many numbers have to."""
    case, found = locator.case, [switches(locator.case, r) for r in locator.case.fit]
    count = sum(map(len, found))
    linear = Linear(locator.base.machine, [s.variable for s in case.inputs], [])
    rows = _rows(locator, linear, beside, list(zip(case.fit, locator.pieces, found, strict=True)))
    target, steady, apart = rows[:, 0], rows[:, 1 : rows.shape[1] - count], rows[:, rows.shape[1] - count :]
    believed = len(steady.T)
    steady = np.vstack([steady, np.eye(believed)])
    target, apart = np.append(target, np.zeros(believed)), np.vstack([apart, np.zeros((believed, count))])
    without = target - steady @ np.linalg.lstsq(steady, target, rcond=None)[0]
    matrix = np.hstack([steady, apart])
    solved = bounded_linear(matrix, target, np.array([(-np.inf, np.inf)] * believed + [(0.0, 1.0)] * count))
    left = target - matrix @ solved
    if 0.5 * (without @ without - left @ left) < 0.5 * count * np.log(len(rows)):
        return None
    shares = iter(solved[believed:])
    fit = [_earlier(r, own, [next(shares) for _ in own]) for r, own in zip(case.fit, found, strict=True)]
    alone = partial(_alone, locator, linear, beside, solved[:believed])
    return replace(case, fit=fit, validate=list(map(alone, case.validate)))


def _alone(
    locator: Locator, linear: Linear, beside: Latent, parameters: np.ndarray, recording: Recording
) -> Recording:  # fmt: skip
    """A recording that only judges, its switches placed with the parameters as they are."""
    own = switches(locator.case, recording)
    if not own:
        return recording
    rows = _rows(locator, linear, beside, [(recording, locator.piece(locator.point, recording), own)])
    target = rows[:, 0] - rows[:, 1 : 1 + len(parameters)] @ parameters
    return _earlier(recording, own, bounded_linear(rows[:, -len(own) :], target, np.array([(0.0, 1.0)] * len(own))))


def _rows(
    locator: Locator, linear: Linear, beside: Latent, recordings: Sequence[tuple[Recording, Piece, list[Switch]]]
) -> np.ndarray:  # fmt: skip
    """(rows, 1 + parameters + switches) residuals and answers, whitened; parameters in units of belief."""
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
    """The recording with each switch that share of the interval before the sample that first shows it."""
    since = {switch.column: recording.time.copy() for switch in own}
    for switch, share in zip(own, shares, strict=True):
        first, last = recording.time[switch.at - 1], recording.time[switch.at]
        since[switch.column][switch.at] = max(last - share * (last - first), np.nextafter(first, np.inf))
    return replace(recording, drives=recording.drives | {c: (t, recording.columns[c]) for c, t in since.items()})
