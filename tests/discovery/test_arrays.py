"""Machines written with arrays: each element of a vector of equations, of a loop, of components is a place."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy.linalg import expm

from lacuna.codegen.library.classes import Library
from lacuna.discovery.case.cases import load
from lacuna.discovery.efforts.places.reading import read
from lacuna.discovery.efforts.places.sites import MOST, Site
from lacuna.discovery.explain import explain

from .recorded import acted

WALL = """package Building "A wall in layers"
  connector Heat
    Real T(unit="K");
    flow Real Q(unit="W");
  end Heat;
  model Layer
    Heat port;
    Real T(unit="K", start=0, fixed=true);
  equation
    T = port.T;
    100*der(T) = port.Q;
  end Layer;
  model Link
    Heat a, b;
    parameter Real G(unit="W/K") = 2;
  equation
    a.Q = G*(a.T - b.T);
    a.Q + b.Q = 0;
  end Link;
  model Outside
    Heat a;
  equation
    a.T = 0;
  end Outside;
  model Wall
    parameter Integer n = 3;
    Layer layer[n];
    Link link[n];
    Outside outside;
    Real x[2](each start=0, each fixed=true);
    Real y[2](each start=0, each fixed=true);
    Real many[13](each start=0, each fixed=true);
    Real z(start=0, fixed=true);
  equation
    for i in 1:n - 1 loop
      connect(layer[i].port, link[i].a);
      connect(link[i].b, layer[i + 1].port);
    end for;
    connect(layer[n].port, link[n].a);
    connect(link[n].b, outside.a);
    der(x) = -0.02*x;
    for i in 1:2 loop
      50*der(y[i]) = -y[i];
    end for;
    der(many) = -many;
    if time < 50 then
      der(z) = -0.02*z;
    else
      der(z) = -0.1*z;
    end if;
  end Wall;
end Building;
"""
TIME = np.linspace(0, 100, 21)


@pytest.fixture
def wall(tmp_path: Path) -> Path:
    path = tmp_path / "Building.mo"
    path.write_text(WALL)
    return path


def places(path: Path) -> dict[str, Site]:
    return {s.label: s for s in read(Library([str(path)]), "Building.Wall").places}


def opened(path: Path, site: Site, names: list[str]) -> list[np.ndarray]:
    """Variables over 100 s with an effort of 5 at a site."""
    return acted(path, "Building.Wall", [site], 5.0, names, TIME)


def test_ports_and_equations_of_arrays_are_places(wall: Path) -> None:
    found = places(wall)
    nodes = [s.label for s in found.values() if s.kind == "node"]
    assert nodes == ["layer[1].port", "link[1].b", "link[2].b", "link[3].b"]
    assert [s.label for s in found.values() if s.kind == "branch"] == ["link[1]", "link[2]", "link[3]"]
    assert [s.left for s in found.values() if s.left] == ["der(x[1])", "der(x[2])", "der(y[1])", "der(y[2])"]


def test_an_array_of_too_many_equations_is_closed_and_says_so(wall: Path) -> None:
    closed = dict(read(Library([str(wall)]), "Building.Wall").closed)
    assert closed["der(many) = -many"] == f"it is one of more than {MOST} equations"


def test_a_term_in_one_equation_of_an_array_acts_there_alone(wall: Path) -> None:
    first, second = opened(wall, places(wall)["der(x) = -0.02*x [2]"], ["x[1]", "x[2]"])
    assert first == pytest.approx(0.0)
    assert second == pytest.approx(250.0 * (1 - np.exp(-0.02 * TIME)), abs=1e-5)


def test_a_term_in_one_pass_of_a_loop_acts_there_alone(wall: Path) -> None:
    first, second = opened(wall, places(wall)["50*der(y[i]) = -y[i] [i = 1]"], ["y[1]", "y[2]"])
    assert first == pytest.approx(5.0 * (1 - np.exp(-TIME / 50)), abs=1e-6)
    assert second == pytest.approx(0.0)


def test_a_term_under_a_condition_acts_while_that_holds(wall: Path) -> None:
    (found,) = opened(wall, places(wall)["der(z) = -0.02*z"], ["z"])
    before = 250.0 * (1 - np.exp(-0.02 * np.minimum(TIME, 50)))
    assert found == pytest.approx(before * np.exp(-0.1 * np.maximum(TIME - 50, 0)), abs=1e-5)


def test_what_flows_into_one_component_of_an_array_goes_on_to_the_others(wall: Path) -> None:
    found = opened(wall, places(wall)["link[1].b"], ["layer[1].T", "layer[2].T", "layer[3].T"])
    rates = np.array([[-0.02, 0.02, 0.0], [0.02, -0.04, 0.02], [0.0, 0.02, -0.04]])
    rest = np.linalg.solve(rates, [0.0, -0.05, 0.0])
    assert np.transpose(found) == pytest.approx(np.array([rest - expm(rates * t) @ rest for t in TIME]), abs=1e-6)


RIG = """model Rig "A drive in state space"
  parameter Real d = 0.5, c = 40;
  parameter Real A[2, 2] = [-d, -c; 1, 0];
  parameter Real C[2, 2] = [1, 0; d, c];
  input Real u;
  Real x[2](each start=0, each fixed=true);
  Real y[2];
