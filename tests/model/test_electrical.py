"""Electrical components against closed forms."""

from __future__ import annotations

import numpy as np

CIRCUIT = """
model Test
  import Lacuna.Components.Electrical.*;
  {components}
  Ground ground;
equation
  connect(source.n, ground.p);
  {equations}
end Test;
"""


def circuit(components: str, equations: str) -> str:
    return CIRCUIT.format(components=components, equations=equations)


def test_series_rlc_step(run) -> None:
    """Underdamped: v_C = V (1 - e^-at (cos wd t + a/wd sin wd t)), a = R/2L."""
    R, L, C, V = 2.0, 1e-3, 1e-4, 10.0
    model = circuit(
        f"ConstantVoltage source(V={V}); Resistor r(R={R}); Inductor l(L={L}, i(start=0, fixed=true));"
        f"Capacitor c(C={C}, v(start=0, fixed=true));",
        "connect(source.p, r.p); connect(r.n, l.p); connect(l.n, c.p); connect(c.n, source.n);",
    )
    result = run(model, stop=5e-3, interval=1e-5)
    t, a = result.time, R / (2 * L)
    wd = np.sqrt(1 / (L * C) - a * a)
    expected = V * (1 - np.exp(-a * t) * (np.cos(wd * t) + a / wd * np.sin(wd * t)))
    assert np.abs(result["c.v"] - expected).max() < 1e-7 * V


def test_bus_sags_with_its_source_resistance(run) -> None:
    model = circuit(
        "Bus source(V=28, R=0.5); Resistor load(R=1.5);", "connect(source.p, load.p); connect(load.n, source.n);"
    )
    result = run(model, stop=1.0)
    assert np.allclose(result["load.v"], 28 * 1.5 / 2.0, rtol=1e-12)
    assert np.allclose(result["source.power"], 28 * 14, rtol=1e-12)
    assert np.allclose(result["source.loss"], 0.5 * 14**2, rtol=1e-12)


def test_diode_lets_half_a_sine_through_an_inductor(run) -> None:
    """From 0 the current of L rises with the first half wave and the diode goes out when it is back at zero: for R = 0
    that is after a whole period, i = V/(w L) (1 - cos w t)."""
    V, w, L = 10.0, 2 * np.pi * 50, 0.1
    model = circuit(
        f"SignalVoltage source; IdealDiode d(Ron=0, Roff=1e9); Inductor l(L={L}, i(start=0, fixed=true));"
        f" Lacuna.Components.Sources.Sine u(amplitude={V}, f=50);",
        "connect(u.y, source.u); connect(source.p, d.p); connect(d.n, l.p); connect(l.n, source.n);",
    )
    result = run(model, stop=0.0199, interval=1e-4)
    expected = V / (w * L) * (1 - np.cos(w * result.time))
    assert np.abs(result["l.i"] - expected).max() < 1e-5 * expected.max()


def test_emf_converts_without_loss(run) -> None:
    """Motor on a voltage source without R, L: speed V/k, whatever the load."""
    model = """
    model Test
      import Lacuna.Components.*;
      Electrical.ConstantVoltage source(V=6); Electrical.Ground ground; Electrical.Resistor r(R=1);
      Electrical.EMF emf(k=0.05); Mechanics.Inertia rotor(J=1e-4, phi(start=0, fixed=true), w(start=0, fixed=true));
    equation
      connect(source.n, ground.p); connect(source.p, r.p); connect(r.n, emf.p); connect(emf.n, source.n);
      connect(emf.flange, rotor.flange_a);
    end Test;
    """
    result = run(model, stop=0.5, interval=1e-3)
    expected = 6 / 0.05 * (1 - np.exp(-result.time * 0.05**2 / 1e-4))
    assert np.abs(result["rotor.w"] - expected).max() < 1e-6 * expected.max()
    assert np.allclose(result["emf.v"] * result["emf.i"], result["rotor.J"] * result["rotor.a"] * result["rotor.w"])
