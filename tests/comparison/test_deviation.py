"""Numbers of a comparison, on trajectories whose deviations are known."""

import numpy as np
import pytest

from lacuna.analysis.comparison.deviation import (
    event_deviation,
    event_pairs,
    observed_order,
    outside_event_gaps,
    signal_deviation,
)


def test_deviation_of_a_known_difference():
    time = np.linspace(0, 1, 101)
    reference = 2 * np.sin(2 * np.pi * time)
    candidate = reference + 0.01 * time
    found = signal_deviation("x", time, reference, candidate, np.ones(101, dtype=bool))
    assert found.maximum == pytest.approx(0.01, rel=1e-12)
    assert found.at_time == 1.0
    assert found.rms == pytest.approx(0.01 * np.sqrt(np.mean(time**2)), rel=1e-12)
    assert found.relative == pytest.approx(0.005, rel=1e-12)


def test_not_a_number_is_the_worst_deviation():
    time = np.arange(3.0)
    found = signal_deviation("x", time, np.zeros(3), np.array([0.0, np.nan, 9.0]), np.ones(3, dtype=bool))
    assert np.isnan(found.maximum)
    assert found.at_time == 1.0


def test_events_are_matched_kind_by_kind():
    reference = [(0.1, "a"), (0.2, "b"), (0.3, "a"), (0.9, "c")]
    candidate = [(0.11, "a"), (0.19, "b"), (0.3, "a"), (0.5, "b")]
    found = event_deviation(reference, candidate)
    assert (found.matched, found.unmatched) == (3, 2)
    assert found.maximum == pytest.approx(0.01)
    assert (found.kind, found.at_time) in (("a", 0.1), ("b", 0.2))


def test_surplus_events_are_those_that_fit_least():
    reference = [(t, "a") for t in (0.1, 0.3, 0.9)]
    candidate = [(t, "a") for t in (0.101, 0.2, 0.201, 0.299, 0.9, 0.95)]
    for first, second in ((reference, candidate), (candidate, reference)):
        found = event_deviation(first, second)
        assert (found.matched, found.unmatched) == (3, 3)
        assert found.maximum == pytest.approx(0.001)


def test_a_jump_between_two_event_times_is_not_a_deviation_of_the_signal():
    time = np.linspace(0, 1, 11)
    pairs, _ = event_pairs([(0.38, "a")], [(0.52, "a")])
    use = outside_event_gaps(time, pairs)
    assert list(np.flatnonzero(~use)) == [4, 5]
    reference, candidate = (time > 0.38).astype(float), (time > 0.52).astype(float)
    assert signal_deviation("step", time, reference, candidate, use).maximum == 0.0


@pytest.mark.parametrize("order", [1, 2, 4])
def test_order_of_a_power_law(order):
    steps = np.array([1e-2, 5e-3, 2.5e-3])
    assert observed_order(steps, 3.0 * steps**order, floor=0.0) == pytest.approx(order, rel=1e-9)


def test_errors_at_the_floor_have_no_order():
    steps = np.array([1e-2, 5e-3, 2.5e-3])
    assert np.isnan(observed_order(steps, np.array([1e-3, 1e-12, 1e-12]), floor=1e-11))
