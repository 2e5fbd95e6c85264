"""The same model in other units: the same events, the same relative errors."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna import runtime
from lacuna.codegen.compile import compile_model, translate
from lacuna.codegen.symbolic.expr import var
from tests.events.belts import MODEL, Belt, draw
from tests.events.models import compiled

SOLVERS = ("ida", "dopri5", "rodas4")
RELAY = """model Relay
  parameter Real s = 1;
  Real x(start=0, fixed=true);
  Boolean on(start=true, fixed=true);
  Integer n(start=0, fixed=true);
equation
  der(x) = if on then s else -s;
  when x > s*0.3 then
    on = false;
    n = pre(n) + 1;
  elsewhen x < -s*0.3 then
    on = true;
    n = pre(n) + 1;
  end when;
end Relay;
"""


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_relay_switches_whatever_the_size_of_its_signal(tmp_path: Path, solver: str) -> None:
    model = compiled(tmp_path, RELAY)
    for size in (1e-100, 1e-30, 1e-11, 1e-10, 1.0, 1e10, 1e30, 1e100):
        result = runtime.simulate(model, solver=solver, parameters={"s": size}, stop=10.0, interval=0)
        assert result.complete, result.failure
        switches = [e.time for e in result.event_log if e.direction > 0]
        assert switches == pytest.approx([0.3 + 0.6 * k for k in range(17)], rel=1e-9), size
        assert result["n"][-1] == 17


def in_units(belt: Belt, mass: float, length: float) -> Belt:
    """The belt with its mass counted in another unit, and its lengths."""
    force = mass * length
    return Belt(belt.m * mass, belt.k * mass, belt.d * mass, belt.vBelt * length, belt.Fs * force, belt.Fc * force)


@pytest.mark.parametrize("solver", SOLVERS)
def test_belts_in_other_units_take_the_same_steps(solver: str) -> None:
    """Powers of two change no rounding: not one bit may differ. Millimetres and tonnes change the rounding, and with it
    when v is said to be above vBelt while it rests there: what is compared is when the mass sticks and slips."""
    model = runtime.Model(compile_model(str(MODEL)).path)
    rng = np.random.default_rng(5)
    for belt in (draw(rng) for _ in range(5)):
        _, stop = belt.events()

        def run(b: Belt, stop: float = stop) -> tuple[np.ndarray, int]:
            result = runtime.simulate(
                model, parameters=vars(b), solver=solver, stop=stop, outputs=["stuck"], interval=0
            )
            assert result.complete, result.failure
            return result.time[np.flatnonzero(np.diff(result["stuck"])) + 1], result.counters["steps"]

        times, steps = run(belt)
        for mass, length in ((2.0**-40, 2.0**-30), (2.0**30, 2.0**60)):
            other, count = run(in_units(belt, mass, length))
            assert count == steps
            assert np.array_equal(other, times)
        for mass, length in ((1e3, 1e-3), (1e-6, 1e9)):
            other, count = run(in_units(belt, mass, length))
            assert len(other) == len(times)
            assert np.allclose(other, times, rtol=1e-4)
            assert abs(count - steps) <= 0.1 * steps


RIPPLE = """model Ripple "A voltage whose nominal value is that of a line, compared with a threshold of a microvolt"
  parameter Real s = 1;
  Real t(start=0, fixed=true), v(nominal=2e4*s);
  Integer n(start=0, fixed=true);
equation
  der(t) = 1;
  v = 1.5e-6*s*sin(t);
  when v > 1e-6*s then
    n = pre(n) + 1;
  end when;
end Ripple;
"""


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_guard_far_below_its_nominal_value_still_switches(tmp_path: Path, solver: str) -> None:
    """Its hysteresis follows the size that it has had, not the one that it might have."""
    model = compiled(tmp_path, RIPPLE)
    for size in (1e-6, 1.0, 1e9):
        result = runtime.simulate(model, solver=solver, parameters={"s": size}, stop=20.0, interval=0)
        assert result.complete, result.failure
        assert result["n"][-1] == 4, size


LIMITS = {
    "relation": "y = if x > most then most else x; der(x) = u",
    "branch": "y = if u > most then most elseif u < -most then -most else u; der(x) = y",
    "min_and_max": "y = max(-most, min(most, u)); der(x) = y",
}


@pytest.mark.parametrize("solver", SOLVERS)
@pytest.mark.parametrize("limit", LIMITS)
def test_a_limit_that_is_switched_off_loosens_no_tolerance(tmp_path: Path, limit: str, solver: str) -> None:
    text = f"""model Limited
  parameter Real most = 1e60;
  Real x(start=0, fixed=true), y, u = cos(time);
equation
  {LIMITS[limit]};
end Limited;
"""
    result = runtime.simulate(compiled(tmp_path, text), solver=solver, rtol=1e-6, stop=5.0, interval=0.1)
    assert result.complete, result.failure
    assert np.abs(result["x"] - np.sin(result.time)).max() < 1e-6 * result.counters["steps"]


CLUTCH = """model Clutch "Two shafts that turn alike: their slip is rounding, while another guard is passed"
  Real w1(start=0, fixed=true), w2(start=0, fixed=true), slip(nominal=1);
  Integer passed(start=0, fixed=true), turned(start=0, fixed=true);
