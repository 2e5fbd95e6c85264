"""The fleet of the study: parts with a life, and the pre-flight tests that are made of them.

A test is read as one of the simulated tests of `make robustness` was read, that of the nearest severity and of the
nearest friction
and inertia: those two stay with an actuator for life, temperature and supply change from test to test.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from bench.prognosis.truth import KNOWN, UNKNOWN, Life, draw
from lacuna.analysis.prognosis.history import History
from lacuna.analysis.severity.robustness import Results

LIMIT = 0.34  # violet
OUTLIERS, MISSING, SECOND_LIVES, OUTSIDE = 0.02, 0.05, 0.1, 0.3
NEAREST = 8
FRICTION, INERTIA = 0, 3  # columns of the nuisances that stay with an actuator


@dataclass(frozen=True)
class Part:
    """`use` [cycles] of every test up to the limit and a little beyond; `life`: use at which the limit is reached."""

    name: str
    law: str
    truth: Life
    born: float  # use at which the part was put in
    life: float  # cycles, from then on
    history: History
    mean_rms: np.ndarray  # severity as the paper's mean RMS reads it, NaN where missing

    @property
    def number(self) -> int:
        return int(self.name[1:])

    def severity(self, use: np.ndarray) -> np.ndarray:
        """Of the part in service, a fraction."""
        return LIMIT * np.interp((use - self.born) / self.life, self.truth.time, self.truth.severity)


def tests_a_life(random: np.random.Generator, count: int | None = None):
    """Tests a life: as many of 20 to 40 as of 60 to 120."""
    return np.exp(random.uniform(np.log(20), np.log(120), count))


class Readings:
    """How simulated tests were read, to be drawn from by severity and by what stays with an actuator."""

    def __init__(self, tests: Results):
        ok = tests.covered & np.isfinite(tests.estimate)
        self._place = np.column_stack([tests.severity / 0.02, 2 * tests.z[:, FRICTION], 2 * tests.z[:, INERTIA]])
        self._tests, self._ok = tests, ok

    def draw(self, severity: float, friction: float, inertia: float, random: np.random.Generator):
        """(severity, low, high, by mean RMS), or NaN where the test was refused."""
        distance = ((self._place - [severity / 0.02, 2 * friction, 2 * inertia]) ** 2).sum(axis=1)
        k = int(random.choice(np.argpartition(distance, NEAREST)[:NEAREST]))
        t, shift = self._tests, severity - self._tests.severity[k]
        if not self._ok[k]:
            return (np.nan,) * 4
        moved = np.clip(np.array([t.estimate[k], t.low[k], t.high[k], t.paper[k]]) + shift, 0.0, 0.5)
        return tuple(moved)


def part(number: int, seed: int, readings: Readings) -> Part:
    """Part `number` of the fleet of this seed, always the same."""
    random = np.random.default_rng([seed, number])
    law = str(random.choice(UNKNOWN if random.random() < OUTSIDE else KNOWN))
    truth = draw(law, random)
    tests, gap = tests_a_life(random), np.exp(random.uniform(np.log(20), np.log(500)))
    born = 0.0
    nuisances = np.sqrt(3) * random.uniform(-1, 1, 2)
    rows: list[tuple[float, bool, tuple]] = []
    if random.random() < SECOND_LIVES:  # the end of another part's life before
        previous = draw(str(random.choice(KNOWN)), random)
        use = np.cumsum(gap * random.lognormal(0, 0.3, 12))
        at = np.interp(np.linspace(0.6, 0.95, 12), previous.time, previous.severity)
        rows += [(n, False, readings.draw(LIMIT * x, *nuisances, random)) for n, x in zip(use, at, strict=True)]
        born = float(use[-1] + 0.5 * gap)
    life = tests * gap
    use = born + np.cumsum(gap * random.lognormal(0, 0.3, int(2 * tests) + 10))
    use = use[use < born + 1.15 * life]
    first = len(rows)
    own = Part(f"P{number:05d}", law, truth, born, life, None, np.empty(0))  # type: ignore[arg-type]
    for n in use:
        rows.append((n, len(rows) == first and first > 0, _test(own, n, nuisances, readings, random)))
    values = np.array([row[2] for row in rows])
    history = History(
        own.name, "cycles", np.array([row[0] for row in rows]), *values.T[:3], np.array([row[1] for row in rows])
    )
    return Part(own.name, law, truth, born, life, history, values[:, 3])


def _test(own: Part, use: float, nuisances, readings: Readings, random: np.random.Generator) -> tuple:
    if random.random() < MISSING:
        return (np.nan,) * 4
    true = min(float(own.severity(np.array(use))), 0.5)
    if random.random() < OUTLIERS:
        severity, low, high, paper = readings.draw(float(random.uniform(0, 0.5)), *nuisances, random)
        return severity, low, high, paper
    return readings.draw(true, *nuisances, random)
