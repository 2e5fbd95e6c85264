"""A condition that holds at one instant only starts no event, and a warning says so."""

from __future__ import annotations

from pathlib import Path

import pytest

from lacuna.codegen.compile import translate

MODEL = """model M
  Real x(start=0, fixed=true), y; discrete Integer n(start=0, fixed=true);
equation
  der(x) = 1;
  y = if x < 5 or x > 6 then 1 else 0;
  when {condition} then
    n = pre(n) + 1;
  end when;
end M;
"""


@pytest.mark.parametrize(
    ("condition", "warned"),
    [
        ("time >= 0.5 and time <= 0.5", True),
        ("x <= 1 and y > 0 and 1 <= x", True),
        ("not time < 0.5 and not time > 0.5", True),
        ("time >= 0.5 and time <= 0.6", False),
        ("x >= 1", False),
        ("x >= 1 or x <= 1", False),
    ],
)
def test_a_condition_of_one_instant_is_warned_of(tmp_path: Path, condition: str, warned: bool) -> None:
    path = tmp_path / "M.mo"
    path.write_text(MODEL.format(condition=condition), encoding="utf-8")
    _, report = translate(str(path), search_path=[])
    assert [(w.code, w.span.line) for w in report.warnings] == ([("S025", 6)] if warned else [])
