"""Functions: inlined where they run straight, kept where not, evaluated where all is known; CSV columns."""

from __future__ import annotations

from pathlib import Path

import pytest

from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.flat.text import dump_flat
from lacuna.codegen.symbolic.expr import to_text
from tests.codegen.front.helpers import equations, flatten_text

CLIP = """
function clip "Limit"
  input Real x;
  input Real low = -1;
  input Real high = 1;
  output Real y;
algorithm
  if x < low then y := low; elseif x > high then y := high; else y := x; end if;
end clip;
"""
TABLE = """
function table
  input Real xs[:];
  input Real ys[size(xs, 1)];
  input Real x;
  output Real y;
protected
  Integer i;
algorithm
  i := 1;
  while i < size(xs, 1) - 1 and x > xs[i + 1] loop
    i := i + 1;
  end while;
  y := ys[i] + (ys[i + 1] - ys[i])*(x - xs[i])/(xs[i + 1] - xs[i]);
end table;
"""


def test_a_straight_function_is_inlined_without_events(tmp_path: Path) -> None:
    model = flatten_text(tmp_path, CLIP + "model M Real x = clip(time, high = 3); end M;")
    assert equations(model) == ["x = noEvent(if time < (-1.0) then -1.0 else if time > 3.0 then 3.0 else time)"]
    assert model.functions == {}


def test_arguments_that_make_events_are_not_swallowed(tmp_path: Path) -> None:
    model = flatten_text(tmp_path, CLIP + "model M Real x = clip(if time > 1 then 2 else 0); end M;")
    assert equations(model) == ["x = clip(if time > 1 then 2 else 0, -1.0, 1.0)"]
    assert list(model.functions) == ["clip"]


def test_a_searching_function_is_kept_for_each_size(tmp_path: Path) -> None:
    text = (
        TABLE
        + """model M
      parameter Real xs[3] = {0, 1, 2};
      Real a = table(xs, {0, 1, 4}, time);
      Real b = table({0, 1, 2, 3}, {0, 2, 3, 4}, time);
      Real c = table({0, 1, 2, 3}, {0, 3, 3, 5}, time);
    end M;"""
    )
    model = flatten_text(tmp_path, text)
    assert list(model.functions) == ["table[3,3]", "table[4,4]"]
    kept = model.functions["table[3,3]"]
    assert (kept.inputs, kept.outputs, kept.shapes["xs"], kept.types["i"]) == (
        ("xs", "ys", "x"),
        ("y",),
        (3,),
        "Integer",
    )
    assert "  while i < 2 and x > [](xs, i + 1) loop" in dump_flat(model)
    assert equations(model)[0] == "a = table[3,3]({xs[1], xs[2], xs[3]}, {0.0, 1.0, 4.0}, time)"


def test_known_arguments_give_numbers(tmp_path: Path) -> None:
    text = (
        TABLE
        + """
    function factorial input Integer n; output Integer r; algorithm
      r := if n <= 1 then 1 else n*factorial(n - 1);
    end factorial;
    model M
      parameter Real p = table({0, 1, 2}, {0, 1, 4}, 1.5);
      Real x[factorial(3)] = fill(time, factorial(3));
    end M;"""
    )
    model = flatten_text(tmp_path, text)
    assert model.variables["p"].binding.value == 2.5
    assert "x[6]" in model.variables
    assert model.functions == {}


def test_a_size_may_come_from_a_kept_function_of_parameters(tmp_path: Path) -> None:
    text = """
    function halvings input Real a; output Integer n; protected Real b; algorithm
      n := 0; b := a;
      while b > 1 loop b := b/2; n := n + 1; end while;
    end halvings;
    model M parameter Real a = 9; parameter Integer n = halvings(a); Real x[n] = fill(time, n); end M;"""
    model = flatten_text(tmp_path, text)
    assert "x[4]" in model.variables and "x[5]" not in model.variables
    assert to_text(model.variables["n"].binding) == "halvings(a)"


def test_several_results(tmp_path: Path) -> None:
    text = """
    function polar input Real x; input Real y; output Real r; output Real phi;
    algorithm r := sqrt(x^2 + y^2); phi := atan2(y, x); end polar;
    model M Real r, phi, only; equation
      (r, phi) = polar(time, 2);
      (, only) = polar(1, time);
    end M;"""
    assert equations(flatten_text(tmp_path, text)) == [
        "r = sqrt(time ^ 2 + 4.0)",
        "phi = atan2(2.0, time)",
        "only = atan2(time, 1.0)",
    ]


