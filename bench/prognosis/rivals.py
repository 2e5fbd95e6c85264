"""What the forecasts are held against: a straight line through the severities, and progpy's particle filter told the
law."""

from __future__ import annotations

from functools import cache

import numpy as np

SAMPLES = 1000
NEVER = 1e6


def straight_line(use: np.ndarray, severity: np.ndarray, limit: float, seed: int) -> np.ndarray:
    """[SAMPLES] remaining use: least squares through all severities, slope and level by their Student distribution."""
    n = len(use)
    if n < 3:
        return np.full(SAMPLES, NEVER * max(use[-1] if n else 1.0, 1.0))
    random, centre = np.random.default_rng(seed), use.mean()
    u = use - centre
    slope = (u * severity).sum() / (u * u).sum()
    level = severity.mean()
    residual = severity - level - slope * u
    variance = (residual**2).sum() / (n - 2)
    t = random.standard_t(n - 2, (2, SAMPLES))
    slopes = slope + t[0] * np.sqrt(variance / (u * u).sum())
    levels = level + t[1] * np.sqrt(variance / n)
    span = use[-1] - centre
    left = (limit - levels) / np.where(slopes > 0, slopes, np.nan) - span
    return np.where(np.isnan(left), NEVER * span, np.maximum(left, 0))


@cache
def progpy_version() -> str:
    """Of the installed progpy, empty where there is none, or an earlier one than 1.9."""
    try:
        import progpy
    except ImportError:
        return ""
    version = str(progpy.__version__)
    return version if tuple(int(p) for p in version.split(".")[:2]) >= (1, 9) else ""


def progpy_model(growth, wander: float, diffusion: float, scale: float):
    """der(x) = exp(l) growth(x) for progpy, vectorised; l wanders. `scale`: use of one life, for the process noise."""
    import progpy

    class Wear(progpy.PrognosticsModel):
        inputs: list = []  # noqa: RUF012
        states = ["x", "l"]  # noqa: RUF012
        outputs = ["y"]  # noqa: RUF012
        events = ["limit"]  # noqa: RUF012
        is_vectorized = True
        default_parameters = {"process_noise": 0, "measurement_noise": 0}  # noqa: RUF012

        def next_state(self, state, _inputs, dt):
            random = self.parameters["random"]
            x, steps = np.asarray(state["x"], dtype=float), 8
            rate = np.exp(np.asarray(state["l"], dtype=float)) * dt / steps
            before = x
            for _ in range(steps):
                half = x + rate / 2 * growth(np.maximum(x, 1e-4))
                x = x + rate * growth(np.maximum(half, 1e-4))
            x = np.clip(x, -1, 5)
            x = x + diffusion * np.sqrt(np.maximum(x - before, 0)) * random.standard_normal(x.shape)
            drift = wander * np.sqrt(dt / scale) * random.standard_normal(x.shape)
            return self.StateContainer({"x": x, "l": np.asarray(state["l"]) + drift})

        def output(self, state):
            return self.OutputContainer({"y": np.asarray(state["x"])})

        def event_state(self, state):
            return {"limit": 1 - np.asarray(state["x"])}

        def threshold_met(self, state):
            return {"limit": np.asarray(state["x"]) >= 1}

    return Wear


def progpy_filter(growth, particles, random, *, wander: float, diffusion: float, scale: float):
    """progpy's ParticleFilter with `particles` {"x", "l"} as its first belief.

    Its default, filterpy's residual_resample, fails the Kalman check (version 2.0.0 draws the remainders wrongly: the
    posterior is four times too narrow after five tests); with systematic_resample, which it allows, it passes.
    """
    from filterpy.monte_carlo import systematic_resample
    from progpy.state_estimators import ParticleFilter
    from progpy.uncertain_data import UnweightedSamples

    model = progpy_model(growth, wander, diffusion, scale)(random=random)
    first = UnweightedSamples([{"x": x, "l": rate} for x, rate in zip(particles["x"], particles["l"], strict=True)])
    return model, ParticleFilter(model, first, num_particles=len(particles["x"]), measurement_noise={"y": 0.05},
                                 resample_fcn=systematic_resample)  # fmt: skip


def kalman_check(seed: int = 1, count: int = 5000) -> tuple[float, float]:
    """(largest error of progpy's mean, in standard deviations of the exact posterior; of its standard deviation,
    relative) over 20 tests of a Wiener process with drift, against the Kalman filter."""
    random = np.random.default_rng(seed)
    np.random.seed(seed)  # noqa: NPY002 - progpy resamples by the global generator
    rate, diffusion, noise = 0.02, 0.05, 0.05
    particles = {"x": 0.2 + 0.1 * random.standard_normal(count), "l": np.full(count, np.log(rate))}
    _, estimator = progpy_filter(lambda x: np.ones_like(x), particles, random, wander=0, diffusion=diffusion, scale=1)
    mean, variance, x = 0.2, 0.01, 0.2
    worst = [0.0, 0.0]
    for k in range(1, 21):
        x += rate + diffusion * np.sqrt(rate) * random.standard_normal()
        y = x + noise * random.standard_normal()
        estimator.estimate(float(k), {}, {"y": y}, dt=1.0)
        mean, variance = mean + rate, variance + diffusion**2 * rate
        gain = variance / (variance + noise**2)
        mean, variance = mean + gain * (y - mean), (1 - gain) * variance
        found = np.asarray(estimator.particles["x"], dtype=float)
        worst[0] = max(worst[0], abs(found.mean() - mean) / np.sqrt(variance))
        worst[1] = max(worst[1], abs(found.std() / np.sqrt(variance) - 1))
    return worst[0], worst[1]


def progpy_remaining(growth, use, severity, sd, interval: float, at: list[int], seed: int, count: int = 500):
    """{test: [count] remaining use} after the tests `at`, of parts told the law and its shape.

    The first belief is that of our filter: severity by the first test, a life of some tens of tests.
    """
    random = np.random.default_rng(seed)
    np.random.seed(seed)  # noqa: NPY002
    grid = np.geomspace(1e-3, 1.0, 400)
    age = np.concatenate([[0.0], np.cumsum(np.diff(grid) / growth((grid[1:] + grid[:-1]) / 2))])
    life = age[-1] - np.interp(0.05, grid, age)
    x = severity[0] + sd[0] * random.standard_normal(count)
    rate = np.log(life / (60 * interval)) + random.standard_normal(count)
    _, estimator = progpy_filter(growth, {"x": x, "l": rate}, random, wander=0.15, diffusion=0.02, scale=60 * interval)
    result = {}
    for k in range(1, len(use)):
        estimator.parameters["measurement_noise"] = {"y": float(sd[k])}
        step = float(use[k] - use[k - 1])
        estimator.estimate(float(use[k] - use[0]), {}, {"y": float(severity[k])}, dt=step)
        if k in at:
            x = np.asarray(estimator.particles["x"], dtype=float)
            rates = np.exp(np.asarray(estimator.particles["l"], dtype=float))
            ahead = np.maximum(age[-1] - np.interp(np.clip(x, 1e-3, 1.0), grid, age), 0) / rates
            result[k] = np.where(x >= 1, 0.0, ahead * np.exp(0.15 * np.sqrt(1 / 3) * random.standard_normal(count)))
    return result
