"""A plant in a sampled loop: the linear model remembers what its controller does."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna.codegen.compile import compile_model
from lacuna.discovery.case.cases import load
from lacuna.discovery.catalogue.amend import Amendment
from lacuna.discovery.catalogue.places import read as read_structure
from lacuna.discovery.efforts.places.opened import opened
from lacuna.runtime import Model, RecordedInput, simulate

LOOP = """model Loop "Falls away by itself, held by a controller that looks every Ts"
  parameter Real k(unit="1/s2") = 9;
  parameter Real Ts(unit="s") = {Ts};
  constant Real side(unit="m") = 1;
  input Real r(unit="m");
  input Real push(unit="m/s2");
  Real x(unit="m", start=0.1, fixed=true);
  Real v(unit="m/s", start=0, fixed=true);
  discrete Real u(unit="m/s2", start=0, fixed=true);
  discrete Real sum(unit="m", start=0, fixed=true);
{declared}equation
  der(x) = v;
  der(v) = k*(x + 0.3*x^2/side) + u + push;
{loop}end Loop;
"""
EQUATIONS = """  when sample(0, Ts) then
    sum = pre(sum) + (r - x)*0.02;
    u = max(-40, min(40, 30*(r - x) - 8*v + 20*sum));
  end when;
"""
ALGORITHM = """algorithm
  when sample(0, Ts) then
    sum := pre(sum) + (r - x)*0.02;
    if sum > 1e3 then
      u := 0;
    else
      u := 30*(r - x) - 8*v + 20*sum;
    end if;
  end when;
"""
CLOCK = """  clock = sample(0, Ts);
  when clock then
    sum = pre(sum) + (r - x)*0.02;
  end when;
  when {clock, initial()} then
    u = 30*(r - x) - 8*v + 20*sum;
  end when;
"""
SIGNALS = (
    '[signals.r]\nrole = "input"\nvariable = "r"\nunit = "m"\ninterpolation = "hold"\n'
    '[signals.push]\nrole = "input"\nvariable = "push"\nunit = "m/s2"\ninterpolation = "hold"\n'
    '[signals.x]\nrole = "output"\nvariable = "x"\nunit = "m"\nnoise_std = 1e-3\n'
    '[signals.v]\nrole = "output"\nvariable = "v"\nunit = "m/s"\nnoise_std = 1e-3\n'
)


@pytest.mark.parametrize("Ts", [0.02, 0.004, 0.05])
@pytest.mark.parametrize("loop", [EQUATIONS, ALGORITHM, CLOCK], ids=["equations", "algorithm", "clock"])
def test_the_linear_response_of_a_sampled_loop_is_that_of_the_model(tmp_path: Path, loop: str, Ts: float) -> None:
    """Against differences of two runs, in which the loop answers; recorded every 20 ms."""
    declared = "  Boolean clock(start=false, fixed=true);\n" if loop is CLOCK else ""
    (tmp_path / "Loop.mo").write_text(LOOP.format(Ts=Ts, loop=loop, declared=declared))
    model = Model(compile_model(str(tmp_path / "Loop.mo")).path)
    time, random = np.arange(0.0, 3.0, 0.02), np.random.default_rng(1)
    reference = 0.1 * np.repeat(random.uniform(-1, 1, 5), 30)
    push = np.repeat(random.uniform(-1, 1, 15), 10)

    def run(amount: float) -> np.ndarray:
        inputs = {"r": RecordedInput(time, reference, "hold"), "push": RecordedInput(time, amount * push, "hold")}
        found = simulate(model, solver="dopri5", rtol=1e-10, inputs=inputs, start=0.0, stop=float(time[-1]),
                         output_times=time, outputs=["x", "v"], events=False)  # fmt: skip
        return np.column_stack([found["x"], found["v"]])

    table = np.column_stack([time, reference, 0 * push, run(0.0)])
    for name in ("r1", "r2"):
        np.savetxt(tmp_path / f"{name}.csv", table, "%.9g", ",", header="time,r,push,x,v", comments="")
    (tmp_path / "case.toml").write_text(
        f'model = "Loop.mo"\n{SIGNALS}[recordings]\nfit = ["r1.csv"]\nvalidate = ["r2.csv"]\n'
    )
    case = load(tmp_path)
    door = opened(case, Amendment(read_structure(case.library(), case.base)), case.library(), ["k"])
    along = door.linear.along({"k": 9.0, "Ts": Ts}, case.fit[0])
    place = next(k for k, s in enumerate(door.sites) if "der(v)" in s.label)
    answer = along.response(np.array([place]), push[:, None], hold=True)[:, :, 0]
    differences = (run(0.01) - run(-0.01)) / 0.02
    assert np.abs(answer - differences).max() < 2e-3 * np.abs(differences).max()


def test_a_controller_that_cannot_be_followed_is_held_as_it_was(tmp_path: Path) -> None:
    """It sets a state at its ticks: the plant is told with what it holds along the run, and stays a place."""
    loop = EQUATIONS.replace("sum = pre(sum)", "reinit(v, 0.9*v);\n    sum = pre(sum)")
    (tmp_path / "Loop.mo").write_text(LOOP.format(Ts=0.02, loop=loop, declared=""))
    time = np.arange(0.0, 0.4, 0.02)
    table = np.column_stack([time, 0 * time, 0 * time, 0.1 + 1e-3 * np.sin(900 * time), 1e-3 * np.cos(700 * time)])
    for name in ("r1", "r2"):
        np.savetxt(tmp_path / f"{name}.csv", table, "%.9g", ",", header="time,r,push,x,v", comments="")
    (tmp_path / "case.toml").write_text(
        f'model = "Loop.mo"\n{SIGNALS}[recordings]\nfit = ["r1.csv"]\nvalidate = ["r2.csv"]\n'
    )
    case = load(tmp_path)
    door = opened(case, Amendment(read_structure(case.library(), case.base)), case.library(), ["k"])
    along = door.linear.along({"k": 9.0, "Ts": 0.02}, case.fit[0])
    place = next(k for k, s in enumerate(door.sites) if "der(v)" in s.label)
    answer = along.response(np.array([place]), np.ones((len(time), 1)), hold=True)[:, 1, 0]
    assert answer[1] == pytest.approx(0.02, rel=0.01) and np.all(np.diff(answer) > 0)  # nothing holds it back
