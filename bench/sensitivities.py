"""What sensitivities cost: runs with all of a machine's parameters as multiples of the same run without.

T1 stands beside a program written by hand over IDAS."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from bench.by_hand import T1, T2
from bench.by_hand.sensitive import PARAMETERS, with_idas
from bench.generated import ATOL, RTOL, model_file
from bench.report import Row
from bench.timing import take_turns
from lacuna import runtime
from lacuna.codegen.compile import compile_model

SOLVERS = ("dopri5", "ida")
GOAL = 0.6  # of a run, for each parameter (dopri5)
REFERENCE_RTOL = 1e-10  # dopri5; tests hold these sensitivities against differences of whole runs
ROUNDS = 5
EMA = ("R", "L", "Ke", "Jm", "bm", "tau_m", "V", "Js", "bs", "tau_s", "k", "controller.Kp")


@dataclass(frozen=True)
class Machine:
    model: str
    parameters: Sequence[str]
    outputs: Sequence[str]
    stop: float  # s
    interval: float  # s


MACHINES = {
    "T1": Machine(str(model_file(T1)), PARAMETERS, T1.states, T1.stop, T1.interval),
    "T2": Machine(str(model_file(T2)), ("R", "L", "Ke", "J", "B", "V"), T2.states, T2.stop, T2.interval),
    "actuator, step": Machine("Actuators.FlightControlEma", EMA, ("rotor.w", "surface.phi"), 0.5, 1e-3),
    "actuator, slow sine": Machine("Actuators.Scenarios.SlowSine", EMA, ("rotor.w", "surface.phi"), 1.0, 1e-3),
}


def cost(rounds: int) -> list[Row]:
    """One row a machine and solver, and one for the program over IDAS."""
    return [row for name, machine in MACHINES.items() for row in _rows(name, machine, min(rounds, ROUNDS))]


def _rows(name: str, machine: Machine, rounds: int) -> list[Row]:
    model = runtime.Model(compile_model(machine.model, sensitivities=True).path)
    expected = _tangents(_session(model, machine, "dopri5", True, REFERENCE_RTOL).run(stop=machine.stop), machine)
    rows = []
    for solver in SOLVERS:
        sessions = {kind: _session(model, machine, solver, kind) for kind in (False, True)}
        rivals: dict[str, Callable[[], object]] = {
            "plain": lambda s=sessions[False]: s.run(stop=machine.stop),
            "with": lambda s=sessions[True]: s.run(stop=machine.stop),
        }
        by_hand = name == "T1" and solver == "ida"
        if by_hand:
            rivals["by hand"] = lambda: with_idas(RTOL, ATOL)
        timings = take_turns(rivals, rounds)
        found = sessions[True].run(stop=machine.stop)
        steps = found.counters["steps"]
        rows.append(_row(name, solver, machine, timings["with"], _tangents(found, machine), expected, steps))
        if by_hand:
            run, tangents = with_idas(RTOL, ATOL)
            columns = tangents.transpose(1, 2, 0)
            rows.append(
                _row(name, "by hand, IDAS", machine, timings["by hand"], columns, expected, run.counters["steps"])
            )
    return rows


def _session(
    model: runtime.Model, machine: Machine, solver: str, sensitive: bool, rtol: float = RTOL
) -> runtime.Session:
    return runtime.Session(
        model, solver=solver, rtol=rtol, interval=machine.interval, outputs=machine.outputs,
        events=False, sensitivities=machine.parameters if sensitive else (),
    )  # fmt: skip


def _tangents(result: runtime.Result, machine: Machine) -> np.ndarray:
    """[parameters, outputs, rows]"""
    if not result.complete:
        raise RuntimeError(str(result.failure))
    return np.array([[result.sensitivity(o, p) for o in machine.outputs] for p in machine.parameters])


def _row(name: str, solver: str, machine: Machine, timing, found: np.ndarray, expected: np.ndarray, steps: int) -> Row:
    """The error leaves out the rows where a jump falls to the other side: those of the largest hundredth."""
    size = np.abs(expected).max(axis=2, keepdims=True)
    error = np.abs(found - expected) / np.where(size > 0, size, 1.0)
    count = len(machine.parameters)
    return {
        "machine": name,
        "program": solver,
        "parameters": count,
        "times a run without": timing.ratio,
        "goal": 1 + GOAL * count if solver == "dopri5" else None,
        "ms": 1e3 * timing.seconds,
        "error, 99 % of rows": float(np.quantile(error.max(axis=(0, 1)), 0.99)),
        "steps": steps,
    }
