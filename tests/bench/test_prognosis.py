"""The fleet of the prognosis study and its oracle, against closed forms."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.stats import norm

from bench.prognosis import truth
from bench.prognosis.fleet import LIMIT, Part
from bench.prognosis.oracle import ReadingErrors, best_figure, posterior
from bench.prognosis.scores import ALPHA, CHECKPOINTS
from lacuna.analysis.prognosis.history import History
from lacuna.analysis.severity.robustness import Results

NOISE, PULL = 0.002, 0.003  # of a reading, and what a unit of inertia adds to it


@pytest.mark.parametrize(("law", "share"), [("steady wear", 0.5), ("in proportion", None)])
def test_lives_follow_their_law(law, share):
    """Half of the growth takes half of a steady life; in proportion, equal ratios take equal times."""
    middles = []
    for seed in range(300):
        life = truth.draw(law, np.random.default_rng(seed))
        start = life.severity[0]
        at = (1 + start) / 2 if share else np.sqrt(start)
        middles.append(np.interp(at, life.severity, life.time))
    assert np.mean(middles) == pytest.approx(0.5, abs=0.01)


def simulated(count: int = 4096) -> Results:
    random = np.random.default_rng(0)
    severity, z = random.uniform(0, 0.5, count), np.sqrt(3) * random.uniform(-1, 1, (count, 6))
    read = severity + PULL * z[:, 3] + NOISE * random.standard_normal(count)
    yes, no = np.ones(count, bool), np.zeros(count, bool)
    return Results(severity, z, read, read, read, no * 1.0, read, yes, no)


def test_what_friction_and_inertia_do_to_a_reading_is_known():
    """The likelihood of a reading falls as a normal density about what inertia makes of the severity."""
    readings, one = ReadingErrors(simulated()), np.ones(1)
    at = 0.2 + PULL + NOISE * np.array([0.0, 1.0, 2.0])
    found = np.array([readings.log_likelihood(y, 0.2 * one, 0 * one, one)[0] for y in at])
    assert found - found[0] == pytest.approx(norm.logpdf([0, 1, 2]) - norm.logpdf(0), abs=0.15)


def test_the_best_figure_of_a_lognormal():
    """Within alpha of c lies an interval of the logarithm whose width is known; the best lies about the median."""
    s = 0.3
    sample = np.exp(s * np.random.default_rng(1).standard_normal(200_000))
    half = (np.log(1 + ALPHA) - np.log(1 - ALPHA)) / 2
    assert best_figure(sample) == pytest.approx(2 * norm.cdf(half / s) - 1, abs=0.005)


def test_the_oracle_told_all_finds_a_steady_life():
    """A part that wears steadily and is read with little noise: its posterior holds the life, and is narrow."""
    use = np.arange(10.0, 500.0, 10.0)
    life, random = 500.0, np.random.default_rng(2)
    severity = LIMIT * (0.05 + 0.95 * use / life) + NOISE * random.standard_normal(len(use))
    history = History("P7", "cycles", use, severity, severity, severity, np.zeros(len(use), bool))
    own = truth.Life("steady wear", np.array([0.0, 1.0]), np.array([0.05, 1.0]))
    found = posterior(
        Part("P7", "steady wear", own, 0.0, life, history, severity), ReadingErrors(simulated()), "shape", 1
    )
    for share in CHECKPOINTS[2:]:
        rows = int(np.searchsorted(use, share * life, side="right"))
        low, middle, high = np.quantile(found[rows], (0.025, 0.5, 0.975))
        assert low < life - use[rows - 1] < high
        assert (high - low) / middle < 0.6
