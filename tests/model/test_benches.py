"""The benches against their equations, written down again here, and against recordings of an independent simulator."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path
import tomllib

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from lacuna import runtime


def excitation(seed: int, amplitude: float, stop: float, samples: int = 200) -> runtime.RecordedInput:
    """A random signal, linear between its samples."""
    values = amplitude * np.cumsum(np.random.default_rng(seed).normal(size=samples)) / np.sqrt(samples)
    return runtime.RecordedInput(np.linspace(0, stop, samples), values)


def integrate(f, x0, recorded: list[runtime.RecordedInput], times: np.ndarray) -> np.ndarray:
    """Piece by piece between the samples of the inputs, where the right-hand side has corners."""
    knots, states = recorded[0].time, [np.array(x0, dtype=float)]
    for a, b in pairwise(knots):

        def right_hand_side(t, x):
            return f(x, *(np.interp(t, r.time, r.values) for r in recorded))

        states.append(solve_ivp(right_hand_side, (a, b), states[-1], rtol=1e-9, atol=1e-11).y[:, -1])
    return np.array(states)[np.searchsorted(knots, times)]


def assert_equal(result: runtime.Result, expected: np.ndarray, names: list[str], tolerance: float) -> None:
    for column, name in enumerate(names):
        assert np.abs(result[name] - expected[:, column]).max() < tolerance * np.abs(expected[:, column]).max(), name


def test_dc_servo(run) -> None:
    u = excitation(1, 8.0, 1.0)
    result = run("Benches.DcServo", stop=1.0, inputs={"u": u}, output_times=u.time, events=False)

    def f(x, u):
        i, w, _ = x
        return (u - 3.5 * i - 0.03 * w) / 3.3e-3, (0.03 * i - 2e-5 * w) / 7e-6, w

    assert_equal(result, integrate(f, [0, 0, 0], [u], u.time), ["i", "w", "theta"], 1e-6)


def test_joint(run) -> None:
    tau = excitation(2, 1e-3, 2.0)
    result = run("Benches.Joint", stop=2.0, inputs={"tau": tau}, output_times=tau.time, events=False)
    expected = integrate(lambda x, tau: ((tau - 1e-4 * x[0]) / 1e-4, x[0]), [0, 0], [tau], tau.time)
    assert_equal(result, expected, ["w", "theta"], 1e-6)


def test_friction_device(run) -> None:
    v = excitation(3, 0.02, 1.0)
    result = run("Benches.FrictionDevice", stop=1.0, inputs={"x": 0.0, "v": v}, output_times=v.time)
    assert np.allclose(result["F"], 1e5 * v.values, rtol=1e-12)


def screw_ema(x, command, load):
    i, wm, thm, ws, ths, xi = x
    N, Vdc = 160, 48
    wref = np.clip(18 * N * (command - ths), -550, 550)
    free = 0.35 * (wref - wm) + 6 * xi
    u = np.clip(free, -Vdc, Vdc)
    Ts = 1e5 * (thm / N - ths) + 12 * (wm / N - ws)
    held = abs(free) > Vdc and free * (wref - wm) > 0
    return (
        (u - 2.1 * i - 0.075 * wm) / 0.7e-3, (0.075 * i - 3e-5 * wm - Ts / N) / 2.5e-5, wm,
        (Ts - 5 * ws - load) / 0.9, ws, 0 if held else wref - wm,
    )  # fmt: skip


def test_screw_ema(run) -> None:
    command, load = excitation(4, 0.6, 1.0), excitation(5, 40.0, 1.0)
    inputs = {"theta_cmd": command, "T_aero": load}
    result = run("Benches.ScrewEma", stop=1.0, inputs=inputs, output_times=command.time, events=False)
    expected = integrate(screw_ema, [0] * 6, [command, load], command.time)
    assert np.abs(result["u"]).max() >= 48, "the excitation should reach the limit of the drive"
    # the model's integral is held over 2e-4 of the limit rather than at a point
    assert_equal(result, expected, ["i", "wm", "thm", "ws", "ths", "xi"], 2e-4)


@pytest.mark.parametrize(("case", "shorted"), [("p09", {"winding.shorted[2]": "fraction"})])
def test_bldc_drive_against_recordings_of_an_independent_simulator(run, shared: Path, case, shorted) -> None:
    """With the true parameters what is left is the recordings' noise, over starts from rest and reversals."""
    folder = shared / "recordings" / "practice" / case
    truth = tomllib.loads((folder / "truth.toml").read_text())
    settings = tomllib.loads((folder / "case.toml").read_text())
    effect = truth["effects"][0]["parameters"]
    parameters = truth["true_parameters"] | {name: effect[key]["value"] for name, key in shorted.items()}
    for name in settings["recordings"]["fit"]:
        data = np.genfromtxt(folder / name, delimiter=",", names=True)
        inputs = {
            "v_bus": runtime.RecordedInput(data["time"], data["v_bus"]),
            "dir": runtime.RecordedInput(data["time"], data["dir"], "hold"),
        }
        result = run(
            "Benches.BldcDrive", parameters=parameters, inputs=inputs, stop=data["time"][-1], rtol=1e-6,
            output_times=data["time"], events=False, solver="dopri5",
        )  # fmt: skip
        for signal in ("ia", "ib", "ic", "theta"):
            noise = settings["signals"][signal]["noise_std"]
            assert np.nanstd(result[signal] - data[signal]) < 1.1 * noise


