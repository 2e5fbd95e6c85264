"""What a forecast says of parts whose life is known: outliers, gaps, replacements, changes, and too little to go by."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from lacuna.analysis.errors import AnalysisError
from lacuna.analysis.prognosis.filter.bank import Bank
from lacuna.analysis.prognosis.forecast import Options, fleet_prior, forecasts
from tests.analysis.prognosis.histories import LAWS, LIMITS, exponential, history, linear


def said(h, **options):
    return forecasts([h], Bank(LAWS), LIMITS, Options(**options))[0]


TESTS = np.arange(0, 3000.0, 100)  # of a life of 5000


@pytest.mark.parametrize("truth", [linear, exponential])
def test_the_truth_lies_within_95_percent(truth):
    """Of six parts; their medians scatter about it (one whose noise looks like another law may be far off)."""
    many = forecasts([history(truth, TESTS, seed=seed) for seed in range(6)], Bank(LAWS), LIMITS)
    left = 5000 - TESTS[-1]
    assert all(f.verdict == "forecast" and f.quantiles[-1, 0] < left < f.quantiles[-1, -1] for f in many)
    assert np.median([f.quantiles[-1, 2] for f in many]) == pytest.approx(left, rel=0.1)


def test_the_right_law_weighs_most():
    assert next(iter(said(history(linear, np.arange(0, 4500.0, 100))).weights)) == "linear"
    assert next(iter(said(history(exponential, np.arange(0, 4500.0, 100))).weights)) == "exponential"


def test_advised_test_keeps_the_risk():
    f = said(history(linear, TESTS), risk=0.01)
    at = np.flatnonzero(np.isclose(f.ahead, f.advised))[0]
    assert f.risk[-1, at] <= 0.01 < f.risk[-1, at + 1]
    assert said(history(linear, TESTS), risk=0.0001).advised <= f.advised


def test_outliers_and_missing_tests_change_little():
    clean = said(history(linear, TESTS))
    gone = np.isin(np.arange(30), (4, 5, 11, 22, 23))
    h = history(linear, TESTS, outliers={7: 0.45, 20: 0.0})
    h = replace(h, severity=np.where(gone, np.nan, h.severity))
    f = said(h)
    assert f.outliers[[7, 20]] == pytest.approx([1, 1], abs=0.05) and f.outliers[12] < 0.01
    assert f.quantiles[-1, 2] == pytest.approx(clean.quantiles[-1, 2], rel=0.15)


def test_an_outlier_at_the_end_is_no_reason_to_remove():
    f = said(history(linear, TESTS, outliers={29: 0.33}))
    assert f.advised is not None and f.advised > TESTS[-1]


def test_a_replacement_starts_a_new_life():
    use = np.arange(0, 8000.0, 100)
    new = 5000.0
    h = history(lambda n: np.where(n < new, linear(n), linear(n - new)), use, replaced=[50])
    f = said(h)
    assert f.quantiles[-1, 0] < new + 5000 - use[-1] < f.quantiles[-1, -1]
    alone = said(replace(history(linear, use[50:] - new), severity=h.severity[50:], low=h.low[50:], high=h.high[50:]))
    assert f.quantiles == pytest.approx(alone.quantiles, rel=1e-9)


def test_a_change_of_the_rate_is_followed():
    """Three times as fast from half way on: after ten more tests the forecast is that of the new rate."""

    def truth(n):
        return np.where(n < 2000, 0.02 + 0.04 * n / 1000, 0.10 + 0.12 * (n - 2000) / 1000)

    f = said(history(truth, np.arange(0, 3050.0, 100)))
    assert f.quantiles[-1, 0] < 4000 - 3000 < f.quantiles[-1, -1]


def test_more_tests_than_a_life_is_believed_to_have_are_no_forecast():
    """Ten thousand of a straight line told a third of the life that was left, with an interval that left it out."""
    f = said(history(linear, np.arange(0, 3000.0, 1.5)))
    assert f.verdict == "too_early" and "give one of 2" in f.reason and not f.tells


@pytest.mark.parametrize("tests", [1, 2])
def test_too_few_tests_are_too_early(tests):
    f = said(history(linear, TESTS[:tests] + 100))
    assert f.verdict == "too_early" and f.advised is None


def test_a_healthy_part_is_steady():
    f = said(history(lambda n: 0.03 + 0 * n, TESTS))
    assert f.verdict == "steady"
    assert f.risk[-1, 0] < 1e-3


def test_a_part_beyond_the_limit_has_nothing_left():
    f = said(history(linear, np.arange(0, 5600.0, 100)))
    assert f.verdict == "forecast" and f.quantiles[-1, 2] == 0 and f.advised == f.at


def test_another_actuators_tests_give_no_number():
    h = history(lambda n: np.where(np.round(n / 100) % 2 == 0, 0.05, 0.25), TESTS)
    f = said(h)
    assert f.verdict != "forecast" and f.warnings


def test_an_unrecorded_replacement_gives_no_number():
    f = said(history(lambda n: np.where(n < 2700, linear(n), 0.02), TESTS))
    assert f.verdict == "too_early" and any("replacement" in w for w in f.warnings)


@pytest.mark.parametrize("value", [-0.01, 0.6, 20.0])
def test_severities_outside_the_map_are_refused(value):
    h = history(linear, TESTS)
    h.severity[3] = value
    with pytest.raises(
        AnalysisError, match="actuator A, cycles 300.*outside the map" + (".*percent" if value > 1 else "")
    ):
        said(h)


def test_two_faults_have_two_lives():
    from lacuna.analysis.prognosis.forecast import Limits

    other = Limits(LIMITS.names, (0.14, 0.187, 0.234), 0.047, 0.28, healthy=0.09)
    first = history(linear, TESTS)
    second = replace(history(lambda n: 0.09 + 0.144 * n / 7000, TESTS, seed=4), fault="friction")
    one, two = forecasts([first, second], Bank(LAWS), lambda h: other if h.fault else LIMITS)
    assert one.quantiles[-1, 0] < 5000 - TESTS[-1] < one.quantiles[-1, -1]
    assert two.quantiles[-1, 0] < 7000 - TESTS[-1] < two.quantiles[-1, -1]
    alone = forecasts([second], Bank(LAWS), other)[0]
    assert two.quantiles == pytest.approx(alone.quantiles, rel=1e-9)


def crack(n, life=5000.0):
    """der(x) = x^2 from 0.04 of the limit on: beyond the limit it leaves the map within a few tests."""
    return 0.34 / np.maximum(25 - 24 * n / life, 1e-3)


def test_what_a_part_does_beyond_its_limit_tells_no_life():
    """Of twenty that crack: watched on at the map's end, they give the prior of those that stop at the limit."""
    whole = [history(crack, np.arange(0, 6000.0, 100), sd=0.002, seed=k) for k in range(20)]
    upto = [np.argmax(h.severity >= LIMITS.removal) + 3 for h in whole]
    columns = ("use", "severity", "low", "high", "replaced")
    cut = [replace(h, **{name: getattr(h, name)[:n] for name in columns}) for h, n in zip(whole, upto, strict=True)]
    priors = []
    for histories in (whole, cut):
        bank = Bank(LAWS)
        fleet_prior(histories, bank, lambda _: LIMITS)
        priors.append(bank.prior)
    first = Bank(LAWS).prior.sum(axis=(1, 2))
    assert np.argmax(priors[0].sum(axis=(1, 2)) / first) == [law.name for law in LAWS].index("crack")
    assert priors[0] == pytest.approx(priors[1], rel=1e-9)


def test_a_horizon_beyond_all_counts_lists_as_many_tests_as_a_long_one():
    known = history(linear, np.arange(100.0, 900.0, 100.0))
    long, longest = (said(known, horizon=h) for h in (1e9, 1e300))
    assert len(longest.ahead) == len(long.ahead) > 0
    assert longest.advised == long.advised
