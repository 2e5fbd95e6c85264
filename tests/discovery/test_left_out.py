"""What a fit says of recordings left out is what a fit without them says."""

from __future__ import annotations

import numpy as np
import pytest

from lacuna.discovery.case.noise import Noise
from lacuna.discovery.fit.fit import Fit
from lacuna.discovery.fit.solver.free import Free
from lacuna.discovery.fit.solver.least_squares import Estimate
from lacuna.discovery.naming.left_out import STRETCHES, left_out_residuals

NOISE, LEVEL = Noise(0.1, 0.0, True), 3.0
BELIEF = Free("b", 2.0, 0.5, sigma=0.5)
FREE = [Free("a", 0.0, 10.0), BELIEF]


def solved(rows: list[np.ndarray], measured: list[np.ndarray]) -> np.ndarray:
    """Values (p,) of y = A [a, b] with the belief in b, by the normal equations."""
    unit = NOISE.std * LEVEL
    a, y = np.concatenate(rows) / unit, np.concatenate(measured) / unit
    belief = np.diag([0.0, 1 / BELIEF.sigma**2])
    return np.linalg.solve(a.T @ a + belief, a.T @ y + belief @ [0.0, BELIEF.centre])


def linear_fit(rows: list[np.ndarray], measured: list[np.ndarray]) -> Fit:
    values, scale, unit = solved(rows, measured), np.array([f.scale for f in FREE]), NOISE.std * LEVEL
    jacobian = [-a * scale / unit for a in rows]
    left = [y - a @ values for a, y in zip(rows, measured, strict=True)]
    normal = sum(j.T @ j for j in jacobian) + np.diag([0.0, (BELIEF.scale / BELIEF.sigma) ** 2])
    residuals = [r / unit for r in left]
    estimate = Estimate(FREE, values, 0.0, 0.0, 0.0, residuals, normal, True, 1, 0, jacobian)
    named = {f"r{k}": {"y": r} for k, r in enumerate(left)}
    weights = {n: {"y": np.ones(len(c["y"]))} for n, c in named.items()}
    return Fit(None, estimate, {"y": LEVEL}, named, weights, {"y": NOISE}, 0)


@pytest.fixture
def data() -> tuple[list[np.ndarray], list[np.ndarray]]:
    rng = np.random.default_rng(5)
    rows = [rng.standard_normal((40, 2)) for _ in range(3)]
    return rows, [a @ [4.0, 2.3] + 0.3 * rng.standard_normal(40) for a in rows]


def test_of_outputs_linear_in_the_parameters_it_is_exact(data: tuple) -> None:
    rows, measured = data
    told = left_out_residuals(linear_fit(rows, measured))
    for k in range(3):
        others = [j for j in range(3) if j != k]
        values = solved([rows[j] for j in others], [measured[j] for j in others])
        assert told[f"r{k}"]["y"] == pytest.approx(measured[k] - rows[k] @ values, abs=1e-10)


def test_the_only_recording_is_left_out_in_stretches(data: tuple) -> None:
    rows, measured = data[0][0], data[1][0]
    told = left_out_residuals(linear_fit([rows], [measured]))["r0"]["y"]
    for piece in np.array_split(np.arange(40), STRETCHES):
        rest = np.setdiff1d(np.arange(40), piece)
        values = solved([rows[rest]], [measured[rest]])
        assert told[piece] == pytest.approx(measured[piece] - rows[piece] @ values, abs=1e-10)


def test_what_only_one_recording_tells_stays_where_that_recording_puts_it(data: tuple) -> None:
    rows, measured = [a.copy() for a in data[0]], data[1]
    for a, y in zip(rows[1:], measured[1:], strict=True):
        y -= a[:, 0] * 4.0
        a[:, 0] = 0.0
    told = left_out_residuals(linear_fit(rows, measured))
    near = measured[0] - rows[0] @ solved(rows, measured)
    assert np.std(told["r0"]["y"]) < 1.1 * np.std(near)  # without the cut the step is of the size of the signal