def test_array_results_of_a_kept_function_are_picked_apart(tmp_path: Path) -> None:
    text = """
    function split input Real x; output Real y[2]; output Integer n; algorithm
      n := 0; y := {x, 0};
      while y[1] > 1 loop
        y := {y[1]/2, y[1]};
        n := n + 1;
        if n > 50 then return; end if;
      end while;
    end split;
    model M Real y[2] = split(time); end M;"""
    model = flatten_text(tmp_path, text)
    assert equations(model) == ["y[1] = split.y[1](time)", "y[2] = split.y[2](time)"]
    text = dump_flat(model)
    assert "before 1[2] := [](y, 1);" in text, "elements assigned together read the old values"
    assert "(y, ) := split(x);" in text


def test_loops_over_known_ranges_unroll_when_inlined(tmp_path: Path) -> None:
    text = """
    function horner input Real c[:]; input Real x; output Real y; algorithm
      y := 0;
      for k in size(c, 1):-1:1 loop y := c[k] + x*y; end for;
    end horner;
    model M Real y = horner({1, 2, 3}, time); end M;"""
    assert equations(flatten_text(tmp_path, text)) == ["y = 1.0 + time * (2.0 + time * 3.0)"]


def test_records_in_and_out(tmp_path: Path) -> None:
    text = """
    record Complex_ Real re; Real im; end Complex_;
    function times input Complex_ a; input Complex_ b; output Complex_ c; algorithm
      c.re := a.re*b.re - a.im*b.im;
      c.im := a.re*b.im + a.im*b.re;
    end times;
    model M Complex_ z, w; equation
      z.re = time; z.im = 1;
      w = times(z, z);
    end M;"""
    found = equations(flatten_text(tmp_path, text))
    assert found[2:] == ["w.re = z.re * z.re - z.im * z.im", "w.im = z.re * z.im + z.im * z.re"]


CSV = """
function csvColumn input String fileName; input String column; output Real values[:]; external "builtin"; end csvColumn;
model M
  parameter String file = "data.csv";
  parameter Real t[:] = csvColumn(file, "time");
  parameter Real y[size(t, 1)] = csvColumn(file, "load");
  Real x = sum(y)*time;
end M;
"""


def test_a_csv_column_is_read_at_translation(tmp_path: Path) -> None:
    data = tmp_path / "data.csv"
    data.write_text("# measured\ntime, load\n0,1\n1,2.5\n2,-4e1\n", encoding="utf-8")
    model = flatten_text(tmp_path, CSV)
    assert [model.variables[f"y[{i}]"].binding.value for i in (1, 2, 3)] == [1.0, 2.5, -40.0]
    assert str(data) in model.files


@pytest.mark.parametrize(
    ("content", "words"),
    [
        ("", "empty"),
        ("time,load\n", "no data"),
        ("time,load\n0,one\n", "'one' is no finite number"),
        ("time\n0\n", "no column load"),
        ("time,load\n0,1\n1,nan\n", "line 3, column load: 'nan' is no finite number"),
        ("time,load\n0,1\n1\n", "line 3: 1 fields where the heading has 2"),
        ("time,load\n0,1,5\n1,2\n", "line 2: 3 fields where the heading has 2"),
        ("time,load\n0,1\n2,1\n1,1\n", "line 4, column time: '1' does not come after 2"),
    ],
)
def test_a_faulty_csv_is_refused(tmp_path: Path, content: str, words: str) -> None:
    (tmp_path / "data.csv").write_text(content, encoding="utf-8")
    with pytest.raises(Diagnostic, match=words) as refused:
        flatten_text(tmp_path, CSV)
    assert refused.value.code == "F041"


def test_functions_inherit_declarations_and_statements(tmp_path: Path) -> None:
    text = """
    partial function Law input Real x; input Real gain = 1; output Real y; end Law;
    function line extends Law; algorithm y := gain*x; end line;
    function steep = line(gain = 5);
    function steeper extends line(gain = 7); end steeper;
    model M Real a = line(time), b = steep(time), c = steeper(time, 2); end M;"""
    assert equations(flatten_text(tmp_path, text)) == ["a = time", "b = 5.0 * time", "c = 2.0 * time"]


def test_an_output_that_no_branch_may_assign_is_a_warning(tmp_path: Path) -> None:
    text = """
    function f input Real u; output Real y; algorithm if u > 0 then y := u; elseif u <= 0 then y := -u; end if; end f;
    model M Real x = f(time), z = f(2*time); end M;"""
    assert [w.code for w in flatten_text(tmp_path, text).warnings] == ["W011"]
