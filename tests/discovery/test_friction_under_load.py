"""Friction in proportion to a load that goes through zero: it holds nothing there, and has a sign of any steepness."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna.discovery.case.cases import load
from lacuna.discovery.explain import explain

from .recorded import concealed, record
from .test_sensors import CART, CASE


@pytest.mark.parametrize("creep", [0.15, 0.05])  # m/s, over which the sign turns
def test_friction_that_grows_with_a_force_of_either_sign_is_found(creep: float, tmp_path: Path) -> None:
    rubbing = CART.replace("- c*x;", f"- c*x - 3*tanh(v/{creep})*abs(x);")
    case, machine = concealed(tmp_path, "Cart", rubbing, CART, CASE.replace('interpolation = "hold"\n', ""))
    random, time = np.random.default_rng(8), 0.05 * np.arange(600)
    for n in (1, 2, 3):
        force = np.repeat(random.uniform(-6, 6, 12), 50)
        errors = {"x": 0.002 * random.normal(size=600), "v": 0.005 * random.normal(size=600)}
        record(case / f"r{n}.csv", machine, time, {"F": force}, {"x": "x", "v": "v"}, errors)
    result = explain(load(case))
    (finding,) = result.findings
    law, point = finding.ranked.attachment.law, result.final.point
    assert law.text() == "c_1*tanh({q}*{v})*abs{x}".format(
        q="q_1", **{v.name: v.scaled for v in law.site.variables if v.name in ("v", "x") and not v.minus}
    )
    size = {v.name: v.size for v in law.references()}
    assert point["law_v.c_1"] / size["x"] == pytest.approx(-3, rel=0.03)
    assert size["v"] / point["law_v.q_1"] == pytest.approx(creep, rel=0.1)
