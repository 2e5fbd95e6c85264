"""A fit beside errors of the sensors' zeros, and their drifts, is the fit that has them among its parameters."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from lacuna.discovery.fit.solver.least_squares import Estimate
from lacuna.discovery.fit.zeros import beside_zeros
from tests.discovery.test_left_out import BELIEF, LEVEL, NOISE, linear_fit

ZERO = 0.7 * NOISE.std


@pytest.fixture
def data() -> tuple[list[np.ndarray], list[np.ndarray]]:
    """Of a column that is nearly level, so that its coefficient stands for a zero."""
    rng = np.random.default_rng(6)
    rows = [np.column_stack([1 + 0.1 * rng.standard_normal(400), rng.standard_normal(400)]) for _ in range(2)]
    return rows, [a @ [0.0, 2.3] + ZERO + NOISE.std * rng.standard_normal(400) for a in rows]


def errors(recording: int, samples: int) -> np.ndarray:
    """(samples, 3) of a zero, and of a drift in each of two recordings."""
    ramp = np.linspace(-1.0, 1.0, samples)
    return np.column_stack([np.ones(samples), *(ramp * (recording == k) for k in range(2))])


def with_errors(rows: list[np.ndarray], measured: list[np.ndarray]) -> np.ndarray:
    """Values of y = A [a, b] + E [z, d1, d2] with the beliefs in b, and in z and d of the noise, by the normal
    equations."""
    unit = NOISE.std * LEVEL
    whole = np.concatenate([np.column_stack([r, errors(k, len(r))]) for k, r in enumerate(rows)])
    a, y = whole / unit, np.concatenate(measured) / unit
    belief = np.diag([0.0, 1 / BELIEF.sigma**2, *3 * [1 / NOISE.std**2]])
    return np.linalg.solve(a.T @ a + belief, a.T @ y + belief @ [0.0, BELIEF.centre, 0.0, 0.0, 0.0])


def test_of_outputs_linear_in_the_parameters_it_is_exact(data: tuple) -> None:
    rows, measured = data
    found, values = beside_zeros(linear_fit(rows, measured)), with_errors(rows, measured)
    assert found.estimate.values == pytest.approx([*values[:2], *values[2:] / NOISE.std], abs=1e-9)
    for k, (a, y) in enumerate(zip(rows, measured, strict=True)):
        left = y - a @ values[:2] - errors(k, len(y)) @ values[2:]
        assert found.residuals[f"r{k}"]["y"] == pytest.approx(left, abs=1e-10)
    parts = np.concatenate([r["y"] for r in found.residuals.values()]) / (NOISE.std * LEVEL)
    pulls = [(values[1] - BELIEF.centre) / BELIEF.sigma, *values[2:] / NOISE.std]
    assert found.estimate.data_cost == pytest.approx(parts @ parts)
    assert found.estimate.cost == pytest.approx(parts @ parts + np.dot(pulls, pulls))


def test_what_stood_for_a_zero_is_left_with_nothing(data: tuple) -> None:
    plain = linear_fit(*data)
    found = beside_zeros(plain)
    errors = np.sqrt(np.diag(found.estimate.covariance()))
    assert plain.estimate.values[0] == pytest.approx(ZERO, rel=0.2)
    assert abs(found.estimate.values[0]) < 3 * errors[0]


def test_a_fit_without_a_jacobian_stays_as_it_is(data: tuple) -> None:
    plain = linear_fit(*data)
    estimate = plain.estimate
    bare = replace(plain, estimate=replace(estimate, jacobian=[]))
    assert isinstance(estimate, Estimate)
    assert beside_zeros(bare) is bare
