"""Outputs that a function leaves unassigned in some case: an error where one is read, else no value (12.4.4)."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from lacuna import runtime
from tests.events.models import compiled

MODEL = """model P
  record R Real a; Real b; end R;
  function f
    input Real x;
    output R r;
  algorithm
    r.a := 2*x;
    if x > 5 then
      r.b := 1;
    elseif x < -5 then
      r.b := sqrt(x);
    end if;
  end f;
%s
end P;
"""
VARYING = """    parameter Boolean limited = false;
    R r = f(4*time);
    Real y = r.a + (if limited and r.b > 0 then r.b else 0), s(start=0, fixed=true);
  equation
    der(s) = 1;
    when s > 0.5 then
      reinit(s, 0);
    end when;"""


def run(tmp_path: Path, body: str, **settings: object) -> runtime.Result:
    return runtime.simulate(compiled(tmp_path, MODEL % body), **settings)


@pytest.mark.parametrize("handed_on", ["", "parameter R q = r;"])
def test_a_parameter_that_nobody_reads_may_have_no_value(tmp_path: Path, handed_on: str) -> None:
    body = f"    parameter Real k = 1; parameter R r = f(k); {handed_on} Real y = r.a*time;"
    result = run(tmp_path, body, stop=1)
    assert result.complete
    assert result["y"][-1] == pytest.approx(2)


@pytest.mark.parametrize("solver", ["ida", "dopri5", "rodas4", "rk4"])
def test_so_may_a_variable_through_events(tmp_path: Path, solver: str) -> None:
    result = run(tmp_path, VARYING, solver=solver, step=0.01, stop=2)
    assert result.complete
    assert result["y"][-1] == pytest.approx(16)
    assert math.isnan(result["r.b"][0])
    assert result["r.b"][-1] == 1


def test_where_a_parameter_has_it_read_the_message_names_function_and_output(tmp_path: Path) -> None:
    result = run(tmp_path, VARYING, parameters={"limited": True}, stop=1)
    assert "variable r.b (value nan)" in str(result.failure)
    assert "r.b of f, which nothing assigns in some case" in str(result.failure)


@pytest.mark.parametrize(
    "reader",
    ["Real z = r.b;", "output Real z = 2*r.b;", "Real z = if time < 2 then 0 else r.b;", "parameter Real q = 2*r.b;",
     "Boolean z = r.b > 0;",
     "Real z(start=0, fixed=true); equation der(z) = 1; when time > 2 then reinit(z, r.b); end when;"],
)  # fmt: skip
def test_who_reads_it_ends_the_run(tmp_path: Path, reader: str) -> None:
    result = run(tmp_path, f"    parameter Real k = 1; parameter R r = f(k); Real y = r.a; {reader}", stop=1)
    assert "r.b of f, which nothing assigns in some case" in str(result.failure)


def test_another_number_that_is_none_ends_the_run_where_nobody_reads_it(tmp_path: Path) -> None:
    body = "    parameter Real k = -6; parameter R r = f(k); Real y = r.a*time;"
    assert "variable r.b (value nan)" in str(run(tmp_path, body, stop=1).failure)


def test_a_branch_that_follows_what_has_no_value_counts_as_taken(tmp_path: Path) -> None:
    body = """    parameter Real k = 1; parameter R r = f(k);
    parameter Real switch = if r.b > 0 then 1 else 0;
    Real y = if switch > 0.5 then r.b else 0;"""
    assert "r.b of f, which nothing assigns" in str(run(tmp_path, body, stop=1).failure)
