"""A sign that changes through infinity is no root: blocks of one unknown that have no solution, or another one."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.cli.test_hostile_models import simulated


@pytest.mark.parametrize(
    "equation", ["1/y = time", "1/y = 0*time", "1/y = 1e-300", "1/y = time - 0.5", "3/(y - 2) = 0*time"]
)
def test_a_pole_is_no_root(tmp_path: Path, equation: str) -> None:
    """y = 3.6e-16 was told, where 1/y is 3e15."""
    status, said = simulated(tmp_path, f"model M Real y(start=1); equation {equation}; end M;", "--stop", "1")
    assert (status, "did not converge" in said) == (1, True), said


@pytest.mark.parametrize(
    ("equation", "y"),
    [("1/y = 1 + time", 0.5), ("1/y = -time - 0.001", -1 / 1.001), ("2/(y - 0.5) = 10*time + 10", 0.6),
     ("1/y + y = 2.5 + 0*time", 0.5), ("exp(10*y) = 1e4 + 0*time", 0.9210340371976184),
     ("atan(y - 300) = 0.5*time", 300.5463024898438), ("y^3 = 27 + 0*time", 3.0)],
)  # fmt: skip
def test_roots_are_found_as_before(tmp_path: Path, equation: str, y: float) -> None:
    status, said = simulated(tmp_path, f"model M Real y(start=0.3); equation {equation}; end M;", "--stop", "1")
    assert status == 0, said
    last = (tmp_path / "out" / "M.csv").read_text().splitlines()[-1]
    assert float(last.split(",")[1]) == pytest.approx(y, rel=1e-8)


def test_an_integer_parameter_is_one(tmp_path: Path) -> None:
    """What is computed from Reals passed the limit of those that are given."""
    status, said = simulated(tmp_path, "model M parameter Real p = 1e300; parameter Integer i = integer(p); end M;")
    assert (status, "from 2^53 on" in said) == (1, True), said


@pytest.mark.parametrize("a", [-9007199254740991, 9007199254740991, -9007199254740989, 12, -12])
@pytest.mark.parametrize("b", [3, -3, 7, -7])
def test_whole_numbers_divide_exactly(tmp_path: Path, a: int, b: int) -> None:
    """Quotients near 2^53 are rounded, and the rest of them was taken for that of the division."""
    text = f"parameter Integer a = {a}, b = {b}; Integer m = mod(a, b), d = div(a, b), r = rem(a, b);"
    assert simulated(tmp_path, f"model M {text} end M;")[0] == 0
    row = (tmp_path / "out" / "M.csv").read_text().splitlines()[1].split(",")[1:]
    whole = abs(a) // abs(b) * (1 if (a < 0) == (b < 0) else -1)
    assert [int(float(x)) for x in row] == [a % b, whole, a - whole * b]