def bldc(run, v_bus: float, direction: float, **options) -> runtime.Result:
    return run("Benches.BldcDrive", inputs={"v_bus": v_bus, "dir": direction}, **options)


def test_bldc_drive_is_mirrored_by_its_direction(run) -> None:
    """Around 60 electrical degrees the machine is its own mirror image with phases a and b exchanged."""
    options = {"stop": 0.5, "interval": 1e-3, "events": False, "initial": {"theta": np.pi / 6}}
    ahead, back = bldc(run, 28.0, 1.0, **options), bldc(run, 28.0, -1.0, **options)
    assert ahead["w"].max() > 100
    assert np.abs(ahead["w"] + back["w"]).max() < 1e-5 * ahead["w"].max()
    for one, other in (("ia", "ib"), ("ib", "ia"), ("ic", "ic")):
        assert np.sqrt(np.mean((ahead[one] - back[other]) ** 2)) < 1e-3 * np.abs(ahead[one]).max()
    assert np.abs(ahead["ia"] + ahead["ib"] + ahead["ic"]).max() < 1e-9


@pytest.mark.parametrize("v_bus", [0.0, -1.0])
def test_bus_at_zero_is_a_short_circuit_of_the_phases(run, v_bus: float) -> None:
    """All terminals at zero potential; the spinning rotor brakes itself and then stays at exactly zero speed."""
    result = bldc(run, v_bus, 1.0, stop=0.2, interval=1e-4, initial={"w": 100.0})
    for leg in "abc":
        assert np.abs(result[f"bridge.{leg}.v"]).max() < 2e-6  # an open leg conducts from 1e-6 V on
    assert result["w"][-1] == 0.0
    assert np.all(np.diff(result["w"]) <= 1e-9)


def test_weak_bus_holds_the_rotor_in_its_friction(run) -> None:
    """The stall torque 2 Ke V/(2 R) is below tau_c: it stays at rest, at exactly zero speed, for ever."""
    v_bus = 0.9 * 0.09357 * 2 * 2.13 / (2 * 0.12476)
    result = bldc(run, v_bus, 1.0, stop=100.0, interval=1.0)
    assert np.all(result["w"] == 0.0) and np.all(result["theta"] == 0.0)
    assert abs(result["ib"][-1]) == pytest.approx(v_bus / (2 * 2.13), rel=1e-6)


@pytest.mark.parametrize("v_bus", [6.0, 24.0])
def test_unlike_phases_come_to_rest_on_a_bus_at_zero(run, v_bus: float) -> None:
    """What is left of the currents of unlike phases hovers about a diode's threshold: its events settle either way."""
    model = "model Test\n extends Lacuna.Benches.BldcDrive(winding(shorted={0, 0, 0.0278}));\nend Test;\n"
    time = np.linspace(0, 1, 5001)
    bus = np.where((time < 0.6) & (np.sin(40 * time) > 0), v_bus, 0.0)
    inputs = {
        "v_bus": runtime.RecordedInput(time, bus),
        "dir": runtime.RecordedInput(time, np.where(time < 0.3, 1.0, -1.0), "hold"),
    }
    result = run(model, inputs=inputs, stop=1.0, output_times=time, events=False, solver="dopri5", rtol=1e-6)
    assert result["w"][-1] == 0.0
    assert np.abs(result["ia"][time > 0.95]).max() < 1e-6


@pytest.mark.parametrize("t_restart", [0.0031, 0.0512, 0.0777, 0.0931])
def test_bldc_drive_goes_on_from_any_state(run, t_restart: float) -> None:
    """A run started from the states of another continues it: modes, sectors and diodes follow from them."""
    options = {"events": False, "stop": 0.12, "rtol": 1e-8}
    whole = bldc(run, 28.0, 1.0, output_times=np.linspace(t_restart, 0.12, 200), **options)
    start = {name: whole[name][0] for name in ("ia", "ib", "w", "theta")}
    rest = bldc(run, 28.0, 1.0, initial=start, start=t_restart, output_times=whole.time, **options)
    for name in ("ia", "ib", "ic", "w"):
        assert np.abs(rest[name] - whole[name]).max() < 2e-5 * np.abs(whole[name]).max()


@pytest.mark.parametrize(
    ("bench", "parameter", "value"),
    [("DcServo", "J", -1e-6), ("DcServo", "L", 0.0), ("BldcDrive", "tau_c", -0.1), ("ScrewEma", "N", 0.0)],
)
def test_impossible_parameters_are_refused(run, bench: str, parameter: str, value: float) -> None:
    with pytest.raises(runtime.SimulationError, match=parameter):
        run(f"Benches.{bench}", parameters={parameter: value}, stop=0.1)


@pytest.mark.parametrize("bench", ["FlightControl", "ScrewEma"])
@pytest.mark.parametrize("solver", ["ida", "dopri5", "rodas4"])
def test_a_controlled_machine_comes_to_rest(run, bench: str, solver: str) -> None:
    """Its errors end at zero: where their signs were events, each loop turned on and on there."""
    at_rest = {"theta_cmd": 0.0, "T_aero": 0.0}
    result = run(f"Benches.{bench}", stop=0.5, solver=solver, inputs=at_rest, initial={"shaft.w": 1e-3}, rtol=1e-6)
    assert np.abs(result["wm"][-1]) < 1e-4
