"""Errors on T1 and T2, of the programs written by hand and of every generated lane, against the tight reference."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from bench.by_hand import T1, T2, Problem, with_ida, with_rk4
from bench.generated import ATOL, RTOL, error_against
from lacuna import runtime
from lacuna.codegen.compile import compile_model

# Ten thousand times finer than the output; halving it changes the states by 1e-8 or less.
REFERENCE_STEP = {T1: 5e-6, T2: 1e-6}
ERROR = 5e-6
OWN = {T1: "SquareWaveServo.mo", T2: "SixStepMotor.mo"}
PUBLISHED = {T1: "ServoT1.mo", T2: "BldcT2.mo"}
PROBLEMS = pytest.mark.parametrize("problem", [T1, T2], ids=["T1", "T2"])
SOLVERS = pytest.mark.parametrize("solver", ["ida", "dopri5", "rodas4"])


@pytest.fixture(scope="module")
def references() -> dict[Problem, dict[str, np.ndarray]]:
    return {problem: with_rk4(problem, step).states for problem, step in REFERENCE_STEP.items()}


def states_of(file: Path, problem: Problem, solver: str) -> dict[str, np.ndarray]:
    model = runtime.Model(compile_model(str(file)).path)
    result = runtime.simulate(
        model, solver=solver, stop=problem.stop, rtol=RTOL, atol=ATOL, interval=problem.interval, events=False
    )
    assert result.complete, result.failure
    assert len(result.time) == problem.points
    return {name: result[name] for name in problem.states}


@PROBLEMS
def test_reference_does_not_depend_on_its_step(problem: Problem, references) -> None:
    assert error_against(with_rk4(problem, REFERENCE_STEP[problem] / 2).states, references[problem]) < 2e-8


@PROBLEMS
def test_program_written_by_hand(problem: Problem, references) -> None:
    run = with_ida(problem, RTOL, ATOL)
    assert error_against(references[problem], run.states) < ERROR
    assert run.counters["events"] == with_rk4(problem, REFERENCE_STEP[problem]).counters["events"] - (problem is T1)


@PROBLEMS
@SOLVERS
def test_generated_lane(problem: Problem, solver: str, references) -> None:
    file = Path(__file__).parents[1] / "models" / OWN[problem]
    assert error_against(references[problem], states_of(file, problem, solver)) < ERROR


@PROBLEMS
@SOLVERS
def test_generated_lane_on_the_published_file(problem: Problem, solver: str, references, shared: Path) -> None:
    file = shared / "benchmarks" / PUBLISHED[problem]
    assert error_against(references[problem], states_of(file, problem, solver)) < ERROR
