"""The residuals that a fit makes small: each signal in units of its noise, led by its own level and by trackers."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import numpy as np

from lacuna.discovery.case.cases import Case, Recording
from lacuna.discovery.case.noise import Noise, estimate, sample_weights
from lacuna.discovery.case.values import is_read
from lacuna.discovery.catalogue.amend import tracker_name
from lacuna.discovery.fit.machine import Machine
from lacuna.discovery.fit.solver.least_squares import Estimate, Problem, solve

STAGES = 10  # of weights, at most: levels that have not settled by then do not
WORTH = 1.0  # of the weighted cost, that a stage of a fit has to win for another to follow
SETTLED = 0.02  # relative change of a signal's level at which weights are taken to have settled


def noise_of(case: Case) -> dict[str, Noise]:
    """Noise of every output, as given or as estimated from the recordings that may be fitted."""
    return case.noise or {
        s.column: estimate([r.columns[s.column] for r in case.fit], s.noise_std) for s in case.outputs
    }


class Objective:
    """Residuals of one machine on some recordings, in units of noise, and the weights that lead a fit."""

    def __init__(
        self, machine: Machine, recordings: Sequence[Recording], noise: Mapping[str, Noise], coarsely: bool = False
    ) -> None:  # fmt: skip
        self.machine, self.recordings, self.noise, self.coarsely = machine, list(recordings), dict(noise), coarsely
        self.columns = list(noise)
        self.samples = [{c: sample_weights(r.columns[c], self.noise[c]) for c in self.columns} for r in recordings]
        self.stiffness: dict[str, float] = {}
        self._trackers = [tracker_name(k) for k in range(len(machine.amendment.trackers))]
        self.level = dict.fromkeys([*self.columns, *self._trackers], 1.0)
        self.torque_scale = dict.fromkeys(self._trackers, 1.0)

    def readers(self, names: Iterable[str]) -> dict[str, list[int]]:
        """The recordings, by number, whose simulation reads each of these values."""
        return {n: [k for k, r in enumerate(self.recordings) if is_read(n, r)] for n in names}

    def sections(self) -> list[str]:
        return self.columns + (self._trackers if self.stiffness else [])

    def __call__(self, values: dict[str, float], piece: int) -> np.ndarray | None:
        recording = self.recordings[piece]
        simulated = self.machine.simulate(values | self.stiffness, recording, coarsely=self.coarsely)
        if simulated is None:
            return None
        parts = [
            where_measured(recording.columns[c], simulated[c]) * self.samples[piece][c] / self.noise[c].std
            for c in self.columns
        ]
        if self.stiffness:
            parts += [simulated[t] / self.torque_scale[t] for t in self._trackers]
        return np.concatenate(parts)

    def measure(self, parts: list[np.ndarray]) -> dict[str, float]:
        """RMS of each section over all pieces (unweighted parts)."""
        names = self.sections()
        split = [np.split(p, len(names)) for p in parts]
        squares = [sum(float(s[k] @ s[k]) for s in split) for k in range(len(names))]
        counts = [
            sum(
                float(np.sum(w[n] ** 2)) if n in w else len(r.time)
                for w, r in zip(self.samples, self.recordings, strict=True)
            )
            for n in names
        ]
        return {n: float(np.sqrt(s / c)) for n, s, c in zip(names, squares, counts, strict=True)}

    def weights(self, level: Mapping[str, float]) -> list[np.ndarray]:
        names = self.sections()
        return [np.concatenate([np.full(len(r.time), 1.0 / level[n]) for n in names]) for r in self.recordings]

    def weighted(self, values: Mapping[str, float], weights: Sequence[np.ndarray]) -> np.ndarray | None:
        """The residual of all recordings together, weighted; None where one cannot be simulated."""
        parts = [self(dict(values), k) for k in range(len(self.recordings))]
        if any(p is None for p in parts):
            return None
        return np.concatenate([p * w for p, w in zip(parts, weights, strict=True)])

    def track(self, bandwidth: float, parameters: Mapping[str, float]) -> None:
        """Set the trackers to a bandwidth (rad/s); zero takes them away."""
        self.stiffness = {}
        if not bandwidth:
            return
        constants = self.machine.constants(parameters)
        for name, shaft in zip(self._trackers, self.machine.amendment.trackers, strict=True):
            inertia = constants[f"{shaft.location}.J"]
            self.stiffness |= {f"{name}.c": inertia * bandwidth**2, f"{name}.d": 1.4 * inertia * bandwidth}
            self.torque_scale[name] = inertia * bandwidth


def where_measured(measured: np.ndarray, simulated: np.ndarray) -> np.ndarray:
    """Measured less simulated, nothing where there is no sample; what was simulated to no number stays none."""
    return np.where(np.isnan(measured), 0.0, measured - simulated)


def anneal(
    objective: Objective, problem: Problem, start: np.ndarray, *, stages: int = STAGES, iterations: int = 4,
    known: Mapping[int, list[np.ndarray]] | None = None, renewed: bool = True,
) -> tuple[Estimate | None, dict[str, float]]:  # fmt: skip
    """Alternate weights from the residuals and a few steps of least squares until both have settled.

    `known` are unweighted columns of the Jacobian that may serve at first. Where a fit of all stages ends it is taken
    anew, but not where it is only led by trackers: letting go moves the values by more than what is WORTH a step.
    """
    problem.weights, level, values, led = None, {}, start, bool(objective.stiffness)
    here, best, tolerance = problem.evaluate(start), None, WORTH / max(len(problem.free), 1) if led else 1e-3
    parts, columns = (here[2] if here else []), dict(known or {})
    for _ in range(stages if here else 0):
        new = {n: max(1.0 if n in objective.noise else 1e-6, v) for n, v in objective.measure(parts).items()}
        if best is not None and _settled(level, new, best.converged or led):
            break
        level, weights = new, objective.weights(new)
        problem.weights = weights
        weighted = {k: [c * w for c, w in zip(cs, weights, strict=True)] for k, cs in columns.items()}
        begin = problem.evaluation(values, [p * w for p, w in zip(parts, weights, strict=True)])
        best = solve(problem, values, iterations=iterations, damping=1e-6, tolerance=tolerance, known=weighted,
                     here=begin, renewed=renewed, sure=not led)  # fmt: skip
        values, parts = best.values, [p / w for p, w in zip(best.residuals, weights, strict=True)]
        blocks = [block / w[:, None] for block, w in zip(best.jacobian, weights, strict=False)]
        columns = {k: [block[:, k] for block in blocks] for k in range(len(problem.free))} if blocks else {}
        if best.begun - best.cost < WORTH:
            break
    if best is not None and not best.exact and stages >= STAGES and renewed and not led:
        best = problem.renewed(best)
    return best, level


def _settled(before: Mapping[str, float], after: Mapping[str, float], converged: bool) -> bool:
    """Whether another stage leads nowhere: where `converged` ends in the same levels."""
    return converged and alike(before, after)


def alike(before: Mapping[str, float], after: Mapping[str, float]) -> bool:
    """Whether levels have settled."""
    return all(abs(np.log(after[n] / before[n])) < SETTLED for n in after)
