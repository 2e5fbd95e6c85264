"""Recordings of cases that tests write: a simulated machine, read with errors."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from lacuna.runtime import Model, RecordedInput, simulate


def record(
    path: Path, machine: Model, time: np.ndarray, inputs: Mapping[str, np.ndarray], outputs: Mapping[str, str],
    errors: Mapping[str, np.ndarray],
) -> None:  # fmt: skip
    """Write `path`: time (s), the `inputs` by their names, linear between samples, and of each column of `outputs` its
    variable with its `errors` added."""
    run = simulate(
        machine, solver="dopri5", rtol=1e-9, inputs={n: RecordedInput(time, v) for n, v in inputs.items()},
        start=0.0, stop=float(time[-1]), output_times=time, outputs=list(outputs.values()), events=False,
    )  # fmt: skip
    columns = {"time": time, **inputs} | {n: run[v] + errors[n] for n, v in outputs.items()}
    np.savetxt(path, np.column_stack(list(columns.values())), "%.8g", ",", header=",".join(columns), comments="")
