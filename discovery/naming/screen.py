"""Screening: what each hypothesis could explain, to first order, before any of them is fitted.

The residual r of the fitted model and its sensitivities J to the parameters are known. A hypothesis adds columns D: the
response of the outputs to a small amount of the effect. What it could explain is the drop of the cost
min |r + J x + D y|^2 + belief(x) over x and y against y = 0 (a score test). One or two simulations a hypothesis.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
import math

import numpy as np

from lacuna.discovery.case.cases import Recording
from lacuna.discovery.catalogue.attachment import Attachment
from lacuna.discovery.catalogue.catalogue import Effect, EffectParameter
from lacuna.discovery.fit.evidence import outside_belief
from lacuna.discovery.fit.fit import Fit, Objective
from lacuna.discovery.fit.machine import Machine
from lacuna.discovery.fit.solver.free import Free, pulls
from lacuna.discovery.fit.solver.least_squares import bounded_linear
from lacuna.discovery.naming.shapes import limits_of, shape_starts

RESPONSE = 0.1  # of the residual: size of the response from which a column is taken
PROBES = 5  # runs at most, in which a fair size of a response is sought: each corrects it by up to 10 000
TELLING = 0.5  # share of the misfit that screened recordings hold
ABSURD = 1e30  # misfit in units of its level, from which a simulation has run away


@dataclass
class Candidate:
    """A hypothesis ready to be fitted: its machine (None: it was screened in one that others share), the effect's free
    parameters and one place where they start."""

    attachment: Attachment
    machine: Machine | None
    free: list[Free]
    fixed: dict[str, float] = field(default_factory=dict)
    start: dict[str, float] = field(default_factory=dict)
    shift: dict[str, float] = field(default_factory=dict)  # of the base's parameters: where they would go with it
    predicted: float = 0.0  # share of the cost that it is expected to explain
    pick: float = 0.0  # nats that say which it is among all that it was picked from
    fit: Fit | None = None


class Screen:
    """The linearised base fit against which hypotheses are measured; `coarsely`, where they only need to be sorted, and
    while nothing switches: what an event comes too late or too early for is no error of the size of the tolerance."""

    def __init__(self, base: Fit, recordings: Sequence[Recording] | None = None, coarsely: bool = False) -> None:
        self.base = base
        self.noise = base.noise
        self.recordings = list(base.machine.case.fit if recordings is None else recordings)
        self.coarsely = coarsely and not any(base.machine.events_per_second(base.point, r) for r in self.recordings)
        objective = Objective(base.machine, self.recordings, base.noise, self.coarsely)
        self.weights = objective.weights(base.level)
        self.residual = objective.weighted(base.point, self.weights)
        self.norm = float(np.linalg.norm(self.residual))
        estimate = base.estimate
        rows = np.diag([f.scale / f.sigma if f.sigma else 0.0 for f in estimate.free])
        names = {r.name for r in self.recordings}
        blocks = [b for name, b in zip(base.residuals, estimate.jacobian, strict=False) if name in names]
        self.jacobian = np.vstack([*blocks, rows]) if blocks else np.zeros((len(self.residual), 0))
        self.load = np.concatenate([self.residual, pulls(estimate.free, estimate.values)]) if blocks else self.residual
        self.orthogonal, self.triangle = np.linalg.qr(self.jacobian)
        self.cost = float(np.sum(self._project(self.load) ** 2))

    def _project(self, vector: np.ndarray) -> np.ndarray:
        return vector - self.orthogonal @ (self.orthogonal.T @ vector)

    def outputs(self, machine: Machine, values: Mapping[str, float]) -> np.ndarray | None:
        """Weighted residual of a machine at a point, in the units of the base's; None where it runs away."""
        found = Objective(machine, self.recordings, self.noise, self.coarsely).weighted(values, self.weights)
        return None if found is None or np.max(np.abs(found)) > ABSURD else found

    def explained(
        self, columns: list[np.ndarray], offset: np.ndarray | None = None,
        bounds: list[tuple[float, float]] | None = None,
    ) -> tuple[float, np.ndarray]:  # fmt: skip
        """(share of the cost explained, coefficients of the columns).

        `offset` is the residual where the columns start, instead of the base's own.

        `bounds` are the least and the largest value of each coefficient: an amount of friction is not negative.
        """
        target = self._project(self._load(offset))
        full = self._padded(columns)
        stack = np.column_stack([self._project(c) for c in full.T]) if columns else full
        alive = np.linalg.norm(stack, axis=0) > 1e-3 * np.maximum(np.linalg.norm(full, axis=0), 1e-300)
        solution = np.zeros(len(columns))
        if alive.any():
            solution[alive] = bounded_linear(stack[:, alive], -target, np.array(bounds)[alive] if bounds else None)
        left = target + stack @ solution
        return 1.0 - float(left @ left) / self.cost, solution

    def shifted(
        self, columns: list[np.ndarray], coefficients: np.ndarray, offset: np.ndarray | None = None
    ) -> dict[str, float]:
        """Where the base's parameters do best, to first order, with these amounts of the columns (beliefs included)."""
        if not self.orthogonal.shape[1]:
            return {}
        load = self._load(offset) + self._padded(columns) @ coefficients
        steps = -np.linalg.lstsq(self.triangle, self.orthogonal.T @ load, rcond=1e-8)[0]
        free = self.base.estimate.free
        return {f.name: f.clip(self.base.point[f.name] + f.scale * v) for f, v in zip(free, steps, strict=True)}

    def _load(self, offset: np.ndarray | None) -> np.ndarray:
        return self.load if offset is None else np.concatenate([offset, self.load[len(self.residual) :]])

    def _padded(self, columns: list[np.ndarray]) -> np.ndarray:
        """Columns (rows, n) of the residual, with nothing in the rows of the beliefs."""
        full = np.zeros((len(self.load), len(columns)))
        for k, column in enumerate(columns):
            full[: len(column), k] = column
        return full


