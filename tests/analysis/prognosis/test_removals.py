"""What a page advises first: what is to be removed now, else which part is next."""

from __future__ import annotations

from pathlib import Path

import pytest

import lacuna
from lacuna.analysis.prognosis.pages.telling import NAMED, Advice, removals, whom


def advice(who: str, advised: float | None, at: float = 100.0) -> Advice:
    return Advice(who, advised, at, "cycles")


@pytest.mark.parametrize(
    ("advised", "verdict", "action"),
    [
        ([], "0 of 3 actuators are", "go on testing: no removal is due"),
        ([advice("A", None)], "0 of 3 actuators are", "go on testing: no removal is due"),
        ([advice("A", 100), advice("B", 90), advice("C", 300)], "2 of 3 actuators are", "remove A, B"),
        (
            [advice("A", 900, at=850), advice("B", 300)],
            "0 of 3 actuators are",
            "A is the first to be removed, after its test at 900 cycles (in 50)",
        ),
    ],
)
def test_the_part_that_is_due_is_named(advised: list[Advice], verdict: str, action: str) -> None:
    said = removals(advised, 3)
    assert said[0].startswith(verdict) and action in said[1]


def test_the_verdict_says_at_what_risk() -> None:
    assert removals([advice("A", 50)], 2, limit="violet", risk=1e-3)[0] == (
        "1 of 2 actuators is to be removed now: at its next test the risk of violet is above 0.1 %."
    )
    assert removals([advice("A", 900)], 2, limit="violet", risk=1e-3)[0].endswith("to be removed now.")


def test_a_long_list_is_counted() -> None:
    _, action = removals([advice(f"A{k}", 0) for k in range(NAMED + 5)], 40)
    assert action.endswith("and 5 more") and "A0, A1" in action


def test_what_reads_beyond_the_limit_is_not_passed_over() -> None:
    assert removals([advice("A", 900)], 2, ["B"])[1].startswith("repeat the test of B, or remove")
    assert removals([advice("A", 50)], 2, ["B"])[1].startswith("remove A; repeat the test of B")


def test_one_actuator_and_a_second_fault() -> None:
    assert removals([], 1)[0] == "0 of 1 actuator is to be removed now."
    assert whom("A1", "friction") == "A1 (friction)" and whom("A1", "") == "A1"


def test_a_last_test_beyond_the_limit_is_said_though_nothing_is_forecast(tmp_path: Path) -> None:
    rows = "B,0,0.02,0.01,0.03\nB,100,0.45,0.44,0.46\nC,0,0.02,0.01,0.03\nC,100,0.021,0.01,0.03\n"
    (tmp_path / "history.csv").write_text(f"actuator,cycles,severity,low,high\n{rows}", encoding="utf-8")
    said = lacuna.forecast(tmp_path / "history.csv", out=tmp_path / "out")
    assert said.warnings == ["B: what was read lies beyond the last limit: repeat the test, or remove the part"]
    assert "repeat the test of B, or remove" in (tmp_path / "out" / "report.html").read_text(encoding="utf-8")
