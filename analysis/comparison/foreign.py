"""An FMU of whatever tool, simulated by FMPy: columns to hold a model against."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from lacuna import runtime
from lacuna.analysis.errors import AnalysisError
from lacuna.recorded_units import UnitError, factor_into, to_si

_NO_NUMBERS = ("String", "Binary", "Clock")


def simulate_fmu(
    path: Path,
    names: Collection[str],
    units: Mapping[str, str],
    start: float,
    stop: float,
    interval: float,
    rtol: float,
    parameters: Mapping[str, float],
    inputs: Mapping[str, runtime.RecordedInput | float],
) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """Time (s, [rows]) and each number of the FMU, an Integer or a Boolean, too, that is in `names`, [rows], in its
    unit in `units`.

    Model exchange by CVODE where the FMU has it, else co-simulation. `parameters` and `inputs` that the FMU does not
    have, or has in another unit, are refused. Its binary is run: use FMUs of those you trust.
    """
    import fmpy

    if not path.is_file():
        raise AnalysisError(f"{path}: there is no such file")
    try:
        description = fmpy.read_model_description(str(path))
    except Exception as error:
        raise AnalysisError(f"{path} is no FMU that can be read: {error}") from None
    theirs = _by_name(description.modelVariables)
    outputs = [n for n, place in theirs.items() if n in names and place.variable.type not in _NO_NUMBERS]
    if not outputs:
        raise AnalysisError(f"{path} and the model have no variable of the same name")
    unknown = [n for n in (*parameters, *inputs) if n not in theirs]
    if unknown:
        raise AnalysisError(f"{path} has no {', '.join(unknown)}, which the comparison sets")
    factors = {n: _factor(path, n, place.variable, units) for n, place in theirs.items()}
    other = [n for n in (*parameters, *inputs) if factors[n] != 1.0]
    if other:
        raise AnalysisError(f"{path} has {', '.join(other)}, which the comparison sets, in another unit than the model")
    set_once = {**parameters, **{n: v for n, v in inputs.items() if isinstance(v, float)}}
    try:
        found = fmpy.simulate_fmu(
            str(path), start_time=start, stop_time=stop, output_interval=interval, relative_tolerance=rtol,
            fmi_type="ModelExchange" if description.modelExchange is not None else "CoSimulation", solver="CVode",
            start_values={n: _whole(v) for n, v in _folded(set_once, theirs).items()},
            input=_signals(inputs, theirs, start),
            output=list({theirs[n].variable.name for n in outputs}), record_events=False,
        )  # fmt: skip
    except Exception as error:
        raise AnalysisError(f"{path} cannot be simulated: {error}") from None
    return np.asarray(found["time"], dtype=float), {n: factors[n] * theirs[n].of(found) for n in outputs}


def _factor(path: Path, name: str, variable: Any, units: Mapping[str, str]) -> float:
    """By what the FMU's values of a variable are multiplied to be in the model's unit, where both say one."""
    theirs, ours = variable.unit or getattr(variable.declaredType, "unit", None) or "", units.get(name, "")
    if not theirs or not ours or theirs == ours:
        return 1.0
    try:
        factor, si = to_si(theirs)
        return factor * factor_into(ours, si)
    except UnitError as error:
        raise AnalysisError(f"{path}: {name} is in {theirs}, in the model in {ours}: {error}") from None


@dataclass(frozen=True)
class _Place:
    """A number of an FMU: a scalar, or the element at `index` of an array."""

    variable: Any
    index: tuple[int, ...] = ()

    def of(self, table: np.ndarray) -> np.ndarray:
        return np.asarray(table[self.variable.name], dtype=float)[(slice(None), *self.index)]


def _by_name(variables: Iterable[Any]) -> dict[str, _Place]:
    """Every number by its name; that of an element is the array's with subscripts, as a model has it."""
    found = {}
    for v in variables:
        for index in np.ndindex(*(v.shape or ())):
            subscripts = f"[{','.join(str(k + 1) for k in index)}]" if index else ""
            found[v.name + subscripts] = _Place(v, index)
    return found


def _folded(values: Mapping[str, Any], theirs: Mapping[str, _Place]) -> dict[str, np.ndarray]:
    """`values` by the variables of the FMU: of an array those that are not given are its start values."""
    found: dict[str, np.ndarray] = {}
    for name, value in values.items():
        v, index = theirs[name].variable, theirs[name].index
        if v.name not in found:
            start = [float({"true": 1, "false": 0}.get(text, text)) for text in str(v.start or 0).split()]
            of_array = np.array(start if v.shape else [0.0]).reshape(v.shape or ())
            found[v.name] = np.broadcast_to(of_array, np.shape(value) + of_array.shape).copy()
        found[v.name][(..., *index)] = value
    return found


def _whole(value: np.ndarray) -> Any:
    """As FMPy takes a start value: a number, or the elements of an array in a row."""
    return value.ravel().tolist() if value.ndim else float(value)


def _signals(
    inputs: Mapping[str, runtime.RecordedInput | float], theirs: Mapping[str, _Place], start: float
) -> np.ndarray | None:
    """The inputs as FMPy takes them: one table, linear between its rows, a jump being two rows at one instant. None
    where all are constant."""
    recorded = {name: signal for name, signal in inputs.items() if not isinstance(signal, float)}
    if not recorded:
        return None
    times = np.unique(np.concatenate([[start], *(signal.time for signal in recorded.values())]))
    jumps = any(signal.interpolation == "hold" and len(signal.time) > 1 for signal in recorded.values())
    rows = np.repeat(times, 2)[1:] if jumps else times
    columns = {name: np.full(len(rows), value) for name, value in inputs.items() if isinstance(value, float)}
    for name, signal in recorded.items():
        if signal.interpolation == "hold":
            after = np.searchsorted(signal.time, rows, side="right") - 1
            before = np.searchsorted(signal.time, rows, side="left") - 1
            first_of_pair = np.append(np.diff(rows) == 0, False)
            columns[name] = signal.values[np.maximum(np.where(first_of_pair, before, after), 0)]
        else:
            columns[name] = np.interp(rows, signal.time, signal.values)
    folded = _folded(columns, theirs)
    table = np.zeros(len(rows), dtype=[("time", float), *((name, float, v.shape[1:]) for name, v in folded.items())])
    table["time"] = rows
    for name, values in folded.items():
        table[name] = values
    return table
