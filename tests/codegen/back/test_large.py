"""Large models compute bit for bit what they would as small ones, and what they cost grows with them and no faster.

Growth is counted, not timed: calls of functions, lines of code, nodes of expressions, entries of the Jacobian.
"""

from __future__ import annotations

from functools import cache
from pathlib import Path
import re
import sys
from types import FrameType

import numpy as np
import pytest

from lacuna.codegen.compile import translate
from lacuna.codegen.emit.callbacks import large
from lacuna.codegen.emit.source import generate
from lacuna.codegen.emit.text import rolled
from lacuna.codegen.symbolic.expr import own_table
from tests.codegen.generated import Generated, write_model

ROOT = Path(__file__).parents[3]
GROWTH = ROOT / "bench" / "growth"
MODELS = ["Actuators.FlightControlEma", str(ROOT / "tests/codegen/back/golden/Diode.mo")]
BLOCKS = """model Blocks "States, assignments in chains, divisions by states and blocks, all of them arrays"
  parameter Integer n = 40;
  parameter Real k[n](each min = 0) = {1 + 0.1*j for j in 1:n};
  Real x[n](start = {cos(j) for j in 1:n}, each fixed = true), a[n], b[n], q[n];
  Boolean high[n];
equation
  for j in 1:n loop
    a[j] = sin(x[j])*k[j] + (if high[j] then 1 else exp(-x[j]^2));
    high[j] = x[j] > 0.1*j;
    b[j]*(2 + cos(x[j])) = a[j] + time;
    q[j] + 0.1*sin(q[j]) = b[j] + x[mod(j, n) + 1];
    der(x[j]) = q[j]*b[j] - x[j] + sqrt(1 + x[j]^2);
    assert(x[j] < 100 + a[j], "too far");
  end for;
end Blocks;
"""


def _everything(model: Generated) -> list[np.ndarray]:
    """What all callbacks for continuous time give at some points, with random relations."""
    d, random = model.descriptor, np.random.default_rng(11)
    found = [model.arrays["p"].copy(), model.arrays["x"].copy(), model.arrays["v"].copy(), model.arrays["d"].copy()]
    for _ in range(4):
        model.arrays["rel"][: d.n_rel] = random.integers(0, 2, d.n_rel)
        x = model.arrays["x"][: d.n_x] + 0.2 * random.normal(size=d.n_x)
        xdot, v = model.rhs(0.3, x)
        y, yp = model.dae_point(0.3, x)
        yp = yp + 0.1 * random.normal(size=len(yp))
        g, values = np.zeros(d.n_rel + 1), np.zeros(d.jac_nnz + 1)
        assert model.call("jacobian", 0.3, y, yp, 17.0, values) == 0
        assert model.call("roots", 0.3, x, xdot, v, g) == 0
        assert model.call("check", 0.3, x, xdot, v) == 0
        found += [xdot, v, model.residual(0.3, y, yp), values, g]
    assert model.call("initial_system", 0.0) == 0
    return [*found, model.arrays["x"].copy(), model.arrays["xdot"].copy(), model.arrays["v"].copy()]


