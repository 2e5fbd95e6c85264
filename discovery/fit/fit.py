"""Fitting a machine's parameters to recordings by the error of its simulated outputs.

Signals are weighted by noise, but never more than the model deserves: while a signal's residual is above its noise,
that residual is its weight (maximum likelihood with unknown variances, noise as the lower bound). So a fit is led from
coarse to fine without a schedule, and a model that lacks physics is not torn to pieces by its most precise sensor.
Where events make the sum of squares rough, trackers hold recorded shafts near their motion at first.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from lacuna.discovery.case.cases import Case, Recording
from lacuna.discovery.case.noise import Noise, correlation_time, sample_weights
from lacuna.discovery.case.values import own_name
from lacuna.discovery.fit.kept.store import remembered
from lacuna.discovery.fit.machine import Machine
from lacuna.discovery.fit.objective import STAGES, Objective, alike, anneal
from lacuna.discovery.fit.solver.free import Free, clipped
from lacuna.discovery.fit.solver.least_squares import Estimate, Problem
from lacuna.discovery.fit.solver.so_far import noted
from lacuna.discovery.fit.starts import as_known_to, own_beliefs, uncertain, uncertain_starts, with_starts
from lacuna.discovery.fit.tracking import noise_bandwidth
from lacuna.runtime import Variable

FALLING = (1.0, 1 / 8, 1 / 16, 1 / 50, 0.0)  # bandwidths of trackers, of the largest that noise allows


@dataclass
class Fit:
    """A fitted machine. `level` is each signal's residual RMS in units of its noise, at least one."""

    machine: Machine
    estimate: Estimate
    level: dict[str, float]
    residuals: dict[
        str, dict[str, np.ndarray]
    ]  # recording -> column -> (n,) measured minus simulated, SI; NaN: missing
    weights: dict[str, dict[str, np.ndarray]]  # of the samples, in the same layout
    noise: dict[str, Noise]
    simulations: int
    fixed: dict[str, float] = field(default_factory=dict)
    only_instruments: bool | None = None  # whether what is left is theirs alone; None while nobody has asked
    zeroed: Fit | None = field(default=None, repr=False)  # beside errors of the sensors' zeros; None likewise

    @property
    def point(self) -> dict[str, float]:
        return self.fixed | self.estimate.point

    @property
    def settled(self) -> bool:
        """Whether to carry it on leads nowhere: it has converged, with the levels that its residuals have."""
        there = {c: max(1.0, float(np.sqrt(self._mean_square(c)))) for c in self.noise}
        return self.estimate.converged and alike(self.level, there)

    def believed(self) -> dict[str, float]:
        """What is believed of the parameters, by name."""
        return {f.name: f.centre for f in self.estimate.free if f.sigma}

    def sensitivities(self) -> dict[str, list[np.ndarray]]:
        """Unweighted columns of the Jacobian (units of noise per scaled parameter) for each recording, by parameter."""
        if not self.estimate.jacobian:
            return {}
        levels = [
            np.concatenate([np.full(len(r[c]), self.level[c]) for c in self.noise]) for r in self.residuals.values()
        ]
        return {
            f.name: [block[:, k] * level for block, level in zip(self.estimate.jacobian, levels, strict=True)]
            for k, f in enumerate(self.estimate.free)
        }

    def counts(self) -> dict[str, float]:
        """Independent samples of each signal, were its residual white."""
        return {c: float(sum(np.sum(w[c] ** 2) for w in self.weights.values())) for c in self.noise}

    def correlation(self) -> dict[str, float]:
        """Samples that carry the information of one, for each signal, from this fit's residual."""
        result = {}
        for column in self.noise:
            rows = [(r[column], self.weights[n][column]) for n, r in self.residuals.items()]
            times = [correlation_time((r * w)[w > 0]) for r, w in rows]
            result[column] = float(np.mean(times))
        return result

    def deviance(self, correlation: Mapping[str, float] | None = None) -> float:
        """Minus twice the log likelihood (up to a constant) with unknown levels, beliefs included.

        `correlation` discounts the samples of each signal; pass that of the best fit when comparing several.
        """
        total = self.estimate.cost - self.estimate.data_cost
        for column, count in self.counts().items():
            mean_square = self._mean_square(column)
            level = max(1.0, mean_square)
            total += count / (correlation or {}).get(column, 1.0) * (np.log(level) + mean_square / level)
        return float(total)

    def _mean_square(self, column: str) -> float:
        total = sum(
            np.sum((self.weights[n][column] * np.nan_to_num(r[column])) ** 2) for n, r in self.residuals.items()
        )
        return float(total) / self.counts()[column] / self.noise[column].std ** 2

    def moved(self, name: str, move: np.ndarray) -> dict[str, np.ndarray]:
        """The residuals (n,) of a recording in SI, after a move (n times outputs,) of its weighted ones."""
        result = {}
        for k, (column, noise) in enumerate(self.noise.items()):
            own, weight = self.residuals[name][column], self.weights[name][column] / (noise.std * self.level[column])
            change = move[k * len(own) : (k + 1) * len(own)]
            result[column] = own + np.divide(change, weight, out=np.zeros_like(own), where=weight > 0)
        return result

    def inflation(self) -> float:
        """Factor on the covariance for coloured residuals, mean over signals."""
        colour = self.correlation()
        return float(np.mean([colour[c] for c in self.noise]))


