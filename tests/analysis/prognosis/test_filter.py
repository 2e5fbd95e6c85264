"""The filter against what can be known otherwise: a dense Gaussian, long Monte Carlo, other units, the smoother's
own sums."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import invgauss, multivariate_normal, norm

from lacuna.analysis.prognosis.filter.bank import Bank
from lacuna.analysis.prognosis.filter.crossing import Remaining, remaining
from lacuna.analysis.prognosis.filter.filter import Series, run
from lacuna.analysis.prognosis.filter.law import Law
from lacuna.analysis.prognosis.filter.settings import FilterSettings
from lacuna.analysis.prognosis.filter.smoother import smooth
from lacuna.analysis.prognosis.forecast import forecasts
from lacuna.analysis.prognosis.series import series_of
from tests.analysis.prognosis import particles
from tests.analysis.prognosis.histories import LAWS, LIMITS, exponential, history, linear

LIFE = 40.0  # tests
# One law, one known rate, no outliers and no changes: a Wiener process with drift, observed with Gaussian errors.
GAUSSIAN = FilterSettings(
    lives=(LIFE, LIFE), tile=1e-9, noises=((1.0, 1.0, 1.0, 0.0),), commons=(0.0,), wide=0, outlier=0, change=0
)
WIENER = Law.of("linear", lambda x: 1 + 0 * x, wander=0.0, diffusion=0.05)


def wiener(seed: int, n: int = 30):
    """(series, truth, rate): irregular tests of the process that the filter is told."""
    random = np.random.default_rng(seed)
    use = np.concatenate([[0.0], np.cumsum(random.uniform(0.2, 2.0, n - 1))])
    rate = Bank([WIENER], GAUSSIAN).tables[0].life / LIFE
    mean, deviation = GAUSSIAN.first
    steps = rate * np.diff(use)
    increments = steps + 0.05 * np.sqrt(steps) * random.standard_normal(n - 1)
    truth = mean + deviation * random.standard_normal() + np.concatenate([[0.0], np.cumsum(increments)])
    sd = random.uniform(0.01, 0.05, n)
    value = truth + sd * random.standard_normal(n)
    tests = (a[None] for a in (use, value, sd, sd, random.random(n) < 0.8))
    return Series(*tests, np.ones(1), sd[None]), truth, rate


def dense(series: Series, rate: float):
    """Mean and covariance of the severity at every test, and the log evidence, by one solve with dense matrices."""
    use, valid = series.use[0], series.valid[0]
    mean, deviation = GAUSSIAN.first
    centre = mean + rate * use
    prior = deviation**2 + 0.05**2 * rate * np.minimum.outer(use, use)
    seen = prior[np.ix_(valid, valid)] + np.diag(series.above[0, valid] ** 2)
    gain = np.linalg.solve(seen, prior[valid]).T
    y = series.value[0, valid] - centre[valid]
    evidence = multivariate_normal(np.zeros(valid.sum()), seen).logpdf(y)
    return centre + gain @ y, prior - gain @ prior[valid], evidence


@pytest.mark.parametrize("seed", range(10))
def test_known_rate_is_the_dense_gaussian(seed):
    series, _, rate = wiener(seed)
    bank = Bank([WIENER], GAUSSIAN)
    steps = list(run(bank, series, keep=True))
    mean, covariance, evidence = dense(series, rate)
    assert steps[-1].filtered.x.item() == pytest.approx(mean[-1], abs=1e-9)
    assert steps[-1].filtered.xx.item() == pytest.approx(covariance[-1, -1], rel=1e-7)
    assert sum(step.evidence.item() for step in steps) == pytest.approx(evidence, abs=1e-8)
    smoothed, spread = smooth(bank, steps)
    assert smoothed[:, 0, 0, 0, 0] == pytest.approx(mean, abs=1e-8)
    assert spread[:, 0, 0, 0, 0, 0] == pytest.approx(np.diagonal(covariance), rel=1e-6)


def test_exceedances_come_at_the_right_rate():
    """Of 200 processes the truth lies outside the 90 % interval in 10 %, within four standard errors."""
    outside = 0
    for seed in range(200):
        series, truth, _ = wiener(seed)
        *_, last = run(Bank([WIENER], GAUSSIAN), series)
        outside += abs(truth[-1] - last.filtered.x.item()) > 1.644854 * np.sqrt(last.filtered.xx.item())
    assert abs(outside - 20) < 4 * np.sqrt(200 * 0.1 * 0.9)


def test_first_passage_is_the_inverse_gaussian():
    """Known severity and rate: mean distance/rate, shape distance^2/diffusion^2 in the age's own clock."""
    bank = Bank([WIENER], GAUSSIAN)
    beliefs = bank.start(np.ones(1))
    beliefs = replace(beliefs, x=np.full_like(beliefs.x, 0.5), xx=np.full_like(beliefs.xx, 1e-14))
    rate = bank.tables[0].life / LIFE
    found = remaining(bank, beliefs, 1.0, np.zeros(1), np.ones(1)).quantiles(
        (0.025, 0.1, 0.5, 0.9, 0.975), np.array([1e4])
    )
    mean, shape = 0.5 / rate, 0.5**2 / (0.05**2 * rate)
    exact = invgauss(mean / shape, scale=shape).ppf((0.025, 0.1, 0.5, 0.9, 0.975))
    assert found[0] == pytest.approx(exact, rel=2e-3)


