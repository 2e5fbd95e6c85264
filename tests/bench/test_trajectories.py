"""Deviations from a reference: the last digit of a written time is no error, anything else is."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from bench.trajectories import deviation, read_reference

AT, FAST = 2.0 / 3.0, 1e-6  # s: an event, and the time constant of what decays after it


def decaying(time: np.ndarray, at: float = AT) -> np.ndarray:
    return np.where(time < at, 1.0, np.exp(-np.clip((time - at) / FAST, 0, 700)))


def reference(folder: Path) -> Path:
    """Written with eight digits, both rows at the event: 0.66666667 s is 3.3 ns late, in which the signal falls."""
    time = np.sort(np.append(np.linspace(0, 1, 11), [AT, AT]))
    rows = "".join(f"{t:.8g},{x:.8g}\n" for t, x in zip(time, decaying(time), strict=True))
    path = folder / "reference.csv"
    path.write_text("time,x\n" + rows)
    return path


def test_an_event_between_two_written_times_is_no_deviation(tmp_path: Path) -> None:
    read = read_reference(reference(tmp_path))
    assert read.digits == 8
    assert deviation(read, "x", read.grid, decaying(read.grid)) < 1e-6
    coarse = np.unique(read.time)
    assert deviation(read, "x", coarse, decaying(coarse)) == pytest.approx(1 - np.exp(-1e-8 / 3 / FAST), rel=0.01)


def test_an_event_that_is_late_is_one(tmp_path: Path) -> None:
    read = read_reference(reference(tmp_path))
    early = deviation(read, "x", read.grid, decaying(read.grid, AT - 1e-7))
    assert early == pytest.approx(1 - np.exp(-(1e-7 - 1e-8 / 6) / FAST), rel=0.1)
    assert deviation(read, "x", read.grid, np.full(len(read.grid), np.nan)) == float("inf")