@pytest.mark.parametrize("name", [*MODELS, "Blocks"])
def test_large_and_small_are_one(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    model = write_model(tmp_path, BLOCKS) if name == "Blocks" else name
    results = []
    for limit in (100_000, 0):
        monkeypatch.setattr(large, "LARGE", limit)
        monkeypatch.setattr(rolled, "ALIKE", 2)
        monkeypatch.setattr(rolled, "PART", 7)
        results.append(_everything(Generated(model, tmp_path / str(limit))))
    for small, rolled_up in zip(*results, strict=True):
        np.testing.assert_array_equal(small, rolled_up)


def _costs(name: str, n: int) -> dict[str, float]:
    calls = 0

    def count(frame: object, event: str, argument: object) -> None:
        nonlocal calls
        calls += event == "call"

    with own_table() as table:
        sys.setprofile(count)
        prepared, _ = translate(str(GROWTH / f"{name}.mo"), modifications={"n": n})
        source = generate(prepared)
        sys.setprofile(None)
    code = source[source.index("static int mdl_parameters") :]
    return {
        "calls": calls,
        "nodes": len(table.nodes),
        "entries": sum(map(len, prepared.jacobian.entries)),
        "unknowns": len(prepared.residual.tears) + n,
        "tables": len(source) - len(code),
        "code": len(re.sub(r"\d+|static const int at.*", "", code)),  # without the tables of indices
    }


@pytest.mark.parametrize("name", ["Ladder", "Chain"])
def test_costs_grow_with_the_model_and_no_faster(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(large, "LARGE", 100)  # so that these are large already
    small, double = _costs(name, 150), _costs(name, 300)
    for cost in ("calls", "nodes", "entries", "unknowns", "tables"):
        assert double[cost] <= 2.1 * small[cost], cost
    assert double["code"] <= 1.25 * small["code"]  # more passes of the same loops; the ground's current is a longer sum
    assert small["entries"] <= 4 * 150


SPECTRUM = """model M
  function spread "Not inlined: how often its loop runs is not known before"
    input Real u[:];
    output Real a[size(u, 1)];
  protected
    Integer i = 1;
  algorithm
    a := u;
    while i < size(u, 1) and u[i] < 1e9 loop
      a[i] := u[i] + a[i + 1];
      i := i + 1;
    end while;
  end spread;
  function scaled
    input Real x;
    output Real y = 2*x;
  algorithm
  end scaled;
  Real u[{n}] = {{sin(k*time) for k in 1:{n}}};
  Real a[{n}];
equation
  when time > 0.5 then
    a = scaled(spread(u));
  end when;
end M;
"""


def test_results_of_a_function_do_not_each_look_at_all_of_its_inputs(tmp_path: Path) -> None:
    @cache
    def counted(file: str) -> bool:
        return "flatten" in Path(file).parts or Path(file).parent.name == "symbolic"

    def calls(n: int) -> int:
        """While expressions are made and looked at; which result follows which input is asked later, of each pair."""
        count = 0

        def profile(frame: FrameType, event: str, argument: object) -> None:
            nonlocal count
            count += event == "call" and counted(frame.f_code.co_filename)

        name = write_model(tmp_path, SPECTRUM.format(n=n))
        with own_table():
            sys.setprofile(profile)
            translate(name)
            sys.setprofile(None)
        return count

    assert calls(400) <= 2.2 * calls(200)


SHARED = """model M
  function f
    input Real x;
    output Real y;
  algorithm
    y := {body};
  end f;
  Real y = {call};
  Real A[2, 2] = [time, 1; -1, 2]^{power};
end M;
"""


@pytest.mark.parametrize("body", ["x + x", "x*x", "x^x", "max(x, -x)*x"])
def test_what_stands_in_many_places_is_looked_at_once(body: str, tmp_path: Path) -> None:
    """Each call of f doubles the places in which time stands: 2^20 were walked through, and 2^40 without end."""

    def calls(depth: int) -> int:
        counted = 0

        def count(_frame: object, event: str, _argument: object) -> None:
            nonlocal counted
            counted += event == "call"

        call = "f(" * depth + "time" + ")" * depth
        text = SHARED.format(body=body, call=call, power=2**depth)
        with own_table():
            path = write_model(tmp_path, text)
            sys.setprofile(count)
            generate(translate(path)[0])
            sys.setprofile(None)
        return counted

    few, twice = calls(9), calls(18)
    assert twice <= 2.5 * few


@pytest.mark.parametrize("name", ["Ladder", "Chain"])
def test_large_models_are_right(name: str, tmp_path: Path) -> None:
    """Against the equations written out with NumPy, at a random point."""
    n = 300
    model = Generated(str(GROWTH / f"{name}.mo"), tmp_path, modifications={"n": n})
    x = np.random.default_rng(3).normal(size=n)
    xdot, _ = model.rhs(0.0, x)
    if name == "Ladder":
        i = -np.diff(np.r_[1.0, x]) / 100
        expected = (i - np.r_[i[1:], 0.0]) / 1e-6
    else:
        s, v = x[0::2], x[1::2]
        f = 1e4 * np.diff(np.r_[0.0, s]) + np.diff(np.r_[0.0, v])
        expected = np.empty(n)
        expected[0::2], expected[1::2] = v, (np.r_[f[1:], 1.0] - f) / 0.1
    np.testing.assert_allclose(xdot, expected, rtol=1e-11, atol=1e-9 * np.abs(expected).max())
