"""Nearly ideal switches: two of them in a row must not eat the digits of what is computed."""

from __future__ import annotations

from pathlib import Path

import pytest

from lacuna.codegen.compile import compile_model
from lacuna.runtime.model import Model
from lacuna.runtime.simulation import simulate

VOLTAGE, CLOSED, OPEN, LOAD = 100.0, 1e-5, 1e-5, 100.0  # V, Ohm, S, Ohm
INVERTER = f"""model Inverter "Three legs on one supply, the load in star; what is open leaks"
  connector Pin
    Real v;
    flow Real i;
  end Pin;
  model Switch
    Pin p, n;
    Boolean closed;
    Real s;
  equation
    p.v - n.v = s*(if closed then {CLOSED} else 1);
    p.i = s*(if closed then 1 else {OPEN});
    p.i + n.i = 0;
  end Switch;
  model Resistor
    Pin p, n;
  equation
    p.v - n.v = {LOAD}*p.i;
    p.i + n.i = 0;
  end Resistor;
  model Source
    parameter Real v = 0;
    Pin p;
  equation
    p.v = v;
  end Source;
  Source plus(v = {VOLTAGE}), minus;
  Switch upper[3](each closed = time < 0.5), lower[3](each closed = time >= 0.5);
  Resistor load[3];
equation
  for k in 1:3 loop
    connect(plus.p, upper[k].p);
    connect(upper[k].n, lower[k].p);
    connect(lower[k].n, minus.p);
    connect(upper[k].n, load[k].p);
  end for;
  connect(load[1].n, load[2].n);
  connect(load[1].n, load[3].n);
  annotation(experiment(StopTime = 1));
end Inverter;
"""
DIODES = """model Diodes "Two phases over two diodes on one load: both switch where they cross"
  parameter Real Ron = 1e-5, Goff = 1e-5, R = 10;
  Real u[2] = {sin(6.283185307179586*time), -sin(6.283185307179586*time)};
  Real s[2], i[2], v;
  Boolean off[2](each start = true);
equation
  for k in 1:2 loop
    off[k] = s[k] < 0;
    u[k] - v = s[k]*(if off[k] then 1 else Ron);
    i[k] = s[k]*(if off[k] then Goff else 1);
  end for;
  v = R*(i[1] + i[2]);
  annotation(experiment(StopTime = 3.3));
end Diodes;
"""


def model(text: str, folder: Path) -> Model:
    path = folder / f"{text.split()[1]}.mo"
    path.write_text(text)
    return Model(compile_model(str(path)).path)


def test_the_leakage_of_a_bridge_keeps_its_digits(tmp_path: Path) -> None:
    result = simulate(model(INVERTER, tmp_path), interval=0.25)
    assert result.complete, result.failure
    leakage = VOLTAGE * OPEN / (1 + OPEN * CLOSED)  # no current in the load: all legs are alike
    for k in (1, 2, 3):
        assert result[f"upper[{k}].p.i"][-1] == pytest.approx(leakage, rel=1e-9)
        assert result[f"lower[{k}].p.i"][-1] == pytest.approx(leakage, rel=1e-4)
        assert result[f"lower[{k}].n.i"][0] == pytest.approx(-leakage, rel=1e-4)


def test_diodes_hand_over_at_each_crossing(tmp_path: Path) -> None:
    result = simulate(model(DIODES, tmp_path), rtol=1e-6)
    assert result.complete, result.failure
    drop = 1e-4  # of Ron beside R, and what leaks
    assert max(abs(result["v"] - abs(result["u[1]"]))) <= drop
