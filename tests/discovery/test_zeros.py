"""A fit beside errors of the sensors' zeros, and their drifts, is the fit that has them among its parameters."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from lacuna.discovery.case.cases import load
from lacuna.discovery.explain import explain
from lacuna.discovery.fit.solver.least_squares import Estimate
from lacuna.discovery.fit.zeros import beside_zeros
from tests.discovery.recorded import TANK, concealed, record
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


CASE = """model = "Tank.mo"
[parameters]
A = 0.01
k = 3e-4
[uncertainty]
A = 0.05
k = 0.003
[signals.q]
role = "input"
variable = "q"
unit = "m3/s"
[signals.h]
role = "output"
variable = "h"
unit = "m"
noise_std = 0.005
[recordings]
fit = ["r0.csv", "r1.csv"]
validate = ["r2.csv"]
"""


def test_a_parameter_that_would_only_stand_for_a_zero_is_as_it_was_believed(tmp_path: Path) -> None:
    """The outlet is known to 0.3 per cent; the zero of the level, of 0.6 of its noise, would move it by four times
    that."""
    text = TANK.format(outflow="k*h")
    folder, machine = concealed(tmp_path, "Tank", text, text, CASE)
    rng, time = np.random.default_rng(3), np.linspace(0.0, 300.0, 1501)
    for n, swing in enumerate((0.5, 0.8, 0.3)):
        q = 6e-5 * (1 + swing * np.sin(2 * np.pi * time / (60.0 + 25 * n)))
        error = 0.003 + 0.005 * rng.standard_normal(len(time))
        record(folder / f"r{n}.csv", machine, time, {"q": q}, {"h": "h"}, {"h": error})
    found = explain(load(folder))
    assert found.verdict == "consistent"
    errors = found.errors()
    assert found.final.point["k"] == pytest.approx(3e-4, abs=3 * errors["k"])
    assert 0.3 * 0.003 < errors["k"] / 3e-4 < 1.05 * 0.003  # the zero leaves hardly more than the belief