equation
  der(w1) = cos(time);
  der(w2) = cos(time);
  slip = w1 - w2 + 1e-14*sin(97*time);
  when w1 > 0.5 then
    passed = pre(passed) + 1;
  end when;
  when {slip > 0, slip < 0} then
    turned = pre(turned) + 1;
  end when;
end Clutch;
"""


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_guard_of_rounding_does_not_switch_beside_another(tmp_path: Path, solver: str) -> None:
    result = runtime.simulate(compiled(tmp_path, CLUTCH), solver=solver, rtol=1e-6, stop=50.0, interval=0)
    assert result.complete, result.failure
    assert result["passed"][-1] == 8
    assert result["turned"][-1] == 0


def paced(pace: float) -> str:
    """A swing that is kicked at each turn, a filter that rests at first, a counter at even instants: all of it so many
    times as fast."""
    return f"""model Paced
  constant Real c = {pace!r};
  Real x(start=1, fixed=true), y(start=0, fixed=true), f(start=0, fixed=true);
  Integer n(start=0, fixed=true), ticks(start=0, fixed=true);
equation
  der(x) = c*y;
  der(y) = -c*(x + 0.3*x^3 + 0.2*y);
  f + der(f)/(7*c) = x;
  when x < 0 then
    reinit(y, 1.3*pre(y));
    n = pre(n) + 1;
  end when;
  when sample(0.25/c, 0.25/c) then
    ticks = pre(ticks) + 1;
  end when;
  annotation(experiment(StopTime={20 / pace!r}));
end Paced;
"""


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_model_in_other_units_of_time_takes_the_same_steps(tmp_path: Path, solver: str) -> None:
    """Powers of two change no rounding: not one bit may differ. Others change the rounding, and no more."""

    def run(pace: float, rtol: float) -> runtime.Result:
        result = runtime.simulate(compiled(tmp_path, paced(pace)), solver=solver, rtol=rtol, interval=0)
        assert result.complete, result.failure
        return result

    for rtol in (1e-4, 1e-7):
        one = run(1.0, rtol)
        assert one["n"][-1] > 2
        more = []
        for pace in (2.0**-40, 2.0**30, 60.0, 1 / 3.6e3):
            other = run(pace, rtol)
            if pace in (2.0**-40, 2.0**30):
                assert other.counters == one.counters
                assert np.array_equal(other.time * pace, one.time)
                assert all(np.array_equal(other[name], one[name]) for name in ("x", "y", "f", "n", "ticks"))
            assert (other["n"][-1], other["ticks"][-1]) == (one["n"][-1], one["ticks"][-1])
            # of rounding alone IDA doubles a step or does not: counts are 4 % apart (eight paces, rtol 1e-4 to 1e-8)
            more.append(other.counters["steps"] / one.counters["steps"] - 1)
            assert abs(more[-1]) <= (0.12 if solver == "ida" else 0.05)
            assert other["x"][-1] == pytest.approx(one["x"][-1], abs=100 * rtol if solver == "ida" else 1e-9)
        assert abs(np.mean(more)) <= 0.05


def test_the_potential_of_a_rail_is_no_limit() -> None:
    """An open leg conducts where its potential leaves the rails. What is compared with a variable has its size; without
    that the current of a winding had the size of the leakage that PartialLeg writes beside it, picoamperes."""
    prepared, _ = translate("Lacuna.Actuators.EccentricBldc")
    size = prepared.nominals[var("bridge.leg_a.i")]
    assert size.value == pytest.approx(28 / (1 * 2.13), rel=0.05)


def test_a_threshold_beside_the_potential_of_a_rail_is_no_size() -> None:
    """v > rail + 1e-6, and the rail is an input: what the bench says of currents is the speed that it turns at, not the
    microvolt."""
    prepared, _ = translate("Lacuna.Benches.BldcDrive")
    winding, turn = prepared.nominals[var("bridge.leg_a.i")], prepared.nominals[var("shaft.w")]
    assert winding.value == pytest.approx(turn.value * 0.12476 / 2.13)


@pytest.mark.parametrize("solver", ["ida", "dopri5", "rodas4"])
def test_the_end_of_a_run_decides_nothing_anew(solver: str, tmp_path: Path) -> None:
    """An error that dies away until rounding leaves exactly zero crosses nothing, so that its sign stays: it was
    another one in the last row alone."""
    path = tmp_path / "Rest.mo"
    path.write_text(
        "model Rest\n  Real i(start=0, fixed=true), x(start=0, fixed=true), y;\n"
        "  Boolean over(start=false, fixed=true);\n"
        "equation\n  der(i) = 1000*(1 - i);\n  der(x) = 1;\n  y = if 1 - i > 0 then 1 else -1;\n"
        "  when terminal() then\n    over = true;\n  end when;\nend Rest;\n"
    )
    rest = runtime.Model(compile_model(str(path)).path)
    result = runtime.simulate(rest, solver=solver, stop=1.0, interval=0.1, events=False)
    assert result.complete and list(result["over"]) == [0] * 10 + [1]
    assert result["y"][-1] == result["y"][-2]
