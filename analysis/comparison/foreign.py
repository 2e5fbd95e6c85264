"""An FMU of whatever tool, simulated by FMPy: columns to hold a model against."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from pathlib import Path

import numpy as np

from lacuna import runtime
from lacuna.analysis.errors import AnalysisError


def simulate_fmu(
    path: Path,
    names: Collection[str],
    start: float,
    stop: float,
    interval: float,
    rtol: float,
    parameters: Mapping[str, float],
    inputs: Mapping[str, runtime.RecordedInput | float],
) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """Time (s, [rows]) and each Real variable of the FMU that is in `names`, [rows].

    Model exchange by CVODE where the FMU has it, else co-simulation. `parameters` and `inputs` that the FMU does not
    have are refused. Its binary is run: use FMUs of those you trust.
    """
    import fmpy

    if not path.is_file():
        raise AnalysisError(f"{path}: there is no such file")
    try:
        description = fmpy.read_model_description(str(path))
    except Exception as error:
        raise AnalysisError(f"{path} is no FMU that can be read: {error}") from None
    theirs = {v.name: v for v in description.modelVariables}
    outputs = [n for n, v in theirs.items() if n in names and v.type in ("Real", "Float64")]
    if not outputs:
        raise AnalysisError(f"{path} and the model have no variable of the same name")
    unknown = [n for n in (*parameters, *inputs) if n not in theirs]
    if unknown:
        raise AnalysisError(f"{path} has no {', '.join(unknown)}, which the comparison sets")
    try:
        found = fmpy.simulate_fmu(
            str(path), start_time=start, stop_time=stop, output_interval=interval, relative_tolerance=rtol,
            fmi_type="ModelExchange" if description.modelExchange is not None else "CoSimulation", solver="CVode",
            start_values={**parameters, **{n: v for n, v in inputs.items() if isinstance(v, float)}},
            input=_signals({n: v for n, v in inputs.items() if not isinstance(v, float)}, start),
            output=outputs, record_events=False,
        )  # fmt: skip
    except Exception as error:
        raise AnalysisError(f"{path} cannot be simulated: {error}") from None
    return np.asarray(found["time"], dtype=float), {n: np.asarray(found[n], dtype=float) for n in outputs}


def _signals(inputs: Mapping[str, runtime.RecordedInput], start: float) -> np.ndarray | None:
    """The inputs as FMPy takes them: one table, linear between its rows, a jump being two rows at one instant."""
    if not inputs:
        return None
    times = np.unique(np.concatenate([[start], *(signal.time for signal in inputs.values())]))
    jumps = any(signal.interpolation == "hold" and len(signal.time) > 1 for signal in inputs.values())
    rows = np.repeat(times, 2)[1:] if jumps else times
    table = np.zeros(len(rows), dtype=[("time", float), *((name, float) for name in inputs)])
    table["time"] = rows
    for name, signal in inputs.items():
        if signal.interpolation == "hold":
            after = np.searchsorted(signal.time, rows, side="right") - 1
            before = np.searchsorted(signal.time, rows, side="left") - 1
            first_of_pair = np.append(np.diff(rows) == 0, False)
            table[name] = signal.values[np.maximum(np.where(first_of_pair, before, after), 0)]
        else:
            table[name] = np.interp(rows, signal.time, signal.values)
    return table
