"""What the forecasts are held against: a straight line through the severities, and progpy's particle filter told the
law."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np

from bench.prognosis import truth

SAMPLES = 1000
NEVER = 1e6
PARTICLES = 2000  # of progpy's filter: 500 are too few where the shape is one of its states


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


def progpy_model(growth, shapes: int, wander: float, diffusion: float, scale: float):
    """der(x) = exp(l) growth(x, shapes) for progpy, vectorised; l wanders, `shapes` unknown constants are states as
    well. `scale`: use of one life, for the process noise."""
    import progpy

    constants = [f"shape{k}" for k in range(shapes)]

    class Wear(progpy.PrognosticsModel):
        inputs: list = []  # noqa: RUF012
        states = ["x", "l", *constants]  # noqa: RUF012
        outputs = ["y"]  # noqa: RUF012
        events = ["limit"]  # noqa: RUF012
        is_vectorized = True
        default_parameters = {"process_noise": 0, "measurement_noise": 0}  # noqa: RUF012

        def next_state(self, state, _inputs, dt):
            random = self.parameters["random"]
            x, steps = np.asarray(state["x"], dtype=float), 8
            own = {name: np.asarray(state[name], dtype=float) for name in constants}
            rate = np.exp(np.asarray(state["l"], dtype=float)) * dt / steps
            before = x
            for _ in range(steps):
                half = x + rate / 2 * growth(np.maximum(x, 1e-4), *own.values())
                x = x + rate * growth(np.maximum(half, 1e-4), *own.values())
            x = np.clip(x, -1, 5)
            x = x + diffusion * np.sqrt(np.maximum(x - before, 0)) * random.standard_normal(x.shape)
            drift = wander * np.sqrt(dt / scale) * random.standard_normal(x.shape)
            return self.StateContainer({"x": x, "l": np.asarray(state["l"]) + drift, **own})

        def output(self, state):
            return self.OutputContainer({"y": np.asarray(state["x"])})

        def event_state(self, state):
            return {"limit": 1 - np.asarray(state["x"])}

        def threshold_met(self, state):
            return {"limit": np.asarray(state["x"]) >= 1}

    return Wear


def progpy_filter(growth, particles: dict[str, np.ndarray], random, *, wander: float, diffusion: float, scale: float):
    """progpy's ParticleFilter with `particles` {"x", "l", "shape0", ...} as its first belief.

    Its default, filterpy's residual_resample, fails the Kalman check (version 2.0.0 draws the remainders wrongly: the
    posterior is four times too narrow after five tests); with systematic_resample, which it allows, it passes.
    """
    from filterpy.monte_carlo import systematic_resample
    from progpy.state_estimators import ParticleFilter
    from progpy.uncertain_data import UnweightedSamples

    model = progpy_model(growth, len(particles) - 2, wander, diffusion, scale)(random=random)
    rows = zip(*particles.values(), strict=True)
    first = UnweightedSamples([dict(zip(particles, row, strict=True)) for row in rows])
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


@dataclass(frozen=True)
class Tests:
    """Tests of a part that were read: use, severity as a share of the limit, its standard deviation; `interval` is the
    usual use between tests."""

    use: np.ndarray
    severity: np.ndarray
    sd: np.ndarray
    interval: float


def progpy_remaining(law: str, shape, tests: Tests, at: list[int], seed: int) -> dict[int, np.ndarray]:
    """{test: [particles] remaining use} after the tests `at`, of parts told the law; `shape` as well, or None.

    The first belief is that of our filter: severity by the first test, a life of some tens of tests. A shape that it is
    not told is a constant among its states, drawn from where the fleet draws it.
    """
    random, count = np.random.default_rng(seed), PARTICLES
    np.random.seed(seed)  # noqa: NPY002
    told = shape if shape is not None else ()
    drawn = [random.uniform(*b, count) for b in truth.SHAPES.get(law, ())] if shape is None else []

    def growth(x, *own):
        return truth.growth(law, x, *told, *own)

    nominal = _age(growth, np.array([np.median(values) for values in drawn]).reshape(-1, 1))
    x = tests.severity[0] + tests.sd[0] * random.standard_normal(count)
    rate = np.log(nominal(0.05)[0] / (60 * tests.interval)) + random.standard_normal(count)
    first = {"x": x, "l": rate} | {f"shape{k}": values for k, values in enumerate(drawn)}
    _, estimator = progpy_filter(growth, first, random, wander=0.15, diffusion=0.02, scale=60 * tests.interval)
    result = {}
    for k in range(1, len(tests.use)):
        estimator.parameters["measurement_noise"] = {"y": float(tests.sd[k])}
        step = float(tests.use[k] - tests.use[k - 1])
        estimator.estimate(float(tests.use[k] - tests.use[0]), {}, {"y": float(tests.severity[k])}, dt=step)
        if k in at:
            now = {name: np.asarray(estimator.particles[name], dtype=float) for name in first}
            own = np.array([now[name] for name in list(first)[2:]]).reshape(len(drawn), count)
            ahead = _age(growth, own)(np.clip(now["x"], 1e-3, 1.0)) / np.exp(now["l"])
            noise = np.exp(0.15 * np.sqrt(1 / 3) * random.standard_normal(count))
            result[k] = np.where(now["x"] >= 1, 0.0, ahead * noise)
    return result


def _age(growth, shape: np.ndarray):
    """Of particles with shapes [shapes, n]: the age that is left from severities x (a number, or [n]) to the limit."""

    def left(x):
        grid = np.reshape(x, (-1, 1)) ** np.linspace(1, 0, 200)
        middle = (grid[:, 1:] + grid[:, :-1]) / 2
        return (np.diff(grid, axis=1) / growth(middle, *shape[:, :, None])).sum(axis=1)

    return left
