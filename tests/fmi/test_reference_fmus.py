"""The models of the FMI project's Reference-FMUs in our language, against that project's own output files.

Those come from explicit Euler at a fixed step with events at its ends, so Euler here has to give them to rounding. They
are not part of this repository: LACUNA_REFERENCE_FMUS is the folder of a checkout of modelica/Reference-FMUs.
"""

from __future__ import annotations

import csv
import os
from pathlib import Path

import numpy as np
import pytest

import lacuna

MODELS = Path(__file__).parent / "models"
FOLDER = os.environ.get("LACUNA_REFERENCE_FMUS", "")
if not Path(FOLDER, "VanDerPol", "VanDerPol_out.csv").is_file():
    pytest.skip("LACUNA_REFERENCE_FMUS names no checkout of modelica/Reference-FMUs", allow_module_level=True)

STATE_SPACE = """model StateSpace
  parameter Real A[3, 3] = identity(3), B[3, 3] = identity(3), C[3, 3] = identity(3), D[3, 3] = identity(3);
  parameter Real u[3] = {1, 2, 3};
  Real x[3](each start=0, each fixed=true), y[3];
equation
  der(x) = A*x + B*u;
  y = C*x + D*u;
  annotation(experiment(StopTime=10));
end StateSpace;
"""
# s, FIXED_SOLVER_STEP of each model's config.h
STEPS = {"Dahlquist": 0.1, "VanDerPol": 1e-2, "BouncingBall": 1e-3, "Stair": 0.2, "StateSpace": 1e-3}


def published(name: str) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """Times, and the columns by our names: an array of theirs is one column with spaces."""
    with Path(FOLDER, name, f"{name}_out.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    columns: dict[str, np.ndarray] = {}
    for head in [head for head in rows[0] if head != "time"]:
        values = np.array([[float(v) for v in row[head].split()] for row in rows])
        names = [head] if values.shape[1] == 1 else [f"{head}[{k}]" for k in range(1, values.shape[1] + 1)]
        columns |= dict(zip(names, values.T, strict=True))
    return np.array([float(row["time"]) for row in rows]), columns


@pytest.mark.parametrize("name", STEPS)
def test_euler_gives_the_published_digits(name: str, tmp_path: Path) -> None:
    model = MODELS / f"{name}.mo"
    if name == "StateSpace":
        model = tmp_path / "StateSpace.mo"
        model.write_text(STATE_SPACE, encoding="utf-8")
    time, columns = published(name)
    result = lacuna.load(model).simulate(
        solver="euler", step=STEPS[name], locate_events=False, stop=time[-1], interval=round(time[1] - time[0], 9)
    )
    assert result.time == pytest.approx(time, abs=1e-9)
    steps = time[-1] / STEPS[name]
    for head, values in columns.items():
        # Both add the same terms in another order: rounding grows with the number of steps at most.
        bound = steps * np.finfo(float).eps * max(1.0, float(np.abs(values).max()))
        assert float(np.max(np.abs(result[head] - values))) <= bound, head


def test_what_feedthrough_passes_on_without_inputs_is_what_is_published() -> None:
    """Of the kinds that our language has. (Roberts' published file holds another model's columns; Resource reads a file
    of the FMU while it runs, and Clocks needs clocks: what an FMU of ours does not have.)"""
    with Path(FOLDER, "Feedthrough", "Feedthrough_out.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    time = np.array([float(row["time"]) for row in rows])
    result = lacuna.load(MODELS / "Feedthrough.mo").simulate(stop=time[-1], interval=round(time[1] - time[0], 9))
    assert result.time == pytest.approx(time, abs=1e-9)
    for theirs, ours in {"Float64_continuous_output": "y", "Int32_output": "m", "Boolean_output": "c"}.items():
        assert [float({"false": "0", "true": "1"}.get(row[theirs], row[theirs])) for row in rows] == list(result[ours])
