"""If-equations, when, algorithms, initial sections, asserts: what they become in the flat model."""

from __future__ import annotations

from pathlib import Path

import pytest

from lacuna.codegen import flat
from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.flat.text import dump_flat, equation_text
from lacuna.codegen.flatten import flatten
from lacuna.codegen.library.classes import Library
from lacuna.codegen.symbolic.expr import to_text
from tests.codegen.front.helpers import equations, flatten_text


def test_branches_join_by_their_left_sides(tmp_path: Path) -> None:
    text = """model M
      Real x, y;
    equation
      if time > 2 then
        x = 1; y = 2;
      elseif time > 1 then
        y = 3; x = 4;
      else
        x = 5; y = 6;
      end if;
    end M;"""
    assert equations(flatten_text(tmp_path, text)) == [
        "x = if time > 2 then 1 else if time > 1 then 4 else 5",
        "y = if time > 2 then 2 else if time > 1 then 3 else 6",
    ]


def test_branches_without_common_left_sides_join_by_position(tmp_path: Path) -> None:
    text = """model M
      Real x, y;
    equation
      x = time;
      if time > 1 then y = x; else y^3 + y = x; end if;
    end M;"""
    assert equations(flatten_text(tmp_path, text))[1] == "(if time > 1 then y else y ^ 3 + y) = x"


def test_a_parameter_decides_between_different_structures(tmp_path: Path) -> None:
    text = """model M
      parameter Boolean dynamic = true;
      Real x(start = 1);
    equation
      if dynamic then
        der(x) = -x;
      else
        x = 0;
        assert(time >= 0, "never");
      end if;
      if not dynamic then when time > 1 then reinit(x, 0); end when; end if;
    end M;"""
    dynamic = flatten_text(tmp_path, text)
    assert (equations(dynamic), len(dynamic.asserts), dynamic.whens) == (["der(x) = -x"], 0, [])
    assert dynamic.variables["dynamic"].evaluated
    static = flatten_text(tmp_path, text, modifications={"dynamic": False})
    assert (equations(static), len(static.asserts), len(static.whens)) == (["x = 0"], 1, 1)


def test_a_parameter_that_changes_values_only_stays_free(tmp_path: Path) -> None:
    text = "model M parameter Boolean b = true; Real x; equation if b then x = 1; else x = time; end if; end M;"
    model = flatten_text(tmp_path, text)
    assert equations(model) == ["x = if b then 1 else time"]
    assert not model.variables["b"].evaluated


def test_asserts_carry_the_condition_of_their_branch(tmp_path: Path) -> None:
    text = """model M
      Real x = time;
    equation
      if x > 1 then assert(x < 9, "high"); else assert(x > -1, "low", AssertionLevel.warning); end if;
    end M;"""
    found = [(to_text(a.condition), a.message, a.level) for a in flatten_text(tmp_path, text).asserts]
    assert found == [("not x > 1 or x < 9", "high", "error"), ("x > 1 or x > (-1)", "low", "warning")]


def test_when_branches_and_statements(tmp_path: Path) -> None:
    text = """model M
      Real v(start = 1), h(start = 1);
      discrete Real s(start = 0), q[2](each start = 0);
      Boolean on(start = false);
    equation
      der(h) = v;
      der(v) = -9.81;
      when {h <= 0, sample(0, 0.5)} then
        reinit(v, -0.8*pre(v));
        s = pre(s) + 1;
        q = {s, 2*s};
      elsewhen on then
        s = 0;
        q = {1, 1};
        if h > 1 then terminate("high"); end if;
      end when;
      on = edge(on) or change(s) or initial();
    end M;"""
    model = flatten_text(tmp_path, text)
    (when,) = model.whens
    assert [to_text(c) for c, _ in when.branches] == ["h <= 0", "sample(0, 0.5)", "on"]
    first, second, third = (body for _, body in when.branches)
    assert first == second
    assert [type(s) for s in first] == [flat.Reinit, flat.Assign, flat.Assign, flat.Assign]
    assert [s.target for s in first] == ["v", "s", "q[1]", "q[2]"]
    assert isinstance(third[-1], flat.If)
    assert model.variables["q[2]"].variability == flat.DISCRETE


def test_a_real_set_at_events_only_is_discrete(tmp_path: Path) -> None:
    text = "model M Real held(start = 0); equation when time > 1 then held = time; end when; end M;"
    assert flatten_text(tmp_path, text).variables["held"].variability == flat.DISCRETE


