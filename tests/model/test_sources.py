"""Command signals against their definitions."""

from __future__ import annotations

import numpy as np
import pytest

SOURCE = "model Test\n  Lacuna.Components.Sources.{0};\nend Test;"


def steps(t: np.ndarray) -> np.ndarray:
    return np.where(t < 0.3, 1.0, 3.0)


def ramp(t: np.ndarray) -> np.ndarray:
    return 1 + 2 * np.clip((t - 0.2) / 0.5, 0, 1)


def sine(t: np.ndarray) -> np.ndarray:
    return 0.5 + 2 * np.sin(2 * np.pi * 3 * np.maximum(t - 0.1, 0) + 0.4)


def chirp(t: np.ndarray) -> np.ndarray:
    """The instantaneous frequency, from the phase's derivative, is f0 + (f1 - f0) t/duration, then f1."""
    return np.sin(np.where(t < 0.5, 2 * np.pi * (t + 4 * t * t), 2 * np.pi * (1.5 + 5 * (t - 0.5))))


def trapezoid(t: np.ndarray) -> np.ndarray:
    return -1 + 2 * np.interp(np.mod(t - 0.1, 0.4), [0, 0.1, 0.2, 0.3, 0.4], [0, 1, 1, 0, 0]) * (t >= 0.1)


@pytest.mark.parametrize(
    ("source", "expected"),
    [
        ("Step s(height=2, offset=1, t_start=0.3)", steps),
        ("Ramp s(height=2, offset=1, t_start=0.2, duration=0.5)", ramp),
        ("Sine s(amplitude=2, f=3, phase=0.4, offset=0.5, t_start=0.1)", sine),
        ("Chirp s(f0=1, f1=5, duration=0.5)", chirp),
        ("Trapezoid s(amplitude=2, offset=-1, rising=0.1, width=0.1, falling=0.1, period=0.4, t_start=0.1)", trapezoid),
    ],
)
def test_signal(run, source: str, expected) -> None:
    result = run(SOURCE.format(source), stop=1.0, output_times=np.linspace(0.005, 0.995, 100), events=False)
    assert np.abs(result["s.y"] - expected(result.time)).max() < 1e-9


def test_table_from_csv_is_linear_between_samples_and_constant_beyond(run, tmp_path) -> None:
    (tmp_path / "load.csv").write_text("# hinge moment\ntime,y,z\n0.1,1,5\n0.3,-2,5\n0.35,4,5\n0.8,4.5,5\n")
    result = run(SOURCE.format('CsvTable s(fileName="load.csv")'), stop=1.0, interval=0.01)
    expected = np.interp(result.time, [0.1, 0.3, 0.35, 0.8], [1, -2, 4, 4.5])
    assert np.abs(result["s.y"] - expected).max() < 1e-12


def test_contradicting_trapezoid_is_refused(run) -> None:
    with pytest.raises(AssertionError, match="must fit into the period"):
        run(SOURCE.format("Trapezoid s(rising=0.5, width=0.5, falling=0.5, period=1)"), stop=1.0)
