"""Initial systems: steady starts against their closed forms, and a model with nothing to start."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from lacuna import runtime
from lacuna.codegen.compile import compile_model
from lacuna.codegen.emit.callbacks import large
from lacuna.codegen.errors import Diagnostic

STEADY = """model Steady "A DC motor that starts in steady state and is loaded after half a second"
  parameter Real R=1, L=0.01, k=0.1, J=0.001, d=1e-4, V=12;
  Real i, w, tau;
initial equation
  der(i) = 0;
  der(w) = 0;
equation
  L*der(i) = V - R*i - k*w;
  J*der(w) = k*i - d*w - tau;
  tau = if time < 0.5 then 0 else 0.1;
  annotation(experiment(StopTime=1));
end Steady;
"""


def simulated(folder: Path, text: str, **settings: object) -> runtime.Result:
    name = text.split()[1]
    (folder / f"{name}.mo").write_text(text)
    return runtime.simulate(runtime.Model(compile_model(str(folder / f"{name}.mo")).path), **settings)


@pytest.mark.parametrize("solver", ["ida", "dopri5"])
def test_a_steady_start_stays_steady_until_the_load_comes(tmp_path: Path, solver: str) -> None:
    """k i = d w and V = R i + k w: w = V k / (k^2 + R d)."""
    result = simulated(tmp_path, STEADY, solver=solver)
    speed = 12 * 0.1 / (0.1**2 + 1e-4)
    before = result["w"][result.time < 0.499]
    assert before == pytest.approx(speed, rel=1e-12)
    assert result["i"][0] == pytest.approx(1e-3 * speed, rel=1e-12)
    assert result["w"][-1] < speed - 5


def test_a_model_without_variables_runs(tmp_path: Path) -> None:
    result = simulated(tmp_path, "model Nothing\nend Nothing;\n")
    assert result.complete
    assert result.time[-1] == 1.0


def test_a_derivative_that_only_an_initial_equation_has(tmp_path: Path) -> None:
    """q = x + y has no equation of its own for der(q): der(q) = der(x) + der(y) = 0 at the start gives x = 3 y."""
    text = """model Only
  Real x, y(start=1, fixed=true), q;
initial equation
  der(q) = 0;
equation
  der(x) = -x;
  der(y) = 3*y;
  q = x + y;
end Only;
"""
    result = simulated(tmp_path, text, stop=0.1)
    assert result["x"][0] == pytest.approx(3, rel=1e-9)
    assert result["q"][0] == pytest.approx(4, rel=1e-9)


def test_a_free_parameter_in_several_initial_equations(tmp_path: Path) -> None:
    """p = x and p + x = 3: both are 1.5, though p = x alone would give p the value of a state that is not known."""
    text = """model Several
  parameter Real p(fixed=false);
  Real x;
initial equation
  x = p;
  0 = 3 - p - x;
equation
  der(x) = -x;
end Several;
"""
    result = simulated(tmp_path, text, stop=0.1)
    assert result["x"][0] == pytest.approx(1.5, rel=1e-9)
    assert result["p"][-1] == pytest.approx(1.5, rel=1e-9)


# What an engineer gets to read: the declarations and initial equations of a model, and what the run says.
UNFIT = {
    "steady and conserved": (
        "Real x(start=1), y(start=1);\ninitial equation\n  der(x) = 0;\n  der(y) = 0;\nequation\n"
        "  der(x) = y - x;\n  der(y) = x - y;",
        "follow from each other and leave these open: x, y; give one of them a start value with fixed = true",
    ),
    "one says what another does": (
        "Real x, y;\ninitial equation\n  x - y = 1;\n  2*x - 2*y = 2;\nequation\n  der(x) = -x;\n  der(y) = -y;",
        "follow from each other and leave these open: x, y",
    ),
    "contradictory": (
        "Real x, y;\ninitial equation\n  x - y = 1;\n  2*x - 2*y = 3;\nequation\n  der(x) = -x;\n  der(y) = -y;",
        "linear equations have no solution, or no unique one; in: 2*x - 2*y = 3",
    ),
    "never steady": (
        "Real x(start=1);\ninitial equation\n  der(x) = 0;\nequation\n  der(x) = x^2 + 1;",
        "a block of nonlinear equations did not converge; in: der(x) = x^2 + 1",
    ),
    "never settles": (
        "Boolean on; Real y;\n  Real x(start=0, fixed=true);\nequation\n"
        "  der(x) = 1;\n  y = if on then -1 - x else 1 + x;\n  on = y > 0;",
        "do not settle at time 0 s; these keep changing: on",
    ),
}


@pytest.mark.parametrize("case", UNFIT)
def test_an_initial_system_without_an_answer_is_told_by_its_variables(tmp_path: Path, case: str) -> None:
    body, said = UNFIT[case]
    result = simulated(tmp_path, f"model Unfit\n  {body}\nend Unfit;\n", stop=1.0)
    assert not result.complete
    assert said in str(result.failure)


def test_what_is_open_may_be_given(tmp_path: Path) -> None:
    """The hint of the first of them, followed: one start value in place of an initial equation."""
    text = """model Conserved
  Real x(start=1, fixed=true), y;
