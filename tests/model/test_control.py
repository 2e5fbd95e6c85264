"""Controllers, filters, converters, noise and supervision against closed forms and definitions in Python."""

from __future__ import annotations

import numpy as np
import pytest

BLOCK = """
model Test
  import Lacuna.Components.Control.*;
  import Lacuna.Components.Sensors.*;
  import Lacuna.Components.Sources.*;
  import Lacuna.Components.Monitors.*;
  {components}
equation
  {equations}
end Test;
"""


def blocks(components: str, equations: str = "") -> str:
    return BLOCK.format(components=components, equations=equations)


def test_three_stage_filter_step(run) -> None:
    """Three equal lags: y = 1 - e^-x (1 + x + x^2/2), x = t/T."""
    result = run(blocks("ThreeStageFilter f(f_c=20);", "f.u = 1;"), stop=0.1, interval=1e-3)
    x = result.time * 2 * np.pi * 20
    assert np.abs(result["f.y"] - (1 - np.exp(-x) * (1 + x + x * x / 2))).max() < 1e-7


def test_pi_ramps_to_its_limit_and_leaves_it_at_once(run) -> None:
    """Constant input 1: y = k (1 + t/Ti) up to the limit; when the input turns, the output leaves the limit in that
    instant, because the integral has not grown further (but for
    the thousandth of the range over which holding sets in)."""
    model = blocks("PI c(k=2, Ti=0.5, y_max=3); Step s(height=-2, offset=1, t_start=1);", "connect(s.y, c.u);")
    result = run(model, stop=1.5, interval=1e-2)
    t = result.time
    assert np.allclose(result["c.y"][t < 0.249], 2 * (1 + t[t < 0.249] / 0.5), rtol=1e-8)
    assert np.allclose(result["c.y"][(t > 0.251) & (t < 0.999)], 3.0)
    after = t > 1.0001
    assert np.allclose(result["c.y"][after], np.maximum(2 * (-1 + 0.5 - (t[after] - 1) / 0.5), -3), atol=7e-3)


def test_pid_of_a_ramp(run) -> None:
    """u = t: P t, I t^2/(2 Ti), D Td (1 - e^(-t/Tf))."""
    model = blocks("PID c(k=2, Ti=0.5, Td=0.2, Nd=10, y_max=100); Ramp s(height=1, duration=1);", "connect(s.y, c.u);")
    result = run(model, stop=0.99, interval=1e-2)
    t = result.time
    expected = 2 * (t + t * t / (2 * 0.5) + 0.2 * (1 - np.exp(-t / 0.02)))
    assert np.abs(result["c.y"] - expected).max() < 1e-6


def sampled_pid(u: np.ndarray, T: float, k: float, Ti: float, Td: float, Nd: float, limit: float) -> np.ndarray:
    x = d = last = 0.0
    out = []
    for value in u:
        d = (Td / Nd * d + Td * (value - last)) / (Td / Nd + T)
        last = value
        free = k * (value + x + d)
        out.append(np.clip(free, -limit, limit))
        if not (abs(free) > limit and free * value > 0):
            x += T / Ti * value
    return np.array(out)


@pytest.mark.parametrize(
    "block", ["SampledPI c(T=0.01, k=2, Ti=0.5, y_max=3)", "SampledPID c(T=0.01, k=2, Ti=0.5, Td=0.05, y_max=3)"]
)
def test_sampled_controllers(run, block: str) -> None:
    model = blocks(f"{block}; Sine s(amplitude=1.5, f=0.8);", "connect(s.y, c.u);")
    result = run(model, stop=1.995, output_times=0.005 + 0.01 * np.arange(200), events=False)
    samples = 1.5 * np.sin(2 * np.pi * 0.8 * 0.01 * np.arange(200))
    Td = 0.05 if "PID" in block else 0.0
    expected = sampled_pid(samples, 0.01, 2, 0.5, Td, 10, 3) if Td else sampled_pi(samples, 0.01, 2, 0.5, 3)
    assert np.abs(result["c.y"] - expected).max() < 1e-9


def sampled_pi(u: np.ndarray, T: float, k: float, Ti: float, limit: float) -> np.ndarray:
    x, out = 0.0, []
    for value in u:
        free = k * (value + x)
        out.append(np.clip(free, -limit, limit))
        if not (abs(free) > limit and free * value > 0):
            x += T / Ti * value
    return np.array(out)


