"""Functions against NumPy."""

from __future__ import annotations

import numpy as np

TRAPEZOID_X, TRAPEZOID_Y = np.radians([0, 30, 150, 210, 330, 360]), [0, 1, 1, -1, -1, 0]


def test_trapezoid(run) -> None:
    model = """
    model Test
      constant Real w(unit="rad/s") = 1;
      Real y;
    equation
      y = Lacuna.Functions.trapezoid(w*(20*time - 10));
    end Test;
    """
    result = run(model, stop=1.0, interval=1e-3)
    expected = np.interp(np.mod(20 * result.time - 10, 2 * np.pi), TRAPEZOID_X, TRAPEZOID_Y)
    assert np.abs(result["y"] - expected).max() < 1e-12


def test_interpolate(run) -> None:
    xs, ys = [-1.0, 0.5, 2.0, 7.0], [3.0, -1.0, 4.0, 4.5]
    model = f"""
    model Test
      parameter Real xs[4] = {{{", ".join(map(str, xs))}}};
      parameter Real ys[4] = {{{", ".join(map(str, ys))}}};
      constant Real rate(unit="1/s") = 10;
      Real y;
    equation
      y = Lacuna.Functions.interpolate(xs, ys, rate*time - 2);
    end Test;
    """
    result = run(model, stop=1.0, interval=1e-2)
    assert np.abs(result["y"] - np.interp(10 * result.time - 2, xs, ys)).max() < 1e-12