def test_an_algorithm_without_events_becomes_equations(tmp_path: Path) -> None:
    text = """model M
      parameter Integer n = 3;
      Real x, total, top;
      Real part[n];
    algorithm
      total := 0;
      for i in 1:n loop
        part[i] := i*x;
        total := total + part[i];
      end for;
      top := total;
      if total > 5 then
        top := 5;
      end if;
    equation
      x = time;
    end M;"""
    assert equations(flatten_text(tmp_path, text)) == [
        "total = x + 2 * x + 3 * x",
        "part[1] = x",
        "part[2] = 2 * x",
        "part[3] = 3 * x",
        "top = if x + 2 * x + 3 * x > 5 then 5 else x + 2 * x + 3 * x",
        "x = time",
    ]


def test_an_algorithm_with_when_keeps_its_order(tmp_path: Path) -> None:
    text = """model M
      Integer n(start = 0), m(start = 0);
    algorithm
      when sample(0, 1) then
        n := pre(n) + 1;
        m := 2*n;
      end when;
    end M;"""
    model = flatten_text(tmp_path, text)
    (algorithm,) = model.algorithms
    assert algorithm.targets == ("n", "m")
    assert "    m := 2 * n;" in dump_flat(model)


@pytest.mark.parametrize(
    ("written", "meant"),
    [
        ("der(x*y)", "der(x) * y + x * der(y)"),
        ("der(sin(x))", "cos(x) * der(x)"),
        ("der(p*x)", "p * der(x)"),
        ("der(p)", "0.0"),
        ("der(time^2)", "2.0 * time"),
        ("der(if p > 1 then x else y)", "if p > 1 then der(x) else der(y)"),
    ],
)
def test_derivatives_of_expressions(tmp_path: Path, written: str, meant: str) -> None:
    text = f"model M parameter Real p = 2; Real x, y, z; equation z = {written}; end M;"
    (equation,) = flatten_text(tmp_path, text).equations
    assert to_text(equation.rhs) == meant


def test_initial_sections(tmp_path: Path) -> None:
    text = """model M
      Real x, y;
      parameter Real p(fixed = false);
    initial equation
      x = 3;
      der(y) = 0;
    initial algorithm
      p := 2*x;
    equation
      der(x) = -p; der(y) = x - y;
    end M;"""
    model = flatten_text(tmp_path, text)
    assert [equation_text(e) for e in model.initial_equations] == ["x = 3", "der(y) = 0", "p = 2 * x"]
    assert model.variables["p"].binding is None


def test_experiment_is_read_and_inherited(tmp_path: Path) -> None:
    text = """
    model Base Real x = time;
      annotation(experiment(StopTime = 3, Tolerance = 1e-8), Icon(graphics = {Line()}));
    end Base;
    model M extends Base; end M;"""
    experiment = flatten_text(tmp_path, text).experiment
    assert (experiment.stop_time, experiment.tolerance, experiment.interval) == (3.0, 1e-8, None)


@pytest.mark.parametrize(
    ("entries", "said"),
    [
        ("experiment(StopTime = 1, StopTime = 2)", "R030 StopTime is modified twice"),
        ("experiment(StopTime = 1), experiment(StopTime = 2)", "R030 StopTime is modified twice"),
        ("experiment(Tolerance = 0)", "R020 Tolerance of the experiment is 0"),
        ("experiment(StartTime = 2, StopTime = 1)", "R020 the experiment stops at 1 s, before it starts at 2 s"),
        ("experiment(Tolerance = 2)", "R020 Tolerance of the experiment is 2"),
        ("experiment(Interval = -1)", "R020 Interval of the experiment is -1"),
    ],
)
def test_an_experiment_says_each_thing_once_and_what_a_run_can_have(tmp_path: Path, entries: str, said: str) -> None:
    with pytest.raises(Diagnostic) as caught:
        flatten_text(tmp_path, f"model M Real x = time; annotation({entries}); end M;")
    assert f"{caught.value.code} {caught.value.message}" == said


def test_benchmarks_are_accepted_unchanged(shared: Path) -> None:
    servo = flatten(Library([]), str(shared / "benchmarks/ServoT1.mo"))
    motor = flatten(Library([]), str(shared / "benchmarks/BldcT2.mo"))
    assert (len(servo.equations), len(servo.whens), len(servo.algorithms)) == (4, 1, 1)
    assert (len(motor.equations), len(motor.whens), len(motor.algorithms)) == (17, 1, 0)
