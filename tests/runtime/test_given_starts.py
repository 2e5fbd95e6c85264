"""States that the caller gives are what initial equations begin with: others follow, and so do derivatives."""

from __future__ import annotations

from pathlib import Path

import pytest

from lacuna import runtime
from lacuna.codegen.compile import compile_model

FOLLOWING = """model Following
  parameter Real gain = 2;
  Real x(start=1, fixed=true), y, z;
initial equation
  y = gain*x;
  der(z) = 0;
equation
  der(x) = -x;
  der(y) = -y;
  der(z) = y - z;
end Following;
"""


def following(tmp_path: Path, sensitivities: bool = False) -> runtime.Model:
    (tmp_path / "Following.mo").write_text(FOLLOWING, encoding="utf-8")
    return runtime.Model(compile_model(str(tmp_path / "Following.mo"), sensitivities=sensitivities).path)


@pytest.mark.parametrize("x", [None, 3.0])
def test_what_initial_equations_tell_follows_them(tmp_path: Path, x: float | None) -> None:
    """It followed the declared start value: a slow sensor began with a reading that nobody had given."""
    given = {} if x is None else {"x": x}
    result = runtime.simulate(following(tmp_path), stop=0.1, initial=given)
    begin = 1.0 if x is None else x
    assert [result[n][0] for n in ("x", "y", "z")] == pytest.approx([begin, 2 * begin, 2 * begin])


def test_so_do_derivatives(tmp_path: Path) -> None:
    result = runtime.simulate(
        following(tmp_path, sensitivities=True), stop=0.1, initial={"x": 3.0}, sensitivities=["x", "gain"]
    )
    assert [result.sensitivity(n, "x")[0] for n in ("x", "y", "z")] == pytest.approx([1, 2, 2])
    assert [result.sensitivity(n, "gain")[0] for n in ("x", "y", "z")] == pytest.approx([0, 3, 3])
