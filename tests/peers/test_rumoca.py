"""The same Modelica files through rumoca, a translator that shares nothing with ours, give the same trajectories."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna import runtime
from lacuna.codegen.compile import compile_model

rumoca = pytest.importorskip("rumoca", reason="rumoca is a test-only dependency; install requirements.lock")

ROOT = Path(__file__).parents[2]
OWN = sorted([*(Path(__file__).parent / "models").glob("*.mo"), *(ROOT / "tests" / "models").glob("*.mo")])
TOLERANCE = 1e-5  # of the largest magnitude of a variable
RTOL, ATOL = 1e-9, 1e-11  # for both; global errors grow from these by some orders of magnitude
POINTS = 1000


def theirs(path: Path, stop: float):
    try:
        model = rumoca.Session().load(str(path), model=path.stem)
        config = rumoca.SimConfig(rtol=RTOL, atol=ATOL, dt=stop / POINTS, max_wall_seconds=60.0)
        return model.simulate(t=(0.0, stop), config=config)
    except rumoca.RumocaError as error:
        pytest.skip(f"rumoca does not take {path.name}: {str(error).splitlines()[0]}")


def first_rows_of_the_grid(time: np.ndarray, grid: np.ndarray) -> np.ndarray:
    """Rows of `time` (with further rows at events) that lie on `grid`."""
    rows = np.searchsorted(time, grid - 1e-9 * grid[-1])
    assert np.max(np.abs(time[rows] - grid)) < 1e-9 * grid[-1]
    return rows


def assert_agreement(path: Path) -> None:
    model = runtime.Model(compile_model(str(path)).path)
    stop = model.stop_time
    other = theirs(path, stop)
    grid = np.linspace(0.0, stop, POINTS + 1)
    rows = first_rows_of_the_grid(np.asarray(other.time), grid)
    ours = runtime.simulate(model, stop=stop, rtol=RTOL, atol=ATOL, output_times=grid, events=False)
    assert ours.complete, ours.failure
    compared = [name for name in other.names if name in model.variables and model.variables[name].type == "Real"]
    assert compared, "no variable in common"
    event_times = np.array([event.time for event in ours.event_log])
    away = np.all(np.abs(grid[:, None] - event_times[None, :]) > 1e-6 * stop, axis=1)
    for name in compared:
        value, expected = ours[name][away], np.asarray(other[name])[rows][away]
        scale = np.max(np.abs(expected))
        assert np.max(np.abs(value - expected)) <= TOLERANCE * scale + 1e-12, name


@pytest.mark.parametrize("path", OWN, ids=lambda path: path.stem)
def test_own_models_agree_with_rumoca(path: Path) -> None:
    assert_agreement(path)


@pytest.mark.parametrize("name", ["ServoT1", "BldcT2"])
def test_benchmark_files_agree_with_rumoca(name: str, shared: Path) -> None:
    assert_agreement(shared / "benchmarks" / f"{name}.mo")