def telling_recordings(base: Fit) -> list[Recording]:
    """The fewest recordings that hold most of the misfit: a first look at a hypothesis needs no others."""
    misfit = dict.fromkeys(base.residuals, 0.0)
    for name, residuals in base.residuals.items():
        for column, noise in base.noise.items():
            error = base.weights[name][column] * np.nan_to_num(residuals[column]) / (base.level[column] * noise.std)
            misfit[name] += float(error @ error)
    chosen: set[str] = set()
    held = 0.0
    for name in sorted(misfit, key=lambda n: -misfit[n]):
        if held < TELLING * sum(misfit.values()):
            chosen.add(name)
            held += misfit[name]
    return [r for r in base.machine.case.fit if r.name in chosen]


def prepare(screen: Screen, attachment: Attachment, machine: Machine) -> list[Candidate]:
    """The candidate from each start that promises something, best first; none where a parameter could do the same.

    Starts differ in the parameters that have no neutral value: the place of a stop, a Stribeck speed, a time constant.
    Raises SimulationError where the amended model does not run with these recordings.
    """
    asked, attachment = attachment, _in_place(screen, attachment)
    effect = attachment.effect
    point = dict(screen.base.point)
    bound = _bound_parameters(machine, attachment)
    names = [
        p.name for p in effect.parameters if p.name not in (*effect.fixed, *effect.variants, effect.interval, *bound)
    ]
    if not names:
        return []
    shapes = shape_starts(attachment, machine, names, point)
    amounts: dict[str, float] = {}
    limits = limits_of(shapes)
    found = [_linearised(screen, attachment, machine, names, point, shape, limits, amounts) for shape in shapes]
    if not any(n in effect.neutral for n in names):
        found += [_from_believed(screen, attachment, machine, names, shape, limits) for shape in shapes]
    elif outside_belief(screen.base) and any(n in effect.starts for n in effect.neutral):
        found += _of_size(screen, attachment, machine, names)
    found = [replace(c, attachment=asked) for c in found if c is not None]
    return sorted(found, key=lambda c: -c.predicted)


def _of_size(screen: Screen, attachment: Attachment, machine: Machine, names: list[str]) -> list[Candidate | None]:
    """The candidates with amounts that have starts of their own at these, and the believed parameters: where others
    stand for the effect (a soft shaft for play), a little of it beside them explains nothing."""
    effect = attachment.effect
    sized = replace(effect, neutral={n: v for n, v in effect.neutral.items() if n not in effect.starts})
    attachment = replace(attachment, effect=sized)
    shapes = shape_starts(attachment, machine, names, dict(screen.base.point))
    return [_from_believed(screen, attachment, machine, names, shape, limits_of(shapes)) for shape in shapes]


def _in_place(screen: Screen, attachment: Attachment) -> Attachment:
    """The attachment with an effect whose levels are neutral at that of the dry friction in whose place it is put."""
    effect, base = attachment.effect, screen.base
    shaft = attachment.shaft if effect.friction and effect.levels else None
    part = base.machine.amendment.structure.friction_of(shaft) if shaft else None
    level = base.machine.constants(base.point).get(f"{part.name}.tau_c") if part else None
    if level is None:
        return attachment
    return replace(attachment, effect=replace(effect, neutral=effect.neutral | dict.fromkeys(effect.levels, level)))


def _bound_parameters(machine: Machine, attachment: Attachment) -> set[str]:
    """Parameters of the effect that the amended model ties to parameters of the believed one."""
    settable = machine.model.parameters
    return {p.name for p in attachment.effect.parameters if attachment.full_name(p.name) not in settable}


