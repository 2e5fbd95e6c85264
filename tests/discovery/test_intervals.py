"""Standard errors against the scatter of estimates from data that are made many times."""

from types import SimpleNamespace

import numpy as np
import pytest

from discovery.intervals import covariance
from discovery.least_squares import Free, Problem, solve
from discovery.noise import Noise, sample_weights

CYCLE = 9.3 * (1.0 + np.sin(2 * np.pi * np.arange(20) / 20))
PERIODIC = np.tile(CYCLE, 30)  # the same angles, and their rounding, again and again
UNSTEADY = PERIODIC * (1.0 + 0.3 * np.sin(0.01 * np.arange(600)))


def fitted(measured: np.ndarray, shape: np.ndarray, noise: Noise) -> SimpleNamespace:
    """The fit of the angle's factor, `slope`, to a recorded angle."""
    weights = sample_weights(measured, noise)
    free = [Free("slope", 1.0, 0.1), Free("unseen", 0.0, 1.0)]
    problem = Problem(free, lambda values, _: (measured - values["slope"] * shape) * weights / noise.std, 1)
    estimate = solve(problem)
    residual = {"angle": measured - estimate["slope"] * shape}
    return SimpleNamespace(
        estimate=estimate, noise={"angle": noise}, level={"angle": 1.0}, weights={"r": {"angle": weights}},
        residuals={"r": residual}, correlation=lambda: {"angle": 1.0},
        machine=SimpleNamespace(case=SimpleNamespace(fit=[SimpleNamespace(name="r", columns={"angle": measured})])),
    )  # fmt: skip


@pytest.mark.parametrize(("shape", "repeats"), [(UNSTEADY, False), (PERIODIC, True)], ids=["unsteady", "periodic"])
def test_rounding_that_repeats_widens_an_interval(shape: np.ndarray, repeats: bool) -> None:
    """An encoder's levels lie anywhere: so do the estimates, and their scatter is the standard error."""
    noise = Noise(1.0 / np.sqrt(12), 1.0, True)
    fits = [fitted(np.round(shape + place) - place, shape, noise) for place in np.random.default_rng(0).random(400)]
    scatter = float(np.sqrt(np.mean([(f.estimate["slope"] - 1.0) ** 2 for f in fits])))
    errors = np.array([np.sqrt(np.diag(covariance(f))) for f in fits])
    said = errors[:, 0]
    as_noise = np.array([f.estimate.normal[0, 0] ** -0.5 * f.estimate.free[0].scale for f in fits])
    assert 0.8 < np.median(said) / scatter < 1.5  # the larger of what rounding gives and of what white noise would
    assert np.all(errors[:, 1] == 0.0)  # unseen
    assert bool(np.median(as_noise) < 0.5 * scatter) is repeats
