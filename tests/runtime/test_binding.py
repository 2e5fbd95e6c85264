"""The Python binding on generated models: solvers agree, names and values are checked, files survive a round trip."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
import os
from pathlib import Path
import pickle
import subprocess
import sys

import numpy as np
import pytest

import lacuna
from lacuna import runtime
from lacuna.codegen.compile import compile_model
from lacuna.runtime import files
from tests.results import read_result

MODELS = Path(__file__).parents[1] / "models"


def model(name: str) -> runtime.Model:
    return runtime.Model(compile_model(name).path)


@pytest.fixture(scope="module")
def servo() -> runtime.Model:
    return model(str(MODELS / "SquareWaveServo.mo"))


@pytest.fixture(scope="module")
def motor() -> runtime.Model:
    return model(str(MODELS / "SixStepMotor.mo"))


@pytest.fixture(scope="module")
def bench() -> runtime.Model:
    return model("Benches.DcServo")


def written(folder: Path, text: str) -> runtime.Model:
    path = folder / f"{text.split()[1]}.mo"
    path.write_text(text, encoding="utf-8")
    return model(str(path))


@pytest.mark.parametrize("solver", ["ida", "dopri5", "rodas4"])
@pytest.mark.parametrize(("name", "stop", "interval"), [("servo", 2.0, 1e-3), ("motor", 0.2, 1e-4)])
def test_every_solver_agrees_with_a_tight_reference(
    solver: str, name: str, stop: float, interval: float, request: pytest.FixtureRequest
):
    hybrid = request.getfixturevalue(name)
    states = [n for n in ("i", "w", "ia", "ib", "th") if n in hybrid.states]
    grid = {"stop": stop, "interval": interval, "outputs": states, "events": False}
    reference = runtime.simulate(hybrid, solver="dopri5", rtol=1e-12, atol=1e-13, **grid)
    result = runtime.simulate(hybrid, solver=solver, rtol=1e-6, atol=1e-8, **grid)
    assert result.complete and len(result) == len(reference) == round(stop / interval) + 1
    for state in states:
        assert np.max(np.abs(result[state] - reference[state])) < 5e-6 * np.max(np.abs(reference[state])), state
    assert result.counters["state_events"] == reference.counters["state_events"] > 10


def test_fixed_step_with_located_events_converges_to_the_reference(servo: runtime.Model):
    reference = runtime.simulate(servo, solver="dopri5", rtol=1e-12, atol=1e-13, stop=0.25)["w"][-1]
    errors = [abs(runtime.simulate(servo, solver="rk4", step=h, stop=0.25)["w"][-1] - reference) for h in (2e-4, 5e-5)]
    assert np.log2(errors[0] / errors[1]) / 2 > 3.8


def test_stuck_rotor_has_speed_zero(servo: runtime.Model):
    result = runtime.simulate(servo, solver="ida", parameters={"tauc": 0.2}, stop=1.0)
    assert not result["w"].any() and not result["mode"].any()


def test_time_and_events_of_a_result(servo: runtime.Model):
    result = runtime.simulate(servo, solver="dopri5", stop=0.35, interval=0.01)
    assert result.time[0] == 0 and result.time[-1] == pytest.approx(0.35, abs=1e-12)
    assert np.all(np.diff(result.time) >= 0)
    rows = np.flatnonzero(result.event)
    np.testing.assert_array_equal(result.time[rows[::2]], result.time[rows[1::2]])
    samples = [e.time for e in result.event_log if e.kind == "sample"]
    np.testing.assert_allclose(samples, [0.1, 0.2, 0.3], rtol=0, atol=1e-15)
    assert {e.text for e in result.event_log if e.kind == "state"} >= {"Ke * i > tauc"}


def test_aliases_and_parameters_are_columns_too(bench: runtime.Model):
    result = runtime.simulate(bench, inputs={"u": 6.0}, stop=0.1, outputs=["w", "theta"], interval=0.01)
    np.testing.assert_array_equal(result["shaft.w"], result["w"])
    assert set(result["R"]) == {3.5} and "shaft.w" in result
    with pytest.raises(runtime.SimulationError, match="i was not recorded"):
        result["i"]
    with pytest.raises(runtime.UnknownNameError, match="did you mean theta"):
        result["thta"]


def test_arrays_outlive_the_result(bench: runtime.Model):
    speed = runtime.simulate(bench, inputs={"u": 6.0}, stop=0.1, outputs=["w"], interval=1e-4)["w"]
    copy = speed.copy()
    for _ in range(20):
        runtime.simulate(bench, inputs={"u": -6.0}, stop=0.1, outputs=["w"], interval=1e-4)
    np.testing.assert_array_equal(speed, copy)


def test_initial_states_and_parameters(bench: runtime.Model):
    session = runtime.Session(bench, solver="dopri5", outputs=["theta", "w"], interval=0.1, events=False)
    result = session.run(parameters={"b": 0.0, "Ke": 0.0}, initial={"theta": 0.3, "w": 2.0}, stop=1.0)
    np.testing.assert_allclose(result["theta"], 0.3 + 2.0 * result.time, rtol=1e-9)
    assert result.parameters["Ke"] == 0 and session.run(stop=1.0).parameters["Ke"] == 0.03


def test_recorded_input_drives_the_model(bench: runtime.Model):
    time = np.linspace(0, 2, 2001)
    recorded = runtime.RecordedInput(time, 6 * np.sin(3 * time))
    runs = [
        runtime.simulate(
            bench, solver=s, inputs={"u": recorded}, stop=2.0, outputs=["i", "w", "theta", "u"], interval=1e-3
        )
        for s in ("ida", "dopri5", "rodas4")
    ]
    np.testing.assert_allclose(runs[1]["u"], recorded.values, atol=1e-12)
    for run in runs:
        # two thousand restarts add up their local errors
        np.testing.assert_allclose(run["theta"], runs[1]["theta"], rtol=0, atol=2e-4 * np.max(runs[1]["theta"]))
    assert runs[1].counters["steps"] < 2300


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"parameters": {"Rr": 1}}, "no parameter that may be set called Rr; did you mean R"),
        ({"parameters": {"w": 1}}, "no parameter that may be set called w"),
        ({"parameters": {"J": -1}}, r"parameter J = -1 is outside its bounds \[1e-12, inf\]"),
        ({"parameters": {"J": float("nan")}}, "parameter J = nan is outside"),
        ({"parameters": {"J": np.inf}}, "parameter J cannot be inf: it is a Real, which is finite"),
        ({"inputs": {"v": 1.0}}, "no input called v"),
        ({"initial": {"i_phase": 1.0}}, "no state called i_phase"),
        ({"outputs": ["speed"]}, "no variable called speed"),
        ({"solver": "cvode"}, 'unknown solver "cvode"; there are ida'),
        ({"solver": "rk4"}, "solver rk4 needs a step"),
        ({"rtol": -1.0}, "rtol must be greater than zero"),
        ({"output_times": [1.0, 0.5]}, "output times must not decrease"),
        ({"inputs": {"u": runtime.RecordedInput([0, 1, 1], [0, 1, 2])}}, "input u: time does not increase at 1 s"),
    ],
)
def test_what_cannot_be_used_is_refused(bench: runtime.Model, arguments: dict, words: str):
    with pytest.raises(runtime.SimulationError, match=words):
        runtime.simulate(bench, **arguments)


def test_recorded_input_needs_samples_of_equal_number():
    for time, values in (([], []), ([0, 1], [1]), ([[0]], [[1]])):
        with pytest.raises(runtime.SimulationError, match="as many values as times"):
            runtime.RecordedInput(time, values)
    with pytest.raises(runtime.SimulationError, match="cubic"):
        runtime.RecordedInput([0], [1], "cubic")


def test_a_run_that_fails_keeps_its_rows_and_says_why(tmp_path: Path):
    blows_up = written(
        tmp_path, "model BlowsUp\n  Real x(start=1, fixed=true);\nequation\n  der(x) = x^2;\nend BlowsUp;\n"
    )
    result = runtime.simulate(blows_up, stop=2.0, interval=0.1)
    assert not result.complete and result.failure.status == "step_collapse"
    assert result.failure.time == pytest.approx(1.0, abs=1e-3)
    assert (result.failure.variable, result.failure.line) == ("x", 4) and "BlowsUp.mo:4:" in str(result.failure)
    np.testing.assert_allclose(result["x"][:9], 1 / (1 - result.time[:9]), rtol=1e-4)


def test_max_steps_ends_a_run_that_takes_too_many(servo: runtime.Model):
    session = runtime.Session(servo, solver="dopri5", max_steps=50, interval=1e-3)
    for _ in range(2):
        result = session.run(stop=2.0)
        assert result.counters["steps"] == 50 and "more than 50 steps" in str(result.failure)


def test_looks_inside_steps_count_as_well(tmp_path: Path):
    """A phase that runs ten million radians a second is looked at an eighth of a turn at a time."""
    equations = "der(x) = 1;\n  der(y) = if sin(1e7*x) > 2 then 1 else 0;"
    variables = "Real x(start=0, fixed=true), y(start=0, fixed=true);"
    fast = written(tmp_path, f"model Fast\n  {variables}\nequation\n  {equations}\nend Fast;\n")
    result = runtime.Session(fast, solver="dopri5", max_steps=1000).run(stop=10.0)
    assert "more than 1000 steps, looks inside them counted, up to time" in str(result.failure)
    assert result.counters["root_evaluations"] < 20_000


def test_assert_and_terminate_end_a_run(tmp_path: Path):
    equations = (
        'der(x) = 1;\n  assert(x < 0.5, "x is too large");\n  when x > 0.3 then\n    terminate("enough");\n  end when;'
    )
    text = f"model Ends\n  parameter Real k = 1;\n  Real x(start=0, fixed=true);\nequation\n  {equations}\nend Ends;\n"
    ends = written(tmp_path, text)
    result = runtime.simulate(ends, stop=1.0, solver="dopri5")
    assert result.complete and result.terminated == "enough"
    assert result.time[-1] == pytest.approx(0.3, abs=1e-9)
    sampled = runtime.simulate(ends, stop=1.0, interval=0.25, events=False)
    assert list(sampled.time) == pytest.approx([0, 0.25, 0.3]) and sampled["x"][-1] == pytest.approx(0.3)
    on_grid = runtime.simulate(ends, stop=1.0, interval=0.1, events=False)
    assert list(on_grid.time) == pytest.approx([0, 0.1, 0.2, 0.3])
    late = runtime.simulate(ends, stop=1.0, initial={"x": 0.45}, solver="rk4", step=0.01)
    assert late.failure.status == "assert" and "x is too large" in str(late.failure) and late.failure.line == 6


def test_threads_do_not_disturb_each_other(servo: runtime.Model):
    def speed(torque: float) -> np.ndarray:
        return runtime.simulate(servo, parameters={"tauc": torque}, stop=0.5, interval=1e-3, events=False)["w"].copy()

    torques = np.linspace(1e-3, 3e-3, 8)
    alone = [speed(t) for t in torques]
    with ThreadPoolExecutor(4) as pool:
        for left, right in zip(alone, pool.map(speed, torques), strict=True):
            np.testing.assert_array_equal(left, right)


def test_csv_keeps_every_digit(servo: runtime.Model, tmp_path: Path):
    result = runtime.simulate(servo, stop=0.15, interval=0.01)
    path = files.write_csv(result, tmp_path / "run.csv")
    columns, meta = read_result(path)
    assert list(columns) == ["time", *result.columns, "event"]
    for name in result.columns:
        np.testing.assert_array_equal(columns[name], result[name])
    np.testing.assert_array_equal(columns["event"], result.event)
    assert meta["columns"]["w"] == {"unit": "rad/s", "description": "Speed", "kind": "state"}
    assert meta["complete"] and meta["parameters"]["tauc"] == 2e-3 and meta["counters"] == result.counters
    assert len(meta["events"]) == len(result.event_log)
    assert sorted(p.name for p in tmp_path.iterdir()) == ["run.csv", "run.meta.json"]


def test_failed_writing_leaves_the_old_file(servo: runtime.Model, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    path = tmp_path / "run.csv"
    path.write_text("old")

    def full(_value: float) -> str:
        raise OSError("disk full")

    monkeypatch.setattr(files, "_number", full)
    with pytest.raises(OSError, match="disk full"):
        files.write_csv(runtime.simulate(servo, stop=0.01), path)
    assert [p.name for p in tmp_path.iterdir()] == ["run.csv"] and path.read_text() == "old"


def test_missing_library_and_wrong_models_are_named(tmp_path: Path):
    code = "from lacuna import runtime; runtime.Model('x.so')"
    environment = {**os.environ, "LACUNA_BUILD": str(tmp_path), "PYTHONPATH": str(MODELS.parents[1])}
    failed = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, env=environment, check=False)
    assert failed.returncode and "run `make build`" in failed.stderr
    with pytest.raises(runtime.SimulationError, match="cannot open model"):
        runtime.Model(tmp_path / "nothing.so")


EVENTS = """model Ev
  Real x(start=0, fixed=true);
  Real y, z;
  Integer k;
  Boolean low(start=true, fixed=true);
  parameter Real limit = 0.5;