@pytest.mark.parametrize(("truth", "life"), [(linear, 0.5), (exponential, 0.6), (exponential, 0.8)])
def test_as_a_long_monte_carlo(truth, life):
    """Probability of the limit over time, beside 100 000 particles of the same model: a Gaussian sum is within 0.1
    of it."""
    laws = LAWS[:2]
    bank = Bank(laws, FilterSettings(noises=((1.0, 1.0, 1.0, 0.0),), change=0.0))
    use = np.arange(1.0, life * 40)
    h = history(lambda n: truth(n, 40.0), use, seed=3)
    series = series_of([h], LIMITS.removal, bank)
    *_, last = run(bank, series)
    ahead = (1 - life) * 40 * np.array([0.5, 0.7, 0.85, 1.0, 1.2, 1.5, 2.0, 3.0])
    sd = float(np.median(series.above))
    found = remaining(bank, last.filtered, 1.0, np.array([sd]), series.interval).reached(ahead[None])[0]
    state = particles.posterior(bank, series.use[0], series.value[0], sd, series.interval[0], count=100_000)
    assert found == pytest.approx(particles.remaining(bank, state, sd, ahead), abs=0.1)


def test_the_unit_of_time_changes_nothing():
    use = np.sort(np.random.default_rng(1).uniform(0, 3000, 30))
    h = history(linear, use)
    one, other = (
        forecasts([replace(h, use=h.use * factor)], Bank(LAWS), LIMITS)[0] for factor in (1.0, 2.7777e-4)
    )  # fmt: skip
    assert one.verdict == other.verdict == "forecast"
    assert other.quantiles == pytest.approx(one.quantiles * 2.7777e-4, rel=1e-9)
    assert other.risk == pytest.approx(one.risk, abs=1e-12)
    assert other.weights == pytest.approx(one.weights, rel=1e-9)


def test_one_history_alone_is_the_same_as_among_others():
    many = [history(linear, np.arange(0, 100.0 * n, 100.0), seed=n) for n in (5, 17, 30)]
    together = forecasts(many, Bank(LAWS), LIMITS)
    for h, f in zip(many, together, strict=True):
        alone = forecasts([h], Bank(LAWS), LIMITS)[0]
        assert alone.quantiles == pytest.approx(f.quantiles, rel=1e-9) and alone.risk == pytest.approx(
            f.risk, abs=1e-12
        )


def test_a_sum_of_lognormals_is_that_of_the_normal_distribution():
    """To 4e-8 in C++, far tails and limits that are reached already included."""
    random = np.random.default_rng(5)
    mean, sd = random.normal(3, 1, (4, 30)), random.uniform(0.05, 1.5, (4, 30))
    mean[:, 3], weight = -np.inf, random.dirichlet(np.ones(30), 4)
    use = np.concatenate([[0.0], np.geomspace(1e-3, 1e5, 200)]) * np.ones((4, 1))
    with np.errstate(divide="ignore", invalid="ignore"):
        each = norm.cdf((np.log(use)[:, :, None] - mean[:, None]) / sd[:, None])
    each[:, :, 3] = 1.0
    found = Remaining(mean, sd, weight).reached(use)
    assert found == pytest.approx((weight[:, None] * each).sum(axis=2), abs=4e-8)
