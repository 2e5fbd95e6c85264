"""The constants of the filter, each with its reason. Severities are shares of the limit, times are counted in tests."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class FilterSettings:
    """What is believed of any actuator before its history is read.

    `lives`: shortest and longest life, in intervals between tests. `life`, `life_spread`: its median, and the standard
        deviation of its logarithm. A schedule of tests is made so that a life is some tens of them, 8 to 430 with 95
        %; counted in tests, no unit of time is favoured. A fleet replaces this prior by its own (`fleet_prior`).
    `tile`: the prior of ln rate is a row of Gaussians this far apart and half as wide, so that each is nearly linear.
    `first`: mean and standard deviation of the severity before the first test: anything that a map can show.
    `noises`: (share, factor of wander, factor of diffusion, whether the rate may change abruptly) of the law's own
        process
        noise, each tried, and none preferred: calmer than declared, as declared, and rougher, factors of two or so
        apart. The roughest stands for a law that the catalogue lacks. Only where the noise is rough can a change be
        merged into one Gaussian without spoiling what is known of a steady rate.
    `commons`: share of an assessment's variance that all tests of one actuator have in common (its own inertia and
        friction, say) and that the trend cannot show; each tried, and told by how much less than stated the tests
        scatter. The tests of docs/robustness.md scatter about an actuator's own mean with 0.25 to 0.7 of the stated
        variance from half of the limit on: these are the two ends. At small severities it is less than a tenth, which
        only a fleet can tell (scatter.py): its tests' scatter takes the place of the stated errors, and these two
        stand for parts that scatter less or more than the fleet's mean.
    `wide`, `wide_scale`: share of tests with an error of so many of the assessment's own standard deviations.
    `outlier`, `outlier_range`: share of tests that say nothing, spread over so many limits.
    `change`, `change_size`: probability a test that the rate changes abruptly (duty, lubrication: about once in two
        lives), and the standard deviation of its logarithm then.
    `actuators`: how many of a fleet this prior is worth, against what the fleet itself says.
    `floor`: least standard deviation of an assessment.
    """

    lives: tuple[float, float] = (3.0, 3000.0)
    life: float = 60.0
    life_spread: float = 1.0
    tile: float = float(np.log(2.0))
    first: tuple[float, float] = (0.25, 0.5)
    noises: tuple[tuple[float, float, float, float], ...] = (
        (0.25, 0.5, 0.5, 0.0),
        (0.25, 1.0, 1.0, 0.0),
        (0.25, 2.5, 1.5, 0.0),
        (0.25, 4.0, 3.0, 1.0),
    )
    commons: tuple[float, ...] = (0.3, 0.75)
    wide: float = 0.05
    wide_scale: float = 3.5
    outlier: float = 0.02
    outlier_range: float = 1.5
    change: float = 0.008
    change_size: float = 0.7
    actuators: float = 10.0
    floor: float = 1e-3


DEFAULT = FilterSettings()
