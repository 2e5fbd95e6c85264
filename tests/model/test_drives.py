"""Bridge, commutation, machine and current regulation."""

from __future__ import annotations

import numpy as np
import pytest

DRIVE = """
model Test
  import Lacuna.Components.*;
  {components}
equation
  {equations}
end Test;
"""


def drive(components: str, equations: str) -> str:
    return DRIVE.format(components=components, equations=equations)


LOCKED = (
    "Electrical.Bus supply(V=20, R={R_bus}); Electrical.Ground ground; Drives.Bridge bridge;"
    "Drives.StarWinding winding(R=1, L=1e-3, Ke=0.05, pp=1); Mechanics.Fixed rotor(phi0=1.05);"
)
WIRES = (
    "connect(supply.n, ground.p); connect(supply.p, bridge.p); connect(supply.n, bridge.n);"
    "connect(bridge.a, winding.pin_a); connect(bridge.b, winding.pin_b); connect(bridge.c, winding.pin_c);"
    "connect(winding.flange, rotor.flange);"
)


def test_current_of_an_opened_leg_runs_out_through_its_diode_once(run) -> None:
    """Rotor locked. a high, b low; then a is opened too: its current flows on from the low rail through its diode, and
    around the short circuit of a and b dies with L/R."""
    model = drive(
        LOCKED.format(R_bus=0),
        WIRES + "bridge.leg[1] = if time < 2e-3 then 1 else 0; bridge.leg[2] = -1; bridge.leg[3] = 0;",
    )
    result = run(model, stop=0.02, interval=1e-5)
    t, i = result.time, result["winding.a.i"]
    i0 = 10 * (1 - np.exp(-2.0))
    on = t <= 2e-3
    assert np.abs(i[on] - 10 * (1 - np.exp(-t[on] / 1e-3))).max() < 1e-6
    decay = (t > 2e-3) & (t < 8e-3)
    assert np.abs(i[decay] - i0 * np.exp(-(t[decay] - 2e-3) / 1e-3)).max() < 1e-6
    diode = result["bridge.leg_a.diode"]
    assert set(diode[(t > 2.001e-3) & (t < 8e-3)]) == {-1}


def test_diode_goes_out_against_a_driven_pair(run) -> None:
    """Phase a carries i0 when it is left; b low, c high: a's terminal is clamped to the low rail until its current is
    zero, then opens at the star point's potential and stays open."""
    model = drive(
        LOCKED.format(R_bus=0),
        WIRES
        + "bridge.leg[1] = if time < 1e-3 then 1 else 0; bridge.leg[2] = -1;"
        + "bridge.leg[3] = if time < 1e-3 then 0 else 1;",
    )
    result = run(model, stop=0.01, interval=1e-5)
    t = result.time
    i0 = 10 * (1 - np.exp(-1.0))
    # three equal R-L from the star: terminals a, b at 0 and c at 20, star at 20/3; i_a falls to -20/3 with L/R
    t_off = 1e-3 * np.log((i0 + 20 / 3) / (20 / 3)) + 1e-3
    conducting = (t > 1e-3) & (t < t_off - 1e-6)
    expected = (i0 + 20 / 3) * np.exp(-(t[conducting] - 1e-3) / 1e-3) - 20 / 3
    assert np.abs(result["winding.a.i"][conducting] - expected).max() < 1e-6
    after = t > t_off + 1e-6
    assert np.abs(result["winding.a.i"][after]).max() < 2e-9
    assert np.allclose(result["bridge.a.v"][after], 10.0, atol=1e-5)
    extinctions = np.flatnonzero((np.diff(result["bridge.leg_a.diode"]) != 0) & (t[1:] > 1.1e-3))
    assert len(extinctions) == 1 and t[extinctions[0] + 1] == pytest.approx(t_off, abs=1e-8)


def test_bus_takes_back_the_energy_of_the_windings(run) -> None:
    """All legs open with current flowing: the diodes return it to the bus, and what is left is heat."""
    gate = "if time < 1e-3 then {0} else 0"
    model = drive(
        LOCKED.format(R_bus=0.2) + "Sensors.EnergyMeter supplied; Sensors.EnergyMeter heat;",
        WIRES
        + f"bridge.leg[1] = {gate.format(1)}; bridge.leg[2] = {gate.format(-1)}; bridge.leg[3] = 0;"
        + "supplied.power = supply.power; heat.power = supply.loss + winding.loss;",
    )
    result = run(model, stop=5e-3, interval=1e-5)
    at_switch = np.searchsorted(result.time, 1e-3)
    assert result["supplied.E"].max() > result["supplied.E"][-1] > 0
    assert result["winding.stored"][at_switch] > 0.01 and result["winding.stored"][-1] < 1e-12
    balance = result["supplied.E"] - result["heat.E"] - result["winding.stored"]
    assert np.abs(balance).max() < 1e-7 * result["supplied.E"].max()


