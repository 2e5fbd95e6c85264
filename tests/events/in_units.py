"""A model in its own units and in others, by each solver: event sequences and relative errors side by side."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from lacuna import runtime
from lacuna.codegen.library.search_path import search_path
from tests.events.units import rescaled

SYSTEMS = (
    {"m": 1e3, "A": 1e3},  # mm, mA
    {"m": 1e6, "A": 1e9},  # um, nA
    {"kg": 1e-3},  # t, so kN
    {"m": 1e3, "A": 1e-3, "kg": 1e-3},  # mm, kA, t
)
SOLVERS = ("ida", "dopri5", "rodas4")
RTOL, REFERENCE = 1e-6, 1e-10
ROWS = 200
MOST_STEPS = 300_000  # a stiff circuit by dopri5 takes millions
NEARLY = ({"m": 1 + 1e-9}, {"A": 1 + 1e-9}, {"kg": 1 + 1e-9}, {"m": 1 + 1e-9, "A": 1 - 1e-9})  # other rounding only


@dataclass
class Comparison:
    """`lines` to print; `faults`: other events, or errors that differ by more than a factor of two."""

    lines: list[str] = field(default_factory=list)
    faults: list[str] = field(default_factory=list)


@dataclass
class _Run:
    """Events as (what, direction), grouped by instant, and the largest mean error of a state, of its range: the largest
    at one instant is that of a front, which comes a moment late."""

    failure: str
    events: list[tuple] = field(default_factory=list)
    clear: list[tuple] = field(default_factory=list)  # of guards that had been further from zero than the tolerance
    error: float = 0.0
    steps: int = 0


def _instants(result: runtime.Result, least: float = 0) -> list[tuple]:
    """What happened at each instant, in any order there: by line, for the text of a relation has factors of units."""
    found: list[tuple[float, list[tuple]]] = []
    span = result.time[-1] - result.time[0]
    for e in result.event_log:
        if e.reach < least:  # its guard was at rest on the threshold, as far as is known: it may leave at any time
            continue
        if not found or e.time - found[-1][0] > 1e-9 * span:
            found.append((e.time, []))
        found[-1][1].append((e.file, e.line, e.direction))
    return [tuple(sorted(what)) for _, what in found]


def _run(
    model: runtime.Model, factor: dict[str, float], stop: float, solver: str, rtol: float, truth: dict
) -> tuple[_Run, dict]:
    states = [n for n, v in model.variables.items() if v.kind == "state"]
    result = runtime.simulate(
        model, solver=solver, rtol=rtol, stop=stop, interval=stop / ROWS, outputs=states, events=False,
        max_steps=MOST_STEPS,
    )  # fmt: skip
    values = {n: result[n] / factor[n] for n in states}
    if not result.complete:
        return _Run(str(result.failure)), values
    run = _Run("", _instants(result), _instants(result, RTOL), steps=result.counters["steps"])
    for n in sorted(truth.keys() & values):  # an alias by a literal factor is none in other units
        run.error = max(run.error, float(np.sqrt(np.mean((values[n] - truth[n]) ** 2)) / np.ptp(truth[n])))
    return run, values


def _truth(model: runtime.Model, factor: dict[str, float], stop: float) -> tuple[str, dict]:
    """States by two methods, where these agree: one that both know no two digits of (a difference of large powers, say)
    has no error to compare, nor one at rest but for rounding."""
    (one, values), (two, others) = (_run(model, factor, stop, solver, REFERENCE, {}) for solver in ("ida", "rodas4"))
    known = {
        n: x
        for n, x in values.items()
        if np.ptp(x) > 1e-6 * np.abs(x).max() and (two.failure or np.abs(x - others[n]).max() < 0.01 * np.ptp(x))
    }
    return one.failure, known


def compare(
    name: str, stop: float | None, cache: str, path: Sequence[str] = (), systems: Sequence[dict] = SYSTEMS,
    solvers: Sequence[str] = SOLVERS,
) -> Comparison:  # fmt: skip
    """The model `name` up to `stop` (None: as its experiment says) in each system of units, by each solver."""
    found = Comparison()
    models = [rescaled(name, per, search_path(list(path)), cache) for per in ({}, *systems)]
    end = stop or models[0][0].stop_time
    failure, truth = _truth(*models[0], end)
    if failure:
        found.faults.append(f"{name}: no reference: {failure}")
        return found
    for solver in solvers:
        own: _Run | None = None
        for per, (model, factor) in zip(({}, *systems), models, strict=True):
            run, _ = _run(model, factor, end, solver, RTOL, truth)
            units = ", ".join(f"{base} x {by:g}" for base, by in per.items()) or "SI"
            said = run.failure or f"{run.steps:7d} steps, {len(run.events):4d} instants, error {run.error:.1e}"
            found.lines.append(f"{name} {solver:7s} {units:28s} {said}")
            if own is not None:
                faults = _faults(own, run)
                if not faults and _differ(run.error, own.error, own.error):
                    errors = [own.error, *_errors_by_rounding(name, path, cache, end, solver, truth)]
                    if _differ(run.error, min(errors), max(errors)):
                        faults = [f"error {run.error:.1e} for {min(errors):.1e} to {max(errors):.1e}"]
                found.faults += [f"{name} {solver} {units}: {fault}" for fault in faults]
            own = own or run
    return found


def _faults(own: _Run, run: _Run) -> list[str]:
    if own.failure or run.failure:
        return [] if own.failure and run.failure else [f"runs in one: {own.failure or run.failure}"]
    return (
        []
        if own.events == run.events or own.clear == run.clear
        else [f"{len(run.events)} instants for {len(own.events)}, or others"]
    )


def _differ(error: float, low: float, high: float) -> bool:
    """By more than a factor of two. Far below the tolerance an error is what rounding happens to leave of it."""
    return (error > 2 * high and error > 0.1 * RTOL) or (2 * error < low and low > 0.1 * RTOL)


def _errors_by_rounding(
    name: str, path: Sequence[str], cache: str, stop: float, solver: str, truth: dict
) -> list[float]:
    """Errors in units that are nearly the same: what other rounding alone makes of the steps that a method chooses."""
    models = [rescaled(name, per, search_path(list(path)), cache) for per in NEARLY]
    return [_run(*m, stop, solver, RTOL, truth)[0].error for m in models]
