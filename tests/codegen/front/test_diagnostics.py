"""Findings themselves: recovery of the parser, carets under tabs, hints by distance, speed."""

from __future__ import annotations

from pathlib import Path
import time

import pytest

from lacuna.codegen.errors import Diagnostic, Span
from lacuna.codegen.flatten import flatten
from lacuna.codegen.library.classes import Library
from lacuna.codegen.syntax import parse
from lacuna.suggest import distance, nearest
from tests.codegen.front.helpers import flatten_text


def findings(text: str) -> list[tuple[str, int]]:
    with pytest.raises(Diagnostic) as refused:
        parse(text, "model.mo")
    return [(d.code, d.span.line) for d in (refused.value, *refused.value.others)]


def test_the_parser_goes_on_after_a_fault() -> None:
    text = """model M
  Real x = 2 + ;
  Real y(start = 1, fixed);
  Real z
  Real flow;
equation
  x := 3;
  if y = 2 then z = 1; end if;
  for i in 1:3 loop x = 1 +; end for;
  z = 1 2;
end M;
"""
    found = findings(text)
    assert found == [("P007", 2), ("P006", 4), ("P004", 7), ("P008", 8), ("P007", 9), ("P003", 10)]


def test_a_fault_in_one_class_hides_none_in_the_next() -> None:
    assert findings("model A Real x end A;\nmodel B equation y = ; end B;") == [("P006", 1), ("P007", 2)]


def test_the_caret_stands_under_the_fault_behind_tabs(tmp_path: Path) -> None:
    with pytest.raises(Diagnostic) as refused:
        flatten_text(tmp_path, "model M\n\tReal x;\nequation\n\tx = \tspeed;\nend M;\n")
    lines = str(refused.value).splitlines()
    assert lines[1:3] == ["    \tx = \tspeed;", "    \t    \t^^^^^"]
    assert refused.value.span == Span(str(tmp_path / "model.mo"), 4, 7, 5)


@pytest.mark.parametrize(
    ("a", "b", "expected"),
    [("speed", "speed", 0), ("sped", "speed", 1), ("psi", "phi", 1), ("rat", "art", 1), ("kitten", "sitting", 3)],
)
def test_distance(a: str, b: str, expected: int) -> None:
    assert distance(a, b) == distance(b, a) == expected


def test_nearest_names_are_near() -> None:
    assert nearest("torqe", ["tau", "torque", "voltage", "torques"]) == ["torque"]
    assert nearest("x", ["voltage"]) == []


def test_flattening_is_fast(tmp_path: Path) -> None:
    """Three hundred equations from a hundred components, well under a second (0.1 s when measured)."""
    text = """
    connector Pin Real v(unit = "V"); flow Real i(unit = "A"); end Pin;
    model R Pin p, n; parameter Real R(unit = "Ohm") = 1; equation p.v - n.v = R*p.i; p.i + n.i = 0; end R;
    model M
      R r[100];
    equation
      for k in 1:99 loop connect(r[k].n, r[k + 1].p); end for;
      r[1].p.v = 0;
    end M;"""
    path = tmp_path / "model.mo"
    path.write_text(text, encoding="utf-8")
    best = 10.0
    for _ in range(3):
        start = time.perf_counter()
        model = flatten(Library([]), str(path))
        best = min(best, time.perf_counter() - start)
    assert len(model.equations) >= 300
    assert best < 1.0


def test_a_file_declares_a_class_once(tmp_path: Path) -> None:
    with pytest.raises(Diagnostic) as caught:
        flatten_text(tmp_path, "model M Real x = 1; end M;\nmodel M Real y = 1; end M;")
    assert (caught.value.code, caught.value.span.line, len(caught.value.notes)) == ("R010", 2, 1)


def test_annotations_that_are_nearly_read_are_warned_of_where_they_stand(tmp_path: Path) -> None:
    """An experiment's StopTimee or a parameter's evaluate did nothing; what other tools read is not looked at."""
    text = """model M
  parameter Real c = 0 annotation(evaluate=true, Dialog(group="a"), __Tool_evaluate=true);
  Real x(start=1, fixed=true);
equation
  der(x) = -c*x;
  annotation(Icon(graphics={}), experimet(StopTime=3), experiment(StopTimee=2, Runs=3, __Tool_Stop=3));
end M;"""
    found = [(w.code, w.span.line, w.span.column, w.hint) for w in flatten_text(tmp_path, text).warnings]
    assert found == [
        ("W013", 2, 35, "did you mean Evaluate?"),
        ("W013", 6, 33, "did you mean experiment?"),
        ("W013", 6, 67, "did you mean StopTime?"),
        ("W013", 6, 80, "it has StartTime, StopTime, Tolerance, Interval"),
    ]


def test_where_more_may_be_wrong_than_is_told_it_is_said(tmp_path: Path) -> None:
    path = tmp_path / "Many.mo"
    path.write_text(f"model Many {' '.join(f'Real y{k} = absent{k};' for k in range(12))} end Many;", encoding="utf-8")
    with pytest.raises(Diagnostic) as refused:
        flatten(Library([]), str(path))
    assert len(refused.value.others) == 9
    assert str(refused.value).endswith("these are the first 10; there may be more")


def test_components_of_one_class_that_lack_an_equation_are_told_once(tmp_path: Path) -> None:
    path = tmp_path / "Row.mo"
    path.write_text(
        "model Row model B Real a, b; equation a = time; end B; B b[7]; B other; end Row;", encoding="utf-8"
    )
    with pytest.raises(Diagnostic) as refused:
        flatten(Library([]), str(path))
    assert (refused.value.code, refused.value.others) == ("R078", [])
    assert refused.value.notes[0][1] == "as b[1] is declared here (and so are 7 more)"
