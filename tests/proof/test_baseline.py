"""The usual alternative finds what it can: an algebraic term in one equation, in recordings that show it well."""

import numpy as np
import pytest

from tests.proof.baseline import explain, sparse
from tests.proof.equations import Equation
from tests.proof.generate import generate
from tests.proof.plan import Plan


def test_thresholding_keeps_what_is_there_and_no_more():
    rng = np.random.default_rng(1)
    w, noise = rng.standard_normal((2, 2000))
    library = {"sign": np.sign(w), "square": w * np.abs(w), "sin3": np.sin(3 * w), "cos3": np.cos(3 * w)}
    target = 2.0 * w + 0.5 * library["sign"] + 0.01 * noise
    coefficients, chosen = sparse(Equation("shaft", target, {"b": w}, library))
    assert chosen == ["sign"]
    assert coefficients["b"] == pytest.approx(2.0, rel=0.01)
    assert coefficients["sign"] == pytest.approx(0.5, rel=0.01)


def test_it_keeps_nothing_where_nothing_is():
    rng = np.random.default_rng(2)
    w, noise = rng.standard_normal((2, 2000))
    equation = Equation("shaft", 2.0 * w + 0.1 * noise, {"b": w}, {"sign": np.sign(w), "square": w * np.abs(w)})
    assert sparse(equation)[1] == []


def test_coulomb_friction_on_a_servo(tmp_path):
    plan = Plan("effect", "DcServo", ("friction.coulomb",), gain=(6.0, 9.0), outputs=("i", "w", "theta"))
    generate(("x1", plan, 31, tmp_path))
    diagnosis = explain(tmp_path / "cases" / "x1")
    assert diagnosis["verdict"] == "missing_physics"
    assert diagnosis["findings"][0]["effect"] == "friction.coulomb"
    assert diagnosis["findings"][0]["location"] == "shaft"
