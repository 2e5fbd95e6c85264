"""What depends on the way back and forth, and not on how fast it goes: bristles that bend, as ropes and rubber do."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from lacuna.discovery.case.cases import load
from lacuna.discovery.explain import explain
from lacuna.discovery.law.terms.courses import bent

from .recorded import concealed, record
from .test_sensors import CART, CASE


def test_bristles_bend_as_their_equation_says_whatever_the_speed() -> None:
    """Between samples the way is taken to be straight: off by the square of their distance."""
    fine = np.linspace(0.0, 3.0, 6001)
    speed = np.sin(7 * fine) + 0.4 * np.sin(17 * fine)
    exact = solve_ivp(
        lambda t, z: (np.interp(t, fine, speed) * (1 - np.sign(np.interp(t, fine, speed)) * z)) / 0.03,
        (0.0, 3.0), [0.0], t_eval=fine, rtol=1e-8, atol=1e-10, max_step=1e-3,
    ).y[0]  # fmt: skip
    found = bent(fine, speed, 0.03)
    np.testing.assert_allclose(found, exact, atol=2e-4)
    assert 0.9 < np.abs(found).max() < 1.0
    np.testing.assert_allclose(bent(fine / 2, 2 * speed, 0.03), found, atol=1e-12)


def test_the_hysteresis_of_a_rope_is_found_with_its_reach(tmp_path: Path) -> None:
    """A force of 0.8 N that needs 20 mm of way to turn round, where moves go over some 10 to 300 mm."""
    rope = CART.replace("equation", "  Real z(start=0, fixed=true);\nequation\n  0.02*der(z) = v - abs(v)*z;", 1)
    rope = rope.replace("- c*x;", "- c*x - 0.8*z;")
    assert rope.count("0.8*z") == 1
    case, machine = concealed(tmp_path, "Cart", rope, CART, CASE.replace('interpolation = "hold"\n', ""))
    random, time = np.random.default_rng(5), 0.05 * np.arange(600)
    for n in (1, 2, 3):
        force = np.repeat(random.uniform(-6, 6, 12), 50) + 2 * np.sin(3 * time)
        errors = {"x": 0.002 * random.normal(size=600), "v": 0.005 * random.normal(size=600)}
        record(case / f"r{n}.csv", machine, time, {"F": force}, {"x": "x", "v": "v"}, errors)
    result = explain(load(case))
    (finding,) = result.findings
    law, point = finding.ranked.attachment.law, result.final.point
    (speed,) = law.references()
    assert speed.name == "v" and law.form({"t_1": 0.1}) == "friction.presliding"
    assert point["law_v.c_1"] == pytest.approx(-0.8, rel=0.05)
    assert point["law_v.t_1"] * speed.size == pytest.approx(0.02, rel=0.1)