def test_adc_rounds_and_saturates(run) -> None:
    model = blocks("Adc adc(T=0.01, range=2, bits=8); Sine s(amplitude=2.5, f=0.5);", "connect(s.y, adc.u);")
    result = run(model, stop=1.995, output_times=0.005 + 0.01 * np.arange(200), events=False)
    lsb = 4 / 256
    u = 2.5 * np.sin(np.pi * 0.01 * np.arange(200))
    assert np.abs(result["adc.y"] - np.clip(lsb * np.floor(u / lsb + 0.5), -2, 2 - lsb)).max() < 1e-12


def test_hysteresis_switches_at_its_two_levels(run) -> None:
    result = run(
        blocks("Hysteresis h(u_low=-0.5, u_high=0.7); Sine s;", "connect(s.y, h.u);"),
        stop=2.0,
        interval=1e-2,
        max_step=1e-2,
    )
    switched = result.time[np.flatnonzero(np.diff(result["h.y"])) + 1]
    up, down = np.arcsin(0.7) / (2 * np.pi), (np.pi + np.arcsin(0.5)) / (2 * np.pi)
    assert np.abs(switched - [up, down, 1 + up, 1 + down]).max() < 1e-7


def test_limiter(run) -> None:
    result = run(
        blocks("Limiter l(y_max=0.5, y_min=-0.2); Sine s;", "connect(s.y, l.u);"),
        stop=1.0,
        interval=1e-2,
        max_step=1e-2,
    )
    assert np.abs(result["l.y"] - np.clip(result["s.y"], -0.2, 0.5)).max() < 1e-9


def wichmann_hill_box_muller(seed: int, count: int) -> np.ndarray:
    a, m = np.array([171, 172, 170]), np.array([30269, 30307, 30323])
    s = 1 + (a * (seed % m) + [11, 23, 37]) % (m - 1)
    values = []
    for _ in range(count):
        r = a * s % m
        s = a * r % m
        u1, u2 = (r / m).sum() % 1, (s / m).sum() % 1
        values.append(np.sqrt(-2 * np.log(1 - u1)) * np.cos(2 * np.pi * u2))
    return np.array(values)


@pytest.mark.parametrize("solver", ["ida", "rk4"])
def test_noise_is_its_seed_and_nothing_else(run, solver: str) -> None:
    options = {"step": 1e-3} if solver == "rk4" else {}
    model = blocks("Noise n(T=1e-3, std=2, seed=7); FirstOrder f(f_c=3);", "connect(n.y, f.u);")
    result = run(model, solver=solver, stop=3.9995, output_times=5e-4 + 1e-3 * np.arange(4000), events=False, **options)
    expected = 2 * wichmann_hill_box_muller(7, 4000)
    assert np.abs(result["n.y"] - expected).max() < 1e-9
    assert abs(expected.mean()) < 4 * 2 / np.sqrt(4000) and expected.std() == pytest.approx(2, rel=0.05)


def test_supervisor_confirms_before_it_trips(run) -> None:
    """A sine above 0.8 for less than the confirmation time does not trip; a slower one does, that late."""
    model = blocks("Supervisor m(limit=0.8, t_confirm=0.15); Sine s(f=1);", "connect(s.y, m.u);")
    above = 0.5 - 2 * np.arcsin(0.8) / (2 * np.pi)
    quick = run(model, stop=3.0, max_step=1e-2, parameters={"m.t_confirm": above + 0.01})
    assert not quick["m.tripped"].any() and np.all(quick["m.t_trip"] == -1)
    slow = run(model, stop=3.0, max_step=1e-2)
    assert slow["m.tripped"][-1] == 1
    assert slow["m.t_trip"][-1] == pytest.approx(np.arcsin(0.8) / (2 * np.pi) + 0.15, abs=1e-8)


def test_transducer_and_encoder(run) -> None:
    model = blocks(
        "Lacuna.Components.Mechanics.SpeedSource hub; Encoder e(steps=360, T=1e-3);"
        "PositionTransducer p(offset=0.1, gain=1.02, f_c=50);",
        "hub.u = 2; connect(hub.flange, e.flange); connect(hub.flange, p.flange);",
    )
    times = 5e-4 + 1e-3 * np.arange(900)
    result = run(model, stop=0.9, output_times=times, events=False)
    step = 2 * np.pi / 360
    assert np.abs(result["e.y"] - step * np.floor(2 * (times - 5e-4) / step + 1e-9)).max() < 1e-9
    T = 1 / (2 * np.pi * 50)
    assert np.abs(result["p.y"] - (0.1 + 1.02 * 2 * (times - T + T * np.exp(-times / T)))).max() < 1e-7