equation
  der(x) = A*x + {u, 0};
  y = C*x;
end Rig;
"""


def _rig(folder: Path, lags: float, cubic: float) -> Path:
    """A case of the rig: what is read of the shaft's torque `lags` by so many seconds, or its spring stiffens."""
    folder.mkdir()
    (folder / "Rig.mo").write_text(RIG)
    random, step = np.random.default_rng(5), 0.01
    for name in ("r1", "r2", "r3"):
        command = np.repeat(random.normal(0, 6.0, 40), 25)
        x, read, rows = np.zeros(2), 0.0, []
        for k, u in enumerate(command):
            torque = 0.5 * x[0] + 40 * x[1]
            shown = read if lags else torque
            noise = random.normal(0, [0.002, 0.01])
            rows.append([k * step, u, x[0] + noise[0], shown + noise[1]])
            for _ in range(20):
                torque = 0.5 * x[0] + 40 * x[1]
                read += (torque - read) * (1 - np.exp(-step / 20 / lags)) if lags else 0.0
                rate = u - torque - cubic * x[1] ** 3
                x = x + step / 20 * np.array([rate, x[0] + step / 40 * rate])
        text = "\n".join(",".join(f"{v:.8g}" for v in row) for row in rows)
        (folder / f"{name}.csv").write_text(f"time,u,w,T\n{text}\n")
    signals = [("u", "input", "u", ""), ("w", "output", "y[1]", 0.002), ("T", "output", "y[2]", 0.01)]
    toml = ['model = "Rig.mo"', "[uncertainty]", "d = 0.1", "c = 0.05"]
    for column, role, variable, std in signals:
        toml += [f"[signals.{column}]", f'role = "{role}"', f'variable = "{variable}"', 'unit = "1"']
        toml += [f"noise_std = {std}"] if std else ['interpolation = "hold"']
    toml += ["[recordings]", 'fit = ["r1.csv", "r2.csv"]', 'validate = ["r3.csv"]']
    (folder / "case.toml").write_text("\n".join(toml))
    return folder


def test_the_sensor_of_an_output_of_a_state_space_is_accused_where_it_lags(tmp_path: Path) -> None:
    """An effort in the equation of that output is the same error by another name."""
    found = explain(load(_rig(tmp_path / "case", lags=0.05, cubic=0.0)))
    assert found.verdict == "missing_physics", found.reason
    (finding,) = found.findings
    assert (finding.ranked.attachment.effect.identifier, finding.ranked.attachment.location) == (
        "sensor.lag",
        "sensor:T",
    )
    assert found.final.point[finding.ranked.attachment.full_name("T")] == pytest.approx(0.05, rel=0.03)


def test_a_law_in_one_equation_of_a_state_space_is_found_there(tmp_path: Path) -> None:
    found = explain(load(_rig(tmp_path / "case", lags=0.0, cubic=800.0)))
    assert found.verdict == "missing_physics", found.reason
    assert found.findings[0].ranked.attachment.location == "x[1]"
    law = found.findings[0].ranked.attachment.law
    assert law is not None and "x[2]" in found.findings[0].ranked.attachment.effect.signature
