"""Sensitivities around the end of a fit, where short differences are mostly noise."""

from dataclasses import dataclass

import numpy as np
import pytest

from lacuna.discovery.fit import secants
from lacuna.discovery.fit.solver.free import Free
from lacuna.discovery.fit.solver.least_squares import Estimate, Problem, solve

PHASES = np.random.default_rng(0).uniform(0, 2 * np.pi, 200)
FREE = [Free("a", 1.0, 1.0, step=1e-6), Free("b", 1.0, 1.0, step=1e-6)]


@dataclass
class End:
    estimate: Estimate
    machine: None = None
    zeroed: None = None


def outputs(values: dict[str, float], piece: int) -> np.ndarray:
    """The sum of two parameters seen well, their difference hardly, and both with the noise of a solver's steps."""
    total, difference = values["a"] + values["b"] - 2.0, values["a"] - values["b"]
    rough = 1e-5 * np.sin(1e7 * total + PHASES) + 1e-5 * np.sin(1e7 * difference + PHASES)
    return np.where(np.arange(200) < 100, 100.0 * total, 0.1 * difference) + rough


def test_what_noise_adds_to_short_differences_is_no_information(monkeypatch: pytest.MonkeyPatch) -> None:
    problem = Problem(FREE, outputs, 1)
    found = End(solve(problem))
    monkeypatch.setattr(secants, "_around", lambda found, machine: (problem, []))
    known = 100 * 0.1**2 * 2  # 100 samples that see 0.1 of the difference, which is sqrt(2) a unit along it

    def of_difference(estimate: Estimate) -> float:
        direction = np.array([1.0, -1.0]) / np.sqrt(2)
        return float(direction @ estimate.normal @ direction)

    assert of_difference(found.estimate) > 10 * known
    assert of_difference(secants.with_secants(found).estimate) == pytest.approx(known, rel=0.02)