initial equation
  der(y) = 0;
equation
  der(x) = y - x;
  der(y) = x - y;
end Conserved;
"""
    result = simulated(tmp_path, text, stop=1.0)
    assert result.complete, result.failure
    assert result["x"] == pytest.approx(1.0)
    assert result["y"] == pytest.approx(1.0)


STICKS = """model Sticks
  Real w(start=0, fixed=true), i, sa(start=3);
  Boolean stuck(start=true, fixed=true);
initial equation
  der(w) = {};
equation
  stuck = pre(stuck) and abs(w) < 0.1;
  der(w) = if stuck then 0 else sa - 1;
  0.5*der(w) = i - (if stuck then sa else 1);
  der(i) = 10 - i;
end Sticks;
"""


@pytest.mark.parametrize("limit", [500, 0])
def test_what_a_mode_leaves_open_starts_at_its_start_value(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, limit: int
) -> None:
    """A friction that sticks has no acceleration, whatever it bears: what it bears is open where rest is asked for, and
    its start value is a guess (8.6). What follows from that is told."""
    monkeypatch.setattr(large, "LARGE", limit)
    monkeypatch.setenv("LACUNA_CACHE", str(tmp_path / "cache"))
    result = simulated(tmp_path, STICKS.format("0"), stop=1.0)
    assert result["i"][0] == pytest.approx(3.0)
    assert result["i"][-1] == pytest.approx(10 - 7 * math.exp(-1), rel=1e-5)
    (warning,) = compile_model(str(tmp_path / "Sticks.mo")).report.warnings
    assert warning.code == "S021"
    assert "sa is open at the start" in str(warning)
    assert "what follows are i" in str(warning)


def test_what_a_mode_contradicts_is_refused(tmp_path: Path) -> None:
    result = simulated(tmp_path, STICKS.format("1"), stop=1.0)
    assert "linear equations have no solution, or no unique one" in str(result.failure)


BOUND = """model Bound
  parameter Real p(fixed=false) = 2;
  parameter Real q[2](fixed={false, true}) = {p, 1};
  Real x(start=1, fixed=true);
equation
  der(x) = p + q[1] + q[2];
end Bound;
"""


def test_a_parameter_with_a_value_has_that_value_and_a_warning_says_so(tmp_path: Path) -> None:
    """8.6: solved from its binding, with a diagnostic. An initial equation for it is one too many."""
    (tmp_path / "Bound.mo").write_text(BOUND)
    compiled = compile_model(str(tmp_path / "Bound.mo"))
    assert [(w.code, w.span.line) for w in compiled.report.warnings] == [("W012", 2), ("W012", 3)]
    assert runtime.simulate(runtime.Model(compiled.path))["x"][-1] == pytest.approx(6, rel=1e-12)
    with pytest.raises(Diagnostic, match=r"too many initial equations: nothing in p = 5 is unknown"):
        simulated(tmp_path, BOUND.replace("equation\n", "initial equation\n  p = 5;\nequation\n", 1))


def test_fixed_may_be_a_parameter(tmp_path: Path) -> None:
    """x + y = 5 with x fixed at 1 gives y = 4, and p is what der(x) = 7 asks for."""
    text = """model Chosen
  parameter Boolean given = true;
  parameter Real p(fixed=not given);
  Real y(start=0, fixed=not given), x(start=1, fixed=given);
initial equation
  x + y = 5;
  der(x) = 7;
equation
  der(y) = 0;
  der(x) = p;
end Chosen;
"""
    result = simulated(tmp_path, text, stop=0.5)
    assert (result["y"][0], result["x"][-1]) == pytest.approx((4, 4.5), rel=1e-9)
