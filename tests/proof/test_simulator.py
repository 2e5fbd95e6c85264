"""The proof's simulator: converged in its step, and in agreement with the models that it conceals physics from."""

import numpy as np
import pytest

from lacuna import runtime
from lacuna.codegen.compile import compile_model
from tests.proof.benches import BENCHES
from tests.proof.effects import catalogue

SAMPLES = 700


def _experiment(bench, seed=3):
    inputs = bench.experiment(np.random.default_rng(seed), "fit", 1)
    start = np.argmax(np.abs(inputs[:, 0]) > 0)
    return inputs[max(0, start - 5) : max(0, start - 5) + SAMPLES]


@pytest.mark.parametrize("name", sorted(BENCHES))
def test_agrees_with_the_believed_model(name):
    bench = BENCHES[name]
    inputs, time = _experiment(bench), np.arange(SAMPLES) * bench.period
    hold = [n in bench.hold for n in bench.machine.inputs]
    recorded = {
        n: runtime.RecordedInput(time, inputs[:, j], interpolation="hold" if hold[j] else "linear")
        for j, n in enumerate(bench.machine.inputs)
    }
    result = runtime.simulate(
        runtime.Model(compile_model(bench.model).path),
        parameters=dict(bench.believed),
        inputs=recorded,
        stop=time[-1],
        output_times=time,
        rtol=1e-8,
        atol=1e-9,
    )
    ours = bench.machine.simulate(bench.kernel(bench.believed), bench.period, inputs, hold=hold)
    times, last = np.unique(np.asarray(result.time)[::-1], return_index=True)
    rows = len(result.time) - 1 - last  # after an event, as a sample is
    for j, signal in enumerate(bench.machine.outputs):
        if signal in bench.instruments:
            theirs = np.interp(time, times, np.asarray(result[signal])[rows])
            error = np.sqrt(np.mean((theirs - ours[:, j]) ** 2)) / (np.std(ours[:, j]) + 1e-12)
            assert error < 2e-4, (signal, error)


@pytest.mark.parametrize(
    ("name", "effect"),
    [
        ("DcServo", "friction.stribeck"),
        ("DcServo", "backlash"),
        ("DcServo", "drive.dead_time"),
        ("ScrewEma", "friction.load"),
        ("ScrewEma", "backlash"),
        ("BldcDrive", "motor.short_circuit"),
        ("FlightControl", "backlash"),
    ],
)
def test_converged_in_its_step(name, effect):
    bench = BENCHES[name]
    concealed = catalogue(name)[effect](np.random.default_rng(1), 1.0)
    kernel, inputs = bench.kernel(bench.believed) | dict(concealed.kernel), _experiment(bench)
    coarse, fine = (bench.machine.simulate(kernel, bench.period, inputs, step=bench.machine.step / k) for k in (1, 4))
    for j, signal in enumerate(bench.machine.outputs):
        if signal in bench.instruments:
            instrument = bench.instruments[signal]
            noise = np.hypot(instrument.noise, instrument.quantum / np.sqrt(12))
            assert np.sqrt(np.mean((coarse[:, j] - fine[:, j]) ** 2)) < 0.1 * noise, signal


def test_dry_friction_sticks():
    bench = BENCHES["Joint"]
    torque = np.concatenate([np.full(200, 0.003), np.full(200, 0.006), np.zeros(600)])[:, None]
    kernel = bench.kernel(bench.believed) | {"shaft_tau_c": 0.004}
    speed = bench.machine.simulate(kernel, bench.period, torque)[:, bench.machine.outputs.index("w")]
    assert np.all(speed[:200] == 0)  # below the level it does not move at all
    assert speed[399] > 1
    assert speed[-1] == 0  # and it comes to rest, exactly


def test_unknown_parameter_is_refused():
    bench = BENCHES["Joint"]
    with pytest.raises(KeyError, match="no parameter"):
        bench.machine.simulate({"J": 1e-4, "bogus": 1.0}, bench.period, np.zeros((5, 1)))