def _from_believed(
    screen: Screen, attachment: Attachment, machine: Machine, names: list[str], shape: dict[str, float],
    limits: dict[str, tuple[float, float]],
) -> Candidate | None:  # fmt: skip
    """The candidate for one start of the shape and the believed parameters: refitted without it, they stand for it, and
    may keep the motion away from where it acts."""
    believed = screen.base.believed()
    found = _linearised(screen, attachment, machine, names, screen.base.point | believed, shape, limits, {})
    return found and replace(found, start=believed | found.start, shift={})


def _linearised(
    screen: Screen, attachment: Attachment, machine: Machine, names: list[str], point: dict[str, float],
    shape: dict[str, float], limits: dict[str, tuple[float, float]], known: dict[str, float],
) -> Candidate | None:  # fmt: skip
    """The candidate for one start of the shape; `known` remembers fair amounts between shapes."""
    effect = attachment.effect
    neutral = {attachment.full_name(n): effect.neutral[n] for n in names if n in effect.neutral}
    origin = point | shape | neutral
    polar = effect.polar if effect.polar and effect.polar[0] in names else ()
    columns, amounts, moved = [], [], []
    base = None if neutral else screen.outputs(machine, origin)
    if not neutral and base is None:
        return None
    reference = screen.residual if neutral else base
    for name in [n for n in names if n in effect.neutral]:
        phases = (0.0, math.pi / 2) if polar and name == polar[0] else (None,)
        for phase in phases:
            here = origin | ({attachment.full_name(polar[1]): phase} if phase is not None else {})
            parameter = effect.parameter(name)
            column, amount = _response(
                screen, machine, here, attachment.full_name(name), parameter, reference, known.get(name)
            )
            if column is None:
                return None
            known[name] = amount
            columns.append(column)
            amounts.append(amount)
            moved.append(name)
    bounds = [(-np.inf, np.inf) if n in polar else _reach(effect, n) for n in moved]
    columns = [c / a for c, a in zip(columns, amounts, strict=True)]
    share, solution = screen.explained(columns, base, bounds)
    shift = screen.shifted(columns, solution, base)
    if columns and not np.any(solution):
        return None
    start = dict(shape)
    scales = dict(zip(moved, amounts, strict=True))
    start |= {
        attachment.full_name(n): effect.neutral[n] + float(v)
        for n, v in zip(moved, solution, strict=True) if n not in polar
    }  # fmt: skip
    if polar:
        parts = [v for n, v in zip(moved, solution, strict=True) if n in polar]
        start[attachment.full_name(polar[0])] = float(np.hypot(*parts))
        start[attachment.full_name(polar[1])] = float(np.arctan2(parts[1], parts[0]))
        scales |= {polar[0]: max(a for n, a in zip(moved, amounts, strict=True) if n in polar), polar[1]: 1.0}
    fixed = {n: v for n, v in shape.items() if n.rsplit(".", 1)[-1] in (*effect.whole, *effect.fixed)}
    free = [_free(attachment, effect, n, start, scales, limits) for n in names if attachment.full_name(n) not in fixed]
    start = {k: v for k, v in start.items() if k not in fixed}
    return Candidate(attachment, machine, free, fixed, start, shift, share)


def _reach(effect: Effect, name: str) -> tuple[float, float]:
    """How far a parameter can go from its neutral value, down and up."""
    parameter, neutral = effect.parameter(name), effect.neutral[name]
    return min(parameter.lower - neutral, -1e-300), max(parameter.upper - neutral, 1e-300)


def _response(
    screen: Screen, machine: Machine, origin: dict[str, float], name: str, parameter: EffectParameter,
    reference: np.ndarray, known: float | None,
) -> tuple[np.ndarray | None, float]:  # fmt: skip
    """(change of the weighted residual, amount of the parameter that makes it), of a fair size."""
    amount, target = abs(known or 1e-4), RESPONSE * screen.norm
    best: tuple[np.ndarray | None, float] = (None, amount)
    value = origin.get(name, parameter.default)
    for _ in range(PROBES):
        step = amount if value + amount <= parameter.upper else -amount
        there = screen.outputs(machine, origin | {name: value + step})
        if there is None:
            amount *= 0.03
            continue
        best = (there - reference, step)
        size = float(np.linalg.norm(best[0]))
        if target / 30 < size < target * 4 or amount > 1e9:
            break
        amount *= min(max(target / size, 1e-4), 1e4) if size > 0 else 1e4
    return best


def _free(
    attachment: Attachment, effect: Effect, name: str, start: dict[str, float], scales: dict[str, float],
    limits: dict[str, tuple[float, float]],
) -> Free:  # fmt: skip
    full, parameter = attachment.full_name(name), effect.parameter(name)
    value = start.get(full, parameter.default)
    scale = abs(scales.get(name, 0.0)) or 0.3 * abs(value) or 1.0
    lower, upper = max(parameter.lower, limits.get(full, (-math.inf, 0.0))[0]), parameter.upper
    if full in limits:
        upper = min(upper, limits[full][1])
    free = Free(full, value, scale, lower, upper, None, step=2e-2)
    return replace(free, start=free.clip(value))
