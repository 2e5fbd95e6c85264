"""How tests scatter is learnt from a fleet, whatever their intervals state."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from lacuna.analysis.prognosis.filter.bank import Bank
from lacuna.analysis.prognosis.filter.scatter import GROUP, scatter_of
from lacuna.analysis.prognosis.forecast import fleet_prior, forecasts
from lacuna.analysis.prognosis.history import History
from tests.analysis.prognosis.histories import LAWS, LIMITS, exponential, history

FLOOR = 1e-3


def lives(own, stated, *, count=40, tests=60, outliers=0.02, seed=0):
    """Straight lines with a scatter `own(severity, factor)` and an error in common, stated as `stated(...)`; the
    factor is drawn for each test."""
    random = np.random.default_rng(seed)
    for _ in range(count):
        use = np.cumsum(random.lognormal(0, 0.5, tests))
        true, factor = 0.05 + 0.9 * use / use[-1], random.lognormal(0, 0.7, tests)
        read = true + 0.01 * random.standard_normal() + own(true, factor) * random.standard_normal(tests)
        yield use, np.where(random.random(tests) < outliers, random.uniform(0, 1.4, tests), read), stated(true, factor)


def test_scatter_by_severity_beside_a_common_error_and_outliers():
    found = scatter_of(lives(lambda x, _: 0.002 + 0.01 * x, lambda x, factor: 0.02 * factor), FLOOR)
    assert found and not found.stated
    x = np.linspace(0.1, 0.9, 50)
    ratio = found.deviation(x, np.full(50, 0.02)) / (0.002 + 0.01 * x)
    # Each knot is told to a tenth or so, all together to 3 %; one triple in sixteen with an outlier adds 8 %.
    assert ratio.mean() == pytest.approx(1.04, abs=0.12)
    assert np.all(abs(ratio - 1) < 0.5)


def test_intervals_that_tell_their_own_tests_are_kept():
    found = scatter_of(lives(lambda x, factor: 0.004 * factor, lambda x, factor: 0.02 * factor), FLOOR)
    assert found and found.stated
    x = np.linspace(0.1, 0.9, 50)
    for stated in (0.01, 0.04):
        assert found.deviation(x, np.full(50, stated)).mean() == pytest.approx(1.04 * 0.2 * stated, rel=0.12)


def test_few_tests_tell_no_scatter():
    few = list(lives(lambda x, _: 0.01, lambda x, _: np.full_like(x, 0.02), count=2))
    assert sum(len(use) - 2 for use, _, _ in few) < GROUP
    assert scatter_of(few, FLOOR) is None


def fleet(wide: float, unit: float = 1.0) -> tuple[Bank, list[History]]:
    """Twenty ended lives whose tests scatter by 0.1 %, which they state `wide` times too large, and their bank."""
    use = np.arange(100, 5600.0, 100)
    past = [widened(history(exponential, use, sd=0.001, seed=k), wide, unit) for k in range(20)]
    bank = Bank(LAWS)
    fleet_prior(past, bank, lambda _: LIMITS)
    return bank, past


def widened(h: History, wide: float, unit: float = 1.0) -> History:
    """As `h`, with intervals `wide` times as wide and use counted in another unit."""
    low, high = (np.clip(h.severity + wide * (a - h.severity), 0, 0.5) for a in (h.low, h.high))
    return replace(h, low=low, high=high, use=unit * h.use)


def told(bank: Bank, wide: float, unit: float = 1.0, fault: str = ""):
    young = widened(history(exponential, np.arange(100, 3000.0, 100), sd=0.001, seed=99), wide, unit)
    return forecasts([replace(young, fault=fault)], bank, LIMITS, learn=False)[0]


def test_a_fleet_whose_intervals_are_too_wide_is_forecast_as_sharply():
    right, wide = (told(fleet(factor)[0], factor) for factor in (1.0, 6.0))
    assert wide.severity[1] == pytest.approx(right.severity[1], rel=0.2)
    widths = [f.quantiles[-1, 3] / f.quantiles[-1, 1] for f in (right, wide)]
    assert widths[1] < 1.3 * widths[0]


def test_the_unit_of_use_changes_nothing():
    cycles, hours = (told(fleet(6.0, unit)[0], 6.0, unit) for unit in (1.0, 0.037))
    assert hours.quantiles[-1] / 0.037 == pytest.approx(cycles.quantiles[-1], rel=1e-6)


def test_another_fault_is_read_as_it_states():
    bank, _ = fleet(6.0)
    assert told(bank, 6.0, fault="friction").severity[1] > 2 * told(bank, 6.0).severity[1]
