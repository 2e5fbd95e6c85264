"""What passes for noise: white, or of a colour of its own; and what does not."""

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.signal import lfilter

from discovery.evidence import holds, like_noise, pays
from discovery.noise import Noise

N = 8000
white = np.random.default_rng(3).standard_normal(N)
coloured = lfilter([0.5], [1.0, -0.85], white)  # its third differences show about a third of its level
bursts = np.where(np.arange(N) % 40 == 0, 6.0 * white, 0.0)  # at the edges of a current, say


def fit(residual: np.ndarray, std: float, given: bool) -> SimpleNamespace:
    noise = {"i": Noise(std, 0.0, given)}
    return SimpleNamespace(noise=noise, residuals={"r": {"i": residual}}, weights={"r": {"i": np.ones(N)}})


@pytest.mark.parametrize(
    ("residual", "std", "given", "passes"),
    [
        (white, 1.0, True, True),
        (white, 0.3, False, True),
        (coloured, 0.3, False, True),
        (coloured, np.std(coloured), True, True),
        (0.3 * white + bursts, 0.3, False, False),
        (white, 0.1, False, False),
        (white, 0.5, True, False),
        (np.cumsum(white) / 50, 0.3, False, False),
    ],
)
def test_noise_may_have_a_colour_but_no_bursts_and_no_drift(
    residual: np.ndarray, std: float, given: bool, passes: bool
) -> None:
    assert like_noise(fit(residual, std, given)) == passes


@pytest.mark.parametrize(("unseen", "given", "passes"), [(1.05, True, True), (3.0, True, False), (3.0, False, True)])
def test_what_fits_holds_only_if_unseen_recordings_are_noise_too(unseen: float, given: bool, passes: bool) -> None:
    floor = {"i": 0.02, "w": 0.01}
    noise = {"i": Noise(1.0, 0.0, True), "w": Noise(1.0, 0.0, given)}
    judged = {"": 0.02, "i": 0.02, "w": 0.01 * unseen}
    assert holds(judged, floor, noise) == passes


@pytest.mark.parametrize(
    ("current", "angle", "worth"),
    [
        (0.41, 0.001, True),  # the angle is explained, while the current rules the NRMSE of the case
        (0.41, 0.065, False),
        (0.43, 0.001, False),  # what is won on one signal is lost on the other
        (0.20, 0.070, True),
    ],
)
def test_a_model_pays_that_explains_one_signal_of_several(current: float, angle: float, worth: bool) -> None:
    def judged(i: float, theta: float) -> dict[str, float]:
        return {"": float(np.hypot(i, theta) / np.sqrt(2)), "i": i, "theta": theta}

    assert pays(judged(0.411, 0.07), judged(current, angle), {"i": 0.05, "theta": 0.001}) == worth