def test_all_legs_open_is_solved(run) -> None:
    """A free-floating machine that is spun: the line voltage stays below the bus, so nothing flows."""
    model = drive(
        "Electrical.Bus supply(V=20); Electrical.Ground ground; Drives.Bridge bridge; Mechanics.SpeedSource rotor;"
        "Drives.StarWinding winding(R=1, L=1e-3, Ke=0.05, pp=2);",
        WIRES + "rotor.u = 150; bridge.leg[1] = 0; bridge.leg[2] = 0; bridge.leg[3] = 0;",
    )
    result = run(model, stop=0.1, interval=1e-4)
    assert np.abs(result["winding.a.i"]).max() < 1e-8
    line = result["bridge.a.v"] - result["bridge.b.v"]
    assert np.abs(line - result["winding.a.e"] + result["winding.b.e"]).max() < 1e-4


@pytest.mark.parametrize("speed", [30.0, -30.0])
def test_machine_has_the_trapezoids_of_its_definition(run, speed: float) -> None:
    model = drive(
        "Drives.StarWinding winding(R=1, L=1e-3, Ke=0.05, pp=3, zeta=0.2, shorted={0.1, 0, 0.3});"
        "Mechanics.SpeedSource rotor; Electrical.Ground ground;",
        f"rotor.u = {speed}; connect(rotor.flange, winding.flange); connect(winding.pin_a, ground.p);",
    )
    result = run(model, stop=0.2, interval=1e-4, events=False)
    theta = 3 * speed * result.time
    for number, (phase, turns) in enumerate((("a", 0.9), ("b", 1.0), ("c", 0.7))):
        x = np.degrees(theta) - 120 * number
        shape = np.interp(np.mod(x, 360), [0, 30, 150, 210, 330, 360], [0, 1, 1, -1, -1, 0])
        expected = turns * 0.05 * shape * (1 + 0.2 * np.cos(theta - np.pi / 3)) * speed
        assert np.abs(result[f"winding.{phase}.e"] - expected).max() < 1e-9


def test_stator_fixed_eccentricity_gives_each_phase_its_own_constant_gap(run) -> None:
    model = drive(
        "Drives.StarWinding winding(R=1, L=1e-3, Ke=0.05, zeta=0.2, convention=Lacuna.Types.Eccentricity.StatorFixed);"
        "Mechanics.SpeedSource rotor; Electrical.Ground ground;",
        "rotor.u = 20; connect(rotor.flange, winding.flange); connect(winding.pin_a, ground.p);",
    )
    result = run(model, stop=0.2, interval=1e-4)
    peaks = [np.abs(result[f"winding.{x}.e"]).max() for x in "abc"]
    assert np.allclose(peaks, [1.2, 0.9, 0.9], rtol=1e-9)


REGULATED = (
    "Electrical.Bus supply(V=20); Electrical.Ground ground; Mechanics.Fixed rotor(phi0=1.05);"
    "Drives.StarWinding winding(R=0.5, L=1e-3, Ke=0.05, pp=1); {drive} drive(i_max=8, {settings});"
)
REGULATED_WIRES = (
    "connect(supply.n, ground.p); connect(supply.p, drive.p); connect(supply.n, drive.n);"
    "connect(winding.sector, drive.sector);"
    "connect(drive.a, winding.pin_a); connect(drive.b, winding.pin_b); connect(drive.c, winding.pin_c);"
    "connect(winding.flange, rotor.flange); drive.i_phase[1] = winding.a.i; drive.i_phase[2] = winding.b.i;"
    "drive.i_phase[3] = winding.c.i; drive.i_ref = if time < 5e-3 then 5 else 20;"
)


@pytest.mark.parametrize(
    ("kind", "settings", "ripple"),
    [
        ("Drives.AveragedDrive", "V=20, Kp=5, Ki=5000", 3e-2),
        ("Drives.HysteresisDrive", "band=0.3, t_dead=0", 0.3),
        ("Drives.HysteresisDrive", "band=0.3, t_dead=1e-6", 0.33),
        ("Drives.PwmDrive", "f_pwm=2e4, Kp=5, Ki=2500, t_dead=0", 0.21),
        ("Drives.PwmDrive", "f_pwm=2e4, Kp=5, Ki=2500, t_dead=1e-6", 0.21),
    ],
)
def test_current_follows_its_reference_up_to_the_limit(run, kind: str, settings: str, ripple: float) -> None:
    model = drive(REGULATED.format(drive=kind, settings=settings), REGULATED_WIRES)
    result = run(model, stop=0.01, interval=1e-5, rtol=1e-8)
    t, i = result.time, result["drive.i_pair"]
    assert np.abs(i[(t > 4e-3) & (t < 5e-3)] - 5).max() < ripple + 1e-6
    assert np.abs(i[t > 9e-3] - 8).max() < ripple + 1e-6
    assert np.abs(result["winding.a.i"] + result["winding.b.i"] + result["winding.c.i"]).max() < 1e-9


def test_dead_time_delays_each_new_command(run) -> None:
    model = drive("Drives.DeadTime d(t_dead=0.01);", "d.u = if time < 0.1 then 1 elseif time < 0.2 then -1 else 1;")
    result = run(model, stop=0.3, output_times=np.array([0.05, 0.105, 0.115, 0.205, 0.215]), events=False)
    assert list(result["d.y"]) == [1, 0, -1, 0, 1]
