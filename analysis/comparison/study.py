"""Run one scenario through every lane and measure each against a tight IDA reference."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
import time as clock

import numpy as np

from lacuna import runtime
from lacuna.analysis.comparison.deviation import (
    EventDeviation,
    SignalDeviation,
    event_deviation,
    event_pairs,
    observed_order,
    outside_event_gaps,
    signal_deviation,
)
from lacuna.analysis.comparison.scenarios import Scenario
from lacuna.analysis.errors import AnalysisError

SMALL_SIGNAL = 1e-3  # of the largest signal with the same unit
REFERENCE_MARGIN = 10.0  # an error counts for an observed order only this far above that of the reference itself


@dataclass(frozen=True)
class Lane:
    """One way through the model: a solver with its step or its tolerance."""

    solver: str
    step: float | None = None
    rtol: float | None = None
    located: bool = True

    @property
    def family(self) -> str:
        """The lanes that differ in step or tolerance only."""
        return self.solver if self.located else f"{self.solver}, events not located"

    @property
    def label(self) -> str:
        return f"{self.family}, " + (f"step {self.step:g} s" if self.step else f"rtol {self.rtol:g}")


@dataclass
class LaneResult:
    lane: Lane
    seconds: float  # of processor time
    counters: dict[str, int]
    failure: str | None
    events: EventDeviation
    signals: list[SignalDeviation]
    values: dict[str, np.ndarray] = field(repr=False)  # of the shown signals, on the study's grid

    @property
    def error(self) -> float:
        """The worst relative maximum deviation over all signals; infinite for a run that did not end well."""
        return max((s.relative for s in self.signals), default=0.0) if self.failure is None else float("inf")

    @property
    def rms_error(self) -> float:
        """The worst RMS deviation over all signals, of their scales: smoother in the step than the maximum, which
        depends on where a sample falls beside an event. Infinite for a run that did not end well."""
        errors = (s.rms / s.scale for s in self.signals if s.scale > 0)
        return max(errors, default=0.0) if self.failure is None else float("inf")


@dataclass
class Study:
    scenario: Scenario
    time: np.ndarray
    reference: LaneResult
    second: LaneResult  # another method at the reference's tolerance: what separates the two is the reference's error
    lanes: list[LaneResult]
    orders: dict[str, float]  # family -> observed order of convergence

    @property
    def off_course(self) -> frozenset[str]:
        """Families of which some run fails, or has events without a partner: it takes another course than the
        reference, and its deviations need not shrink in proportion to any power of the step."""
        strays = (r for r in self.lanes if r.failure is not None or r.events.unmatched)
        return frozenset(r.lane.family for r in strays)


def lanes_of(scenario: Scenario) -> list[Lane]:
    """Variable-step lanes at every tolerance, fixed-step lanes at every step with and without event location.

    Euler takes four steps for each of RK4: as many evaluations.
    """
    variable = [Lane(s, rtol=r) for s in ("ida", "dopri5", "rodas4") for r in scenario.variable_rtol]
    fixed = [
        Lane(solver, step=h / stages, located=on)
        for solver, stages in (("rk4", 1), ("euler", 4))
        for on in (True, False)
        for h in scenario.steps
    ]
    return variable + fixed


def run(scenario: Scenario, model: runtime.Model, tick: Callable[[Lane], None] = lambda lane: None) -> Study:
    """The whole study of one scenario; `tick` is called before each lane."""
    grid = np.linspace(0.0, scenario.stop, round(scenario.stop / scenario.interval) + 1)
    first = Lane("ida", rtol=scenario.reference_rtol)
    tick(first)
    reference, seconds = _simulate(scenario, model, first, grid)
    if not reference.complete:
        raise AnalysisError(f"{scenario.name}: the reference, {first.label}, stops early: {reference.failure}")
    signals = _scales(model, reference)
    lanes = []
    for lane in (Lane("dopri5", rtol=scenario.reference_rtol), *lanes_of(scenario)):
        tick(lane)
        result, elapsed = _simulate(scenario, model, lane, grid)
        lanes.append(_measure(scenario, lane, elapsed, reference, result, signals))
    own = _measure(scenario, first, seconds, reference, reference, signals)
    second, *lanes = lanes
    return Study(
        scenario, grid[: len(reference.time)], own, second, lanes, _orders(lanes, REFERENCE_MARGIN * second.rms_error)
    )


def _simulate(scenario: Scenario, model: runtime.Model, lane: Lane, grid: np.ndarray) -> tuple[runtime.Result, float]:
    begin = clock.thread_time()
    result = runtime.simulate(
        model, solver=lane.solver, parameters=scenario.parameters, inputs=scenario.inputs, stop=scenario.stop,
        rtol=lane.rtol, step=lane.step, locate_events=lane.located, output_times=grid, events=False,
    )  # fmt: skip
    return result, clock.thread_time() - begin


def _scales(model: runtime.Model, reference: runtime.Result) -> dict[str, tuple[float, str]]:
    """What a deviation of each signal is relative to, and its unit: its largest magnitude, but not less than a part of
    the largest of all signals with its unit. The current of an open leg, zero but for rounding, is thus measured as a
    current.
    """
    own = {name: float(np.max(np.abs(reference[name]), initial=0.0)) for name in _signals(model)}
    largest: dict[str, float] = {}
    for name, magnitude in own.items():
        unit = model.variables[name].unit
        largest[unit] = max(largest.get(unit, 0.0), magnitude)
    units = {name: model.variables[name].unit for name in own}
    return {name: (max(own[name], SMALL_SIGNAL * largest[unit]), unit) for name, unit in units.items()}


def _signals(model: runtime.Model) -> list[str]:
    """Names of the variables that change with time; of several aliases the first stands for all."""
    seen: set[tuple] = set()
    names = []
    for name, variable in model.variables.items():
        place = (variable.kind, variable.index)
        if variable.kind != "parameter" and place not in seen:
            seen.add(place)
            names.append(name)
    return names


def _measure(
    scenario: Scenario,
    lane: Lane,
    seconds: float,
    reference: runtime.Result,
    result: runtime.Result,
    scales: dict[str, tuple[float, str]],
) -> LaneResult:
    rows = min(len(reference.time), len(result.time))
    time = reference.time[:rows]
    pairs, _ = event_pairs(_events(reference), _events(result))
    use = outside_event_gaps(time, pairs)
    signals = [
        signal_deviation(name, time, reference[name][:rows], result[name][:rows], use, scale, unit)
        for name, (scale, unit) in scales.items()
    ]
    return LaneResult(
        lane, seconds, dict(result.counters), None if result.complete else str(result.failure),
        event_deviation(_events(reference), _events(result)), signals, {n: result[n][:rows] for n in scenario.shown},
    )  # fmt: skip


def _events(result: runtime.Result) -> list[tuple[float, str]]:
    """Instants and kinds; two relations with the same text are two kinds, so each has its number."""
    return [(e.time, f"{e.kind} {e.index}{'-+'[e.direction > 0]}: {e.text}") for e in result.event_log]


def _orders(lanes: list[LaneResult], floor: float) -> dict[str, float]:
    """Observed order of each fixed-step family over its errors above `floor`."""
    families: dict[str, list[LaneResult]] = {}
    for result in lanes:
        if result.lane.step:
            families.setdefault(result.lane.family, []).append(result)
    return {
        family: observed_order(np.array([r.lane.step for r in group]), np.array([r.rms_error for r in group]), floor)
        for family, group in families.items()
    }


def rows(study: Study) -> Iterator[dict[str, object]]:
    """One row for each lane and signal, for the CSV."""
    for result in [study.reference, *study.lanes]:
        for signal in result.signals:
            yield {
                "scenario": study.scenario.name, "lane": result.lane.label, "signal": signal.name,
                "max_deviation": signal.maximum, "rms_deviation": signal.rms, "scale": signal.scale,
                "relative": signal.relative, "at_time_s": signal.at_time,
            }  # fmt: skip
