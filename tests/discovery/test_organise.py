"""The variable that organises an effort, on efforts with a known one."""

import numpy as np
import pytest

from lacuna.discovery.law.organise import organiser

time = np.linspace(0.0, 4.0, 4000)
speed = 20.0 * np.sin(4.0 * time)
angle = 5.0 * (1.0 - np.cos(4.0 * time)) + 3.0 * time
noise = 0.02 * np.random.default_rng(1).standard_normal(len(time))
VARIABLES = {
    "shaft.w": ("rad/s", speed), "shaft.phi": ("rad", angle), "current": ("A", np.cos(9.0 * time)), "time": ("s", time)
}  # fmt: skip

CASES = [
    (np.sign(speed), "shaft.w", "sign"),
    (speed * np.abs(speed) / 400.0, "shaft.w", "value"),
    (np.cos(6 * angle + 0.4), "shaft.phi", "orders"),
    (np.cos(9.0 * time) ** 2, "current", "value"),
    (np.exp(-time), "time", "value"),
]


@pytest.mark.parametrize(("effort", "variable", "kind"), CASES)
def test_the_variable_that_an_effort_follows_is_found(effort: np.ndarray, variable: str, kind: str) -> None:
    found = organiser(effort + noise, VARIABLES, {"shaft.phi"})
    assert (found.variable, found.kind) == (variable, kind)
    assert found.share > 0.9


def test_the_strongest_order_is_the_effort_s() -> None:
    found = organiser(np.cos(6 * angle) + noise, VARIABLES, {"shaft.phi"})
    assert found.centres[np.argmax(found.means)] == 6