def believed(case: Case, machine: Machine) -> tuple[list[Free], dict[str, float]]:
    """(free parameters, exact ones) of the believed model: what case.toml names and the model's own defaults."""
    free, fixed = [], {}
    for name, variable in machine.model.parameters.items():
        if variable.type != "Real" or not case.is_uncertain(name):
            continue
        value = case.parameters.get(name, variable.start)
        _believe(name, value, case.sigma(name, value), variable, free, fixed)
    fixed |= {n: v for n, v in case.parameters.items() if n not in fixed and n not in [f.name for f in free]}
    _believe_own(case, machine, free, fixed)
    return free + [s for recording in case.fit for s in uncertain_starts(machine, recording, {})], fixed


def _believe(name: str, value: float, sigma: float, variable: Variable, free: list[Free], fixed: dict[str, float]):
    """Add a parameter with its belief to the free ones, or to the exact ones."""
    if sigma > 0:
        free.append(uncertain(name, value, sigma, variable))
    else:
        fixed[name] = value


def _believe_own(case: Case, machine: Machine, free: list[Free], fixed: dict[str, float]) -> None:
    """Parameters with a value of their own in one recording; what only validates keeps what is believed of it."""
    fitted = {r.file for r in case.fit}
    for recording in case.own:
        for name, (value, sigma) in own_beliefs(machine, recording).items():
            known = sigma if recording in fitted else 0.0
            _believe(own_name(name, recording), value, known, machine.model.variables[name], free, fixed)


def fit(
    machine: Machine,
    recordings: Sequence[Recording],
    noise: Mapping[str, Noise],
    free: list[Free],
    fixed: Mapping[str, float],
    *,
    start: Mapping[str, float] | None = None,
    bandwidths: Sequence[float] = (0.0,),
    stages: int = STAGES,
    iterations: int = 4,
    known: Mapping[str, list[np.ndarray]] | None = None,
    renewed: bool = True,
) -> Fit | None:
    """Fit `free` to the recordings, tracking with each bandwidth in turn (the last one 0). None if it cannot run."""
    free = as_known_to(machine, free)
    objective = Objective(machine, recordings, noise)
    readers = objective.readers(f.name for f in free)
    problem = Problem(free, objective, len(objective.recordings), dict(fixed), readers)
    first = dict(start or {})
    values = clipped(free, [first.get(f.name, f.centre if f.start is None else f.start) for f in free])

    def led() -> tuple[Estimate | None, dict[str, float]]:
        return _led(objective, problem, values, bandwidths, known or {}, stages, iterations, renewed)

    found, level = remembered(
        lambda: (machine.compiled.hash, recordings, noise, free, dict(fixed), first, tuple(bandwidths), stages,
                 iterations, bool(known), renewed),
        led,
    )  # fmt: skip
    if found is None:
        return None
    return noted(_finish(machine, recordings, dict(noise), found, level, problem.simulations, dict(fixed)))


def linearised(
    machine: Machine, recordings: Sequence[Recording], noise: Mapping[str, Noise], free: list[Free],
    fixed: Mapping[str, float], point: Mapping[str, float],
) -> Fit | None:  # fmt: skip
    """The machine at a point, as a fit that does not move: its residuals and levels there."""
    return fit(machine, recordings, noise, free, fixed, start=point, stages=1, iterations=0)


def carried(found: Fit, machine: Machine, *, stages: int = STAGES, iterations: int = 4) -> Fit | None:
    """A fit carried on by a machine of the same parameters: the same one, or one whose shafts are held or let go."""
    case, estimate = machine.case, found.estimate
    return fit(
        machine, case.fit, found.noise, estimate.free, found.fixed, start=found.point, stages=stages,
        iterations=iterations,
    )  # fmt: skip


