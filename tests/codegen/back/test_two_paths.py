"""The explicit and the residual form are two paths through the same equations: they must meet, and the analytic
Jacobian must be the derivative of the residual, with relations and states anywhere."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from tests.codegen.generated import Generated, write_model

ROOT = Path(__file__).parents[3]
MODELS = [
    "Actuators.FlightControlEma", "Actuators.EccentricBldc", "Benches.BldcDrive", "Benches.ScrewEma",
    *(str(p.relative_to(ROOT)) for p in sorted((ROOT / "tests" / "models").glob("*.mo"))),
]  # fmt: skip
CJ, STEP = 37.0, 1e-6


@pytest.fixture(scope="module", params=MODELS)
def points(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> tuple[Generated, list]:
    """A model and points of it: random states near the start values, random relations."""
    name = str(ROOT / request.param) if request.param.endswith(".mo") else request.param
    model = Generated(name, tmp_path_factory.mktemp("cache"))
    n_x, random = model.descriptor.n_x, np.random.default_rng(7)
    x0 = model.arrays["x"][:n_x].copy()
    relations = [random.integers(0, 2, model.descriptor.n_rel) for _ in range(6)]
    return model, [(x0 + 0.3 * random.normal(size=n_x), rel) for rel in relations]


def test_explicit_point_has_no_residual(points: tuple[Generated, list]) -> None:
    model, states = points
    for x, rel in states:
        model.arrays["rel"][: len(rel)] = rel
        y, yp = model.dae_point(0.1, x)
        # rounding: the largest terms of a row are its Jacobian times the point
        terms = np.abs(model.jacobian(0.1, y, yp, CJ)) @ (np.maximum(np.abs(y), 1) + np.abs(yp) / CJ)
        assert np.all(np.abs(model.residual(0.1, y, yp)) <= 1e-13 * terms)


def test_a_brief_look_gives_the_same_derivatives_and_leaves_alone_what_it_does_not_compute(
    points: tuple[Generated, list],
) -> None:
    model, states = points
    at_start = model.arrays["v"][: model.descriptor.n_v]
    for x, rel in states:
        model.arrays["rel"][: len(rel)] = rel
        xdot, v = model.rhs(0.1, x)
        model.data.brief = 1
        xdot_alone, v_alone = model.rhs(0.1, x)
        model.data.brief = 0
        np.testing.assert_array_equal(xdot_alone, xdot)
        assert np.all((v_alone == v) | (v_alone == at_start))


def test_what_the_next_solution_starts_from_is_written_in_a_brief_look_too(tmp_path: Path) -> None:
    """One of two nonlinear equations decides x'; the other decides an output alone, so a brief look passes it over."""
    text = """model Both
  Real x(start = 2, fixed = true), q, r, y;
equation
  q + 0.5*sin(q) = x;
  r + 0.3*sin(r) = 2*x;
  der(x) = -q;
  y = r + q;
end Both;
"""
    model = Generated(write_model(tmp_path, text), tmp_path)
    n_v, at_start = model.descriptor.n_v, model.arrays["v"].copy()
    _, v = model.rhs(0.0, np.array([2.0]))
    model.data.brief = 1
    _, alone = model.rhs(0.0, np.array([2.0]))
    written = alone != at_start[:n_v]
    assert np.count_nonzero(written) == 1
    q = alone[written][0]
    assert q in v and q + 0.5 * np.sin(q) == pytest.approx(2, rel=1e-12)


def test_jacobian_is_the_derivative_of_the_residual(points: tuple[Generated, list]) -> None:
    """Central differences: truncation and rounding leave about 1e-7 of the row's largest entry."""
    model, states = points
    d = model.descriptor
    differential = np.r_[np.ones(d.n_x), np.zeros(d.n_z)]
    for x, rel in states:
        model.arrays["rel"][: len(rel)] = rel
        y, yp = model.dae_point(0.1, x)
        exact = model.jacobian(0.1, y, yp, CJ)
        for k in range(len(y)):
            e = np.zeros(len(y))
            e[k] = STEP * max(1.0, abs(y[k]))
            difference = model.residual(0.1, y + e, yp + CJ * e * differential)
            difference -= model.residual(0.1, y - e, yp - CJ * e * differential)
            scale = np.abs(exact).max(axis=1) + np.abs(exact[:, k])
            assert np.all(np.abs(difference / (2 * e[k]) - exact[:, k]) <= 1e-6 * scale)
