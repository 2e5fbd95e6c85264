"""Functions of the model run on numbers while translating: start values, and what constraints determine."""

from __future__ import annotations

from pathlib import Path

import pytest

from lacuna.codegen import flat
from lacuna.codegen.compile import translate
from lacuna.codegen.symbolic import expr as ex
from lacuna.codegen.symbolic.evaluate import evaluate
from lacuna.codegen.symbolic.function_value import call_value

FUNCTIONS = """model Functions
  function root "Newton's iteration, with a bound"
    input Real a;
    output Real x;
  protected
    Integer n = 0;
  algorithm
    x := a;
    while abs(x*x - a) > 1e-12 loop
      x := (x + a/x)/2;
      n := n + 1;
      if n > 60 then
        break;
      end if;
    end while;
  end root;
  function norm
    input Real v[3];
    output Real result;
  algorithm
    result := 0;
    for i in 1:3 loop
      result := result + v[i]^2;
    end for;
    result := root(result);
  end norm;
  function direction
    input Real v[3];
    output Real result[3];
  algorithm
    assert(norm(v) > 0, "no direction");
    result := v/norm(v);
  end direction;
  function endless
    input Real a;
    output Real y;
  algorithm
    y := a;
    while y > 0 loop
      y := y + 1;
    end while;
  end endless;
  Real r = root(time);
  Real d[3] = direction({time, 2, 2});
  Real e = if time > 2 then endless(time) else 0;
end Functions;
"""


@pytest.fixture(scope="module")
def model(tmp_path_factory: pytest.TempPathFactory) -> flat.FlatModel:
    path: Path = tmp_path_factory.mktemp("functions") / "Functions.mo"
    path.write_text(FUNCTIONS)
    return translate(str(path))[0].model


def value(model: flat.FlatModel, variable: str, time: float) -> float | int | bool | None:
    """The right side of a variable's equation at an instant."""
    equation = next(e for e in model.equations if e.lhs.op == "var" and e.lhs.value == variable)
    leaf = {"time": time}.get
    return evaluate(equation.rhs, lambda n: leaf(n.op), lambda e, v: call_value(e, v, model.functions))


def test_loops_and_calls_give_their_value(model: flat.FlatModel) -> None:
    assert value(model, "r", 9.0) == pytest.approx(3.0, abs=1e-12)
    assert value(model, "d[1]", 1.0) == pytest.approx(1 / 3, abs=1e-12)
    assert value(model, "d[3]", 1.0) == pytest.approx(2 / 3, abs=1e-12)


def test_what_fails_or_does_not_end_has_no_value(model: flat.FlatModel) -> None:
    assert value(model, "e", 3.0) is None
    call = next(n for e in model.equations for n in ex.walk(e.rhs) if n.op == "call" and "direction" in str(n.value))
    zero = ex.node("call", (ex.array(*[ex.const(0.0)] * 3),), call.value, call.type)
    assert evaluate(zero, lambda n: None, lambda e, v: call_value(e, v, model.functions)) is None