equation
  der(x) = 1;
  y = if x <= limit then 0 else 1;
  z = abs(x - 0.25) + max(x, 2*x - 0.4);
  k = integer(4*x);
  low = x < 0.7;
  annotation(experiment(StopTime=0.8));
end Ev;
"""


def test_events_tell_the_relation_of_the_source_and_its_line(tmp_path: Path) -> None:
    log = runtime.simulate(written(tmp_path, EVENTS), stop=0.8).event_log
    told = {(e.text, e.direction, e.line) for e in log}
    assert told == {
        ("x > limit", 1, 9),  # written x <= limit: true where that becomes false
        ("0.0 > x - 0.25 in abs(x - 0.25)", -1, 10),
        ("2 * x - 0.4 > x in max(x, 2 * x - 0.4)", 1, 10),
        ("integer(4 * x) has not risen", -1, 11),
        ("x < 0.7", -1, 12),
    }
    assert {Path(e.file).name for e in log} == {"Ev.mo"}
    assert str(log[-1]).endswith("Ev.mo:11)")


def test_a_result_cannot_be_changed_and_says_why_it_cannot_be_copied(servo: runtime.Model) -> None:
    result = runtime.simulate(servo, stop=0.01, interval=1e-3)
    with pytest.raises(ValueError, match="read-only"):
        result[result.columns[0]][:] = 0
    with pytest.raises(TypeError, match="its columns or a table"):
        pickle.dumps(result)


def test_a_model_goes_to_other_processes_with_its_values(tmp_path: Path) -> None:
    text = "model Sent Real x(start=1, fixed=true); parameter Real k=1; parameter Integer n=2;\n"
    text += "Real y[n] = {k*x for i in 1:n}; equation der(x) = -k*x; end Sent;"
    (tmp_path / "Sent.mo").write_text(text, encoding="utf-8")
    sent = pickle.loads(pickle.dumps(lacuna.load(tmp_path / "Sent.mo", parameters={"k": 2.0, "n": 3})))
    assert sent.simulate(stop=1.0, rtol=1e-9)["y[3]"][-1] == pytest.approx(2 * np.exp(-2), rel=1e-6)
