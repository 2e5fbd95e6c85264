"""What FMPy makes of an FMU beside our own run of the same model."""

from __future__ import annotations

from pathlib import Path

import fmpy
import numpy as np

import lacuna

KINDS = {"me": "ModelExchange", "cs": "CoSimulation"}
TIGHT = {"dopri5": 1e-11, "rodas4": 1e-10}  # relative tolerance of the run that an FMU is held against


def run(path: Path, kind: str, stop: float, outputs: list[str], **more) -> np.ndarray:
    """A column for time and each of `outputs`, elements of arrays among them."""
    more = {"relative_tolerance": 1e-9, "output_interval": stop / 100} | more
    arrays = {v.name for v in fmpy.read_model_description(str(path)).modelVariables if v.shape}
    wanted = {name: name.rpartition("[")[0] if name.rpartition("[")[0] in arrays else name for name in outputs}
    found = fmpy.simulate_fmu(
        str(path), fmi_type=KINDS[kind], stop_time=stop, solver="CVode", output=list(set(wanted.values())), **more
    )
    table = np.zeros(len(found), dtype=[("time", float), *((name, float) for name in outputs)])
    table["time"] = found["time"]
    for name, of in wanted.items():
        subscripts = [int(k) - 1 for k in name.removeprefix(of).strip("[]").split(",") if k]
        table[name] = found[of][(slice(None), *subscripts)]
    return table


def signals_of(model: lacuna.Model) -> list[str]:
    """One name of each state; where events choose the states, or there are none, what is computed beside them."""
    states = list({v.index: name for name, v in reversed(model.states.items())}.values())
    return states or [name for name, v in model.variables.items() if v.kind in ("algebraic", "discrete")]


def reference(model: lacuna.Model, stop: float, signals: list[str], solver: str = "dopri5") -> lacuna.Result:
    return model.simulate(
        stop=stop, solver=solver, rtol=TIGHT[solver], outputs=signals, interval=stop / 4000, event_rows=True
    )


def differences(found: np.ndarray, ours: lacuna.Result, signals: list[str]) -> dict[str, float]:
    """Largest difference of each signal over its largest value, at all instants of `found`; of two rows at one instant
    the one after the event."""
    times, rows = np.unique(found["time"], return_index=True)
    rows = np.append(rows[1:], len(found["time"])) - 1
    return {
        name: float(np.max(np.abs(found[name][rows] - _after_events(ours, name, times))))
        / max(float(np.max(np.abs(ours[name]))), np.finfo(float).tiny)
        for name in signals
    }


def _after_events(result: lacuna.Result, name: str, times: np.ndarray) -> np.ndarray:
    """The value at each instant; where the signal jumps there, the one after it."""
    at, values = np.asarray(result.time), np.asarray(result[name], float)
    left = np.searchsorted(at, times + 1e-9 * at[-1], side="right") - 1
    right = np.minimum(left + 1, len(at) - 1)
    span = at[right] - at[left]
    part = np.clip((times - at[left]) / np.where(span > 0, span, 1), 0, 1)
    return values[left] + np.where(span > 0, values[right] - values[left], 0) * part
