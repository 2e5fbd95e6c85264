"""A model file judged on recordings: on those that can be trusted, and as far as its start is known."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import lacuna
from lacuna.diagnoses import Judged
from lacuna.discovery.case.problem import CaseError

from .recorded import TANK

CASE = """title = "Tank"
model = "Tank.mo"
[parameters]
k = 2.8e-4
[signals.q]
role = "input"
unit = "m3/s"
[signals.h]
role = "output"
unit = "m"
noise_std = 0.002
[recordings]
fit = ["fit.csv"]
validate = ["unseen.csv"]
"""


@pytest.fixture
def rows(tmp_path: Path) -> np.ndarray:
    """Of the closed form of a tank, recorded: time in s, q in m3/s, h in m; the case is in `tmp_path`."""
    (tmp_path / "Tank.mo").write_text(TANK.format(outflow="k*h"), encoding="utf-8")
    (tmp_path / "case.toml").write_text(CASE, encoding="utf-8")
    time = np.arange(200) * 1.0
    level = 0.1 + 0.1 * np.exp(-time * 0.03) + 0.002 * np.random.default_rng(1).normal(size=200)
    table = np.column_stack([time, np.full(200, 3e-5), level])
    record(tmp_path / "fit.csv", table)
    return table


def record(path: Path, rows: np.ndarray) -> None:
    np.savetxt(path, rows, "%.6g", ",", header="time,q,h", comments="")


def judged(folder: Path, model: str = "Tank.mo") -> Judged:
    return lacuna.open_case(folder).judge(folder / model, out=folder / "out")


def test_a_class_in_a_file_is_judged(tmp_path: Path, rows: np.ndarray) -> None:
    record(tmp_path / "unseen.csv", rows)
    inside = TANK.format(outflow="k*h")
    (tmp_path / "Plant.mo").write_text(f"package Plant\n{inside}\nend Plant;\n", encoding="utf-8")
    assert judged(tmp_path, "Plant.mo:Plant.Tank").validate == judged(tmp_path).validate


def test_recordings_that_no_fit_takes_are_not_judged_either(tmp_path: Path, rows: np.ndarray) -> None:
    rows[[60, 80]] = rows[[80, 60]]
    record(tmp_path / "unseen.csv", rows)
    with pytest.raises(CaseError, match=r"cannot be trusted: unseen\.csv, column `time`, t = .* does not increase"):
        judged(tmp_path)


def test_what_comes_after_a_gap_is_left_out_and_said(tmp_path: Path, rows: np.ndarray) -> None:
    """An inflow that was off in the gap: the level behind it is another, which no model knows."""
    rows[120:, 2] -= 0.1
    record(tmp_path / "unseen.csv", rows)
    wrong = judged(tmp_path).validate[""]
    record(tmp_path / "unseen.csv", np.delete(rows, range(100, 120), axis=0))
    found = judged(tmp_path)
    assert found.validate[""] < 0.1 < wrong
    assert any("gap of 21 s" in problem for problem in found.problems)
    assert any("unseen.csv[2]: not judged" in problem for problem in found.problems)


def test_nothing_before_a_gap_is_a_sentence(tmp_path: Path, rows: np.ndarray) -> None:
    record(tmp_path / "unseen.csv", np.delete(rows, range(20, 40), axis=0))
    with pytest.raises(CaseError, match="nothing is left to judge by before a gap"):
        judged(tmp_path)
