"""What the oracle once found, and a few of its rounds with fixed seeds; more of them: python -m tests.fuzz.oracle."""

from __future__ import annotations

from pathlib import Path

import pytest

from lacuna import runtime
from tests.fuzz.oracle.__main__ import round_of
from tests.fuzz.oracle.judge import run

FUNCTION = """model M
  function f
    input Integer n;
    input Real u;
    input Boolean c;
    output Real y;
  protected
    Boolean d = c;
    Real a[2];
  algorithm
    {body}
  end f;
  Real x = f(integer(7*time), time, time > 0.5);
end M;
"""


@pytest.mark.parametrize("seed", range(3))
def test_random_models_are_worth_what_the_oracle_says(seed: int, tmp_path: Path) -> None:
    tried, found = round_of(seed, tmp_path)
    assert tried.total() > 20
    assert [f for f in found if f.what in ("wrong", "crashed")] == []


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        # A break leaves the loop over a list that it stands in, not the one around that.
        ("y := 0; for i in 1:3 loop for j in {1, 2, 3} loop if j == n then break; end if; y := y + j; end for; "
         "y := y + 100; end for;", lambda t: 300 + 3 * sum(range(1, int(7 * t))) if 1 <= int(7 * t) <= 3 else 318),
        ("y := 0; for j in {1} loop if n > 3 then break; end if; y := 5; end for;", lambda t: 5 * (int(7 * t) <= 3)),
        ("y := 0; for i in 1:2, j in {1, 2} loop if j == n then break; end if; y := y + 10*i + j; end for;",
         lambda t: {1: 0, 2: 32}.get(int(7 * t), 66)),
        # A Real that holds the value of an Integer is a Real.
        ("y := 2*n; for j in {1, 3} loop y := y/4; end for;", lambda t: int(7 * t) / 8),
        ("a := {n, 1}; a[1] := a[1]/2; y := a[1];", lambda t: int(7 * t) / 2),
        # A comparison with itself is one.
        ("y := if d == (d == d) then 1 else 2; for i in 1:n loop y := y + 1; end for;",
         lambda t: (1 if t > 0.5 else 2) + int(7 * t)),
        ("y := 0; for i in 1:n loop if (not d) <> c then y := y + 1; end if; end for;", lambda t: int(7 * t)),
    ],
)  # fmt: skip
def test_a_function_is_worth_what_its_statements_say(body: str, expected: object, tmp_path: Path) -> None:
    result = run(FUNCTION.format(body=body), tmp_path, "dopri5")
    assert isinstance(result, runtime.Result), result
    for t, x in zip(result.time, result["x"], strict=True):
        assert x == expected(t), t


@pytest.mark.parametrize("wrapped", ["noEvent({})", "smooth(0, {})", "{}"])
@pytest.mark.parametrize(
    ("asked", "expected"),
    [("edge(b)", 2), ("change(n)", 2), ("sample(0.25, 9)", 2), ("not initial() and n > 0", 1), ("pre(n) > 0", 1)],
)
def test_what_asks_for_an_instant_may_stand_anywhere(wrapped: str, asked: str, expected: int, tmp_path: Path) -> None:
    """Where an event is over b has no edge: 2 it is, as a clause that acts at the edge saw it."""
    value = wrapped.format(f"(if {asked} then 1 else 2)")
    result = run(
        f"""model M
  Boolean b(start=false, fixed=true);
  Integer n(start=0, fixed=true);
  Integer seen(start=0, fixed=true);
  Real y;
equation
  b = time > 0.5;
  y = {value};
  when b then
    n = pre(n) + 1;
    seen = {value.replace("noEvent(", "integer(").replace("smooth(0, ", "integer(")};
  end when;
end M;
""",
        tmp_path,
        "ida",
    )
    assert isinstance(result, runtime.Result), result
    assert (result["y"][-1], result["seen"][-1]) == (
        expected,
        1 if asked in ("edge(b)", "change(n)") else result["seen"][-1],
    )
