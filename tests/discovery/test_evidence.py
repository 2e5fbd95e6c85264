"""What passes for noise: white, or of a colour of its own; and what does not."""

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.signal import lfilter

from lacuna.discovery.case.noise import Noise, sample_weights
from lacuna.discovery.fit.evidence import common_correlation, holds, is_noise, like_noise, pays, repeats, whiteness
from lacuna.discovery.fit.fit import Fit
from lacuna.discovery.fit.solver.least_squares import Estimate

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


@pytest.mark.parametrize(
    ("level", "given", "passes"), [(1.07, True, True), (1.12, True, False), (1.3, False, True), (1.4, False, False)]
)
def test_white_noise_passes_up_to_the_level_that_is_known(level: float, given: bool, passes: bool) -> None:
    """A level that is given counts as known within 4 %, one that was estimated within 30 %; beyond that five standard
    errors of 8000 samples' mean square let 4 % more pass."""
    found = fit(level * white / white.std(), 1.0, given)
    assert whiteness(found)["i"].passed == is_noise(found) == passes


def test_a_misfit_too_small_for_one_sample_shows_in_the_means_of_many() -> None:
    """A quarter of the noise, over 200 samples: 3.5 standard deviations of each mean."""
    wave = 0.25 * np.sign(np.sin(np.arange(N) * np.pi / 200))
    found = whiteness(fit(white / white.std() + wave, 1.0, True))["i"]
    assert found.block == 200 and found.ratio == pytest.approx(1 + 200 * 0.25**2, rel=0.25) and not found.passed
    assert whiteness(fit(white / white.std() + wave, 1.0, True), slack=0.3)["i"].passed


@pytest.mark.parametrize(("unseen", "given", "passes"), [(1.05, True, True), (3.0, True, False), (3.0, False, True)])
def test_what_fits_holds_only_if_unseen_recordings_are_noise_too(unseen: float, given: bool, passes: bool) -> None:
    floor = {"i": 0.02, "w": 0.01}
    noise = {"i": Noise(1.0, 0.0, True), "w": Noise(1.0, 0.0, given)}
    judged = {"": 0.02, "i": 0.02, "w": 0.01 * unseen}
    assert holds(judged, floor, noise) == passes


@pytest.mark.parametrize(("times", "memory", "given", "passes"), [
    (1.15, 1, False, True), (3.0, 1, False, False), (1.15, 1, True, True), (1.25, 1, True, False),
    (1.4, 400, False, True), (1.4, 400, True, False), (3.0, 400, False, False),
])  # fmt: skip
def test_noise_of_an_unknown_level_leaves_as_much_in_unseen_recordings(
    times: float, memory: int, given: bool, passes: bool
) -> None:
    """Its level is what the fit leaves: more elsewhere is physics, but for the scatter of few independent samples."""
    noise = {"i": Noise(1.0, 0.0, given)}
    found = SimpleNamespace(noise=noise, counts=lambda: {"i": N}, correlation=lambda: {"i": memory})
    assert repeats({"i": times * 0.03}, {"i": 0.03}, found, N) == passes


def encoder(angle: np.ndarray) -> SimpleNamespace:
    """The fit of an angle that is known exactly to its reading with a resolution of one."""
    reading = np.round(angle)
    noise = {"theta": Noise(12**-0.5, 1.0, True)}
    weights = {"r": {"theta": sample_weights(reading, noise["theta"])}}
    return SimpleNamespace(noise=noise, residuals={"r": {"theta": reading - angle}}, weights=weights)


@pytest.mark.parametrize(("rest", "passes"), [(0.45, True), (0.9, False)])
def test_a_shaft_at_rest_makes_one_rounding_error_however_long(rest: float, passes: bool) -> None:
    """Of a resolution's width, half is rounding; a rest that is further away than that is a misfit."""
    moving = 7.3 * np.sin(np.arange(N) / 90.0) ** 2
    fitted = encoder(np.concatenate([moving, np.full(300, 20.0 + rest), moving]))
    if not passes:
        fitted.residuals["r"]["theta"][N : N + 300] += 20.0
    assert all(w.passed for w in whiteness(fitted).values()) == passes


def test_rounding_may_err_by_half_a_step_where_nothing_moves() -> None:
    floor = {"theta": 1e-5}
    for times, passes in ((1.7, True), (1.8, False)):
        assert holds({"": 0.0, "theta": times * 1e-5}, floor, {"theta": Noise(12**-0.5, 1.0, True)}) == passes
    assert not holds({"": 0.0, "theta": 1.7e-5}, floor, {"theta": Noise(1.0, 1.0, True)})


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


def whole_fit(residuals: dict[str, np.ndarray]) -> Fit:
    noise = {c: Noise(1.0, 0.0, True) for c in residuals}
    estimate = Estimate([], np.zeros(0), 0.0, 0.0, 0.0, [], np.zeros((0, 0)), True, 1, 0, [])
    return Fit(None, estimate, dict.fromkeys(noise, 1.0), {"r": residuals}, {"r": dict.fromkeys(noise, np.ones(N))},
               noise, 0)  # fmt: skip


def test_fits_are_compared_by_the_colour_of_the_better_one() -> None:
    """One leaves noise in both signals but for a little; the other, which explains that little, leaves all of a slow
    course in one of them: by its own colour that course hardly counts, and what it explains is worth more."""
    slow = 3.0 * np.sin(np.linspace(0.0, 20.0, N))
    better = whole_fit({"theta": white, "w": 1.1 * white})
    poorer = whole_fit({"theta": white + slow, "w": white})
    own = poorer.correlation()
    assert poorer.deviance(own) < better.deviance(own)
    common = common_correlation([poorer, better])
    assert common == better.correlation()
    assert better.deviance(common) < poorer.deviance(common)
