"""What events read follows, through equations, what they set: both hold at that instant, or the run ends."""

from __future__ import annotations

from pathlib import Path

import pytest

from lacuna import runtime
from lacuna.codegen.errors import Diagnostic
from tests.events.models import compiled

CUBIC = """model Cubic "What is set follows itself through x + x^3 = n: the fixed point where it attracts"
  discrete Real n(start=0, fixed=true);
  parameter Real k=0.5;
  Real x;
equation
  x + x^3 = n + 0*time;
  when time > 0.5 then
    n = 1 - k*x;
  end when;
end Cubic;
"""
RESISTOR = """model Resistor "A converter samples a voltage at the instant at which it switches the source on"
  discrete Real e(start=0, fixed=true), seen(start=0, fixed=true);
  parameter Real R=2, G=0.25;
  Real i, u;
equation
  e = u + R*i;
  i = G*u + 0*time;
  when time > 0.5 then
    e = 6;
    seen = u;
  end when;
end Resistor;
"""
EXPLICIT = """model Explicit "As Cubic, where translation sees it"
  discrete Real n(start=0, fixed=true);
  Real x = 2*n + 0*time;
equation
  when time > 0.5 then
    n = 1 - x;
  end when;
end Explicit;
"""
SOLVERS = {"ida": {}, "dopri5": {}, "rodas4": {}, "rk4": {"step": 0.01}, "euler": {"step": 0.01}}


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_converter_reads_what_the_circuit_has_become(tmp_path: Path, solver: str) -> None:
    run = runtime.simulate(compiled(tmp_path, RESISTOR), solver=solver, stop=1.0, **SOLVERS[solver])
    assert run["seen"][-1] == pytest.approx(6 / (1 + 2 * 0.25), rel=1e-12)
    assert run["seen"][-1] == run["u"][-1]


def test_its_derivatives_follow_too(tmp_path: Path) -> None:
    """seen = 6/(1 + R G): d/dR = -6 G/(1 + R G)^2."""
    run = runtime.simulate(compiled(tmp_path, RESISTOR, sensitivities=True), solver="dopri5", stop=1.0,
                           sensitivities=["R"])  # fmt: skip
    assert run.sensitivity("seen", "R")[-1] == pytest.approx(-6 * 0.25 / 1.5**2, rel=1e-9)


@pytest.mark.parametrize("k", [0.2, 0.5, 0.9])
def test_a_circle_that_attracts_ends_in_its_fixed_point(tmp_path: Path, k: float) -> None:
    run = runtime.simulate(compiled(tmp_path, CUBIC), stop=1.0, parameters={"k": k})
    n, x = run["n"][-1], run["x"][-1]
    assert x + x**3 == pytest.approx(n, rel=1e-10) and n == pytest.approx(1 - k * x, rel=1e-10)


def test_a_circle_that_repels_ends_the_run(tmp_path: Path) -> None:
    run = runtime.simulate(compiled(tmp_path, CUBIC), stop=1.0, parameters={"k": 50.0})
    assert run.failure is not None and not run.complete
    assert "follows itself through equations and does not settle in 1000 rounds: n;" in run.failure.message
    assert run["time"][-1] <= 0.5


def test_a_circle_that_translation_sees_is_refused(tmp_path: Path) -> None:
    with pytest.raises(Diagnostic, match="the value that the when-clause gives n follows itself") as refused:
        compiled(tmp_path, EXPLICIT)
    assert (refused.value.code, refused.value.span.line) == ("S013", 6)


TURNING = """model Turning
  Real x(start=0, fixed=true);
  Boolean b(start=false, fixed=true);
equation
  der(x) = 1;
  b = x > 1 and not pre(b);
end Turning;
"""


def test_passes_that_go_round_are_not_made_again_and_again(tmp_path: Path) -> None:
    """b is true and false in turn, whichever way passes are made: each way is left when it has come to where it was,
    but the last, of 200 passes, which has to be sure."""
    run = runtime.simulate(compiled(tmp_path, TURNING), stop=2.0)
    assert run.failure is not None and run.failure.time == pytest.approx(1)
    assert "these keep changing: b" in run.failure.message
    assert run.counters["event_passes"] <= 2 + 2 * 8 + 200
