"""T1 and T2: the generated lanes beside the programs written by hand."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from bench.by_hand import T1, T2, Problem, with_ida, with_rk4
from bench.generated import ATOL, LANES, RTOL, Lane, error_against, model_file
from bench.timing import take_turns
from lacuna import runtime
from lacuna.codegen.compile import compile_model

BASELINE = "by hand, IDA"
REFERENCE_STEP = {T1: 5e-6, T2: 1e-6}  # s; halving it changes the states by less than 2e-8
PROBLEMS = {"T1": T1, "T2": T2}

# What the published comparison asks of each lane: time over that of the baseline.
GOAL = {"ida": 1.0, "dopri5": 0.05}


@dataclass(frozen=True)
class Entry:
    problem: str
    rival: str
    ratio: float  # of times, to the baseline
    seconds: float
    spread: float  # of the seconds, interquartile over median
    error: float  # of the states, to the tight reference
    goal: float | None  # of the ratio
    counters: dict[str, int]


def race(name: str, rounds: int) -> list[Entry]:
    """All rivals on one problem; the baseline first."""
    problem = PROBLEMS[name]
    reference = with_rk4(problem, REFERENCE_STEP[problem]).states
    model = runtime.Model(compile_model(str(model_file(problem))).path)
    rivals: dict[str, Callable[[], tuple[dict[str, np.ndarray], dict[str, int]]]] = {
        BASELINE: lambda: _by_hand(problem),
        **{lane.label: _generated(model, problem, lane) for lane in LANES},
    }
    timings = take_turns(rivals, rounds)
    return [_entry(name, rival, run, timings[rival], reference) for rival, run in rivals.items()]


def _entry(name: str, rival: str, run: Callable, timing, reference: dict[str, np.ndarray]) -> Entry:
    states, counters = run()
    error = error_against(reference, states)
    return Entry(name, rival, timing.ratio, timing.seconds, timing.spread, error, GOAL.get(rival), counters)


def _by_hand(problem: Problem) -> tuple[dict[str, np.ndarray], dict[str, int]]:
    run = with_ida(problem, RTOL, ATOL)
    return run.states, run.counters


def _generated(model: runtime.Model, problem: Problem, lane: Lane) -> Callable:
    def run() -> tuple[dict[str, np.ndarray], dict[str, int]]:
        result = runtime.simulate(
            model, solver=lane.solver, step=lane.step, stop=problem.stop, rtol=RTOL, atol=ATOL,
            interval=problem.interval, outputs=list(problem.states), events=False,
        )  # fmt: skip
        if not result.complete:
            raise RuntimeError(f"{lane.label}: {result.failure}")
        return {state: result[state] for state in problem.states}, dict(result.counters)

    return run