def _led(
    objective: Objective, problem: Problem, values: np.ndarray, bandwidths: Sequence[float],
    known: Mapping[str, list[np.ndarray]], stages: int, iterations: int, renewed: bool = True,
) -> tuple[Estimate | None, dict[str, float]]:  # fmt: skip
    """The fit led by trackers of falling bandwidth; None where it fails or where the last one still tracks."""
    free, fixed = problem.free, problem.fixed
    found, level, path = None, {}, []

    def annealed(bandwidth: float, start: np.ndarray) -> tuple[Estimate | None, dict[str, float]]:
        objective.track(bandwidth, fixed | {f.name: v for f, v in zip(free, start, strict=True)})
        columns = {} if objective.stiffness else {k: known[f.name] for k, f in enumerate(free) if f.name in known}
        return anneal(objective, problem, start, stages=stages, iterations=iterations, known=columns, renewed=renewed)

    for bandwidth in bandwidths:
        ahead = not bandwidth and len(path) > 1
        result, level_here = annealed(bandwidth, _extrapolated(problem, *path[-2:]) if ahead else values)
        if result is None and ahead:
            result, level_here = annealed(bandwidth, values)
        if result is not None:
            found, level, values = result, level_here, result.values
            path.append((bandwidth, values))
    return (None, {}) if objective.stiffness else (found, level)


def _extrapolated(problem: Problem, before: tuple[float, np.ndarray], last: tuple[float, np.ndarray]) -> np.ndarray:
    """Values at bandwidth 0 on the line through two tracked fits: what noise in the tracked motion spoils falls so."""
    (wide, there), (narrow, here) = before, last
    values = here + (here - there) * narrow / (wide - narrow)
    return clipped(problem.free, values)


def _finish(
    machine: Machine, recordings: Sequence[Recording], noise: dict[str, Noise], found: Estimate,
    level: dict[str, float],
    simulations: int, fixed: dict[str, float],
) -> Fit | None:  # fmt: skip
    weights = {r.name: {c: sample_weights(r.columns[c], n) for c, n in noise.items()} for r in recordings}
    values = fixed | found.point
    if any(machine.unfitted_states(values, r) for r in recordings):
        residuals = residuals_of(machine, recordings, values)
    else:  # as the fit has seen them: there is no need of another run
        parts = zip(weights, found.residuals, strict=True)
        residuals = {name: _unweighted(part, weights[name], noise, level) for name, part in parts}
    if residuals is None:
        return None
    return Fit(machine, found, {c: level.get(c, 1.0) for c in noise}, residuals, weights, noise, simulations, fixed)


def _unweighted(
    part: np.ndarray, weights: Mapping[str, np.ndarray], noise: Mapping[str, Noise], level: Mapping[str, float]
) -> dict[str, np.ndarray]:
    """Measured minus simulated (n,) of each column, SI, from a recording's part of a fit's residual; NaN: missing."""
    rows = part.reshape(-1, len(next(iter(weights.values()))))
    scales = {
        c: np.where(w > 0, w, np.nan) / (n.std * level[c])
        for (c, n), w in zip(noise.items(), weights.values(), strict=True)
    }
    return {c: row / scales[c] for c, row in zip(noise, rows, strict=True)}


def residuals_of(
    machine: Machine, recordings: Sequence[Recording], values: Mapping[str, float]
) -> dict[str, dict[str, np.ndarray]] | None:
    """Measured minus simulated of each recording and column; None where a run fails."""
    result = {}
    for recording in recordings:
        simulated = machine.simulate(with_starts(machine, recording, values), recording)
        if simulated is None:
            return None
        result[recording.name] = {
            s.column: recording.columns[s.column] - simulated[s.column] for s in machine.case.outputs
        }
    return result


def nrmse(
    case: Case, recordings: Sequence[Recording], residuals: Mapping[str, Mapping[str, np.ndarray]]
) -> dict[str, float]:
    """NRMSE of each output column, pooled over recordings, and of the case under the key "" (FORMAT.md)."""
    result = {}
    for signal in case.outputs:
        error = np.concatenate([residuals[r.name][signal.column] for r in recordings])
        measured = np.concatenate([r.columns[signal.column] for r in recordings])
        spread = float(np.nanstd(measured))
        result[signal.column] = float(np.sqrt(np.nanmean(error**2)) / spread) if spread > 0 else float("inf")
    result[""] = float(np.sqrt(np.mean([result[s.column] ** 2 for s in case.outputs])))
    return result


def falling_bandwidths(case: Case, machine: Machine, shares: Sequence[float] = FALLING) -> tuple[float, ...]:
    """Bandwidths (rad/s) of the trackers, from about what noise allows down to none."""
    top = min(noise_bandwidth(case, m) for m in machine.motions() if m is not None)
    return tuple(top * share for share in shares)
