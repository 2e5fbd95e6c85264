"""Mechanical components against closed forms."""

from __future__ import annotations

import numpy as np
import pytest

AT_REST = "phi(start=0, fixed=true), w(start=0, fixed=true)"


def mechanics(components: str, equations: str) -> str:
    return f"""
model Test
  import Lacuna.Components.Mechanics.*;
  import Lacuna.Components.Sources.*;
  {components}
equation
  {equations}
end Test;
"""


def test_spring_damper_oscillation(run) -> None:
    J, c, d, phi0 = 0.2, 50.0, 0.4, 0.3
    model = mechanics(
        f"Inertia body(J={J}, phi(start={phi0}, fixed=true), w(start=0, fixed=true)); Spring spring(c={c});"
        f"Damper damper(d={d}); Fixed wall;",
        "connect(wall.flange, spring.flange_a); connect(spring.flange_b, body.flange_a);"
        "connect(wall.flange, damper.flange_a); connect(damper.flange_b, body.flange_a);",
    )
    result = run(model, stop=2.0, interval=1e-2)
    t, a = result.time, d / (2 * J)
    wd = np.sqrt(c / J - a * a)
    expected = phi0 * np.exp(-a * t) * (np.cos(wd * t) + a / wd * np.sin(wd * t))
    assert np.abs(result["body.phi"] - expected).max() < 1e-7


def test_rigidly_coupled_inertias_share_their_acceleration(run) -> None:
    """Three inertias on one shaft, one behind a gear and one behind that: index 3, a = tau/(J1 + J2/n^2 + J3/n^2)."""
    model = mechanics(
        f"Inertia a(J=1e-3, {AT_REST}); Gear gear(ratio=5); Inertia b(J=0.05); Inertia c(J=0.02); TorqueSource drive;",
        "drive.u = 0.3; connect(drive.flange, a.flange_a); connect(a.flange_b, gear.flange_a);"
        "connect(gear.flange_b, b.flange_a); connect(b.flange_b, c.flange_a);",
    )
    result = run(model, stop=1.0)
    expected = 0.3 / (1e-3 + 0.07 / 25)
    assert np.allclose(result["a.a"], expected, rtol=1e-9)
    assert result["c.w"][-1] == pytest.approx(expected / 5, rel=1e-8)


def test_coulomb_damped_oscillator_loses_equal_steps_and_sticks(run) -> None:
    """Each half swing is 2 tau_c/c shorter; it stops at the first turning point within tau_c/c."""
    J, c, tau_c, phi0 = 0.01, 4.0, 0.1, 0.23
    model = mechanics(
        f"Inertia body(J={J}, phi(start={phi0}, fixed=true), w(start=0, fixed=true)); Spring spring(c={c});"
        f"DryFriction friction(tau_c={tau_c}); Fixed wall;",
        "connect(wall.flange, spring.flange_a); connect(spring.flange_b, body.flange_a);"
        "connect(body.flange_b, friction.flange_a);",
    )
    half, band = np.pi * np.sqrt(J / c), tau_c / c
    turns = [phi0]
    while abs(turns[-1]) > band:
        turns.append(-(abs(turns[-1]) - 2 * band) * np.sign(turns[-1]))
    result = run(model, stop=100.0, output_times=np.append(half * np.arange(len(turns)), [50.0, 100.0]), events=False)
    assert np.abs(result["body.phi"][: len(turns)] - turns).max() < 1e-6
    assert result["body.w"][-1] == 0.0 and result["body.phi"][-1] == result["body.phi"][-2]


def test_friction_breaks_away_at_its_static_level(run) -> None:
    """Torque rising at 1 N.m/s: rest until peak * tau_c, then acceleration from tau_c."""
    model = mechanics(
        f"Inertia body(J=0.5, {AT_REST}); DryFriction friction(tau_c=0.2, peak=1.5); TorqueSource drive; Ramp ramp;",
        "connect(ramp.y, drive.u); connect(drive.flange, body.flange_a); connect(body.flange_b, friction.flange_a);",
    )
    result = run(model, stop=1.0, interval=1e-2)
    t = np.maximum(result.time, 0.3)
    expected = ((t**2 - 0.3**2) / 2 - 0.2 * (t - 0.3)) / 0.5
    assert np.all(result["body.w"][result.time < 0.299] == 0)
    assert np.abs(result["body.w"] - expected).max() < 1e-7


def test_stick_slip_on_a_moving_belt(run) -> None:
    """Sticks until the spring pulls with peak tau_c, slips on a circle around tau_c/c, sticks again."""
    J, c, w_belt, tau_c, peak = 1.0, 100.0, 0.5, 2.0, 1.5
    model = mechanics(
        f"Inertia body(J={J}, phi(start=0, fixed=true)); Spring spring(c={c}); Fixed wall; SpeedSource belt;"
        f"SlidingContact contact(tau_c={tau_c}, peak={peak}, w_fric(start=0, fixed=true));",
        f"belt.u = {w_belt}; connect(wall.flange, spring.flange_a); connect(spring.flange_b, body.flange_a);"
        "connect(belt.flange, contact.flange_a); connect(contact.flange_b, body.flange_a);",
    )
    wn = np.sqrt(c / J)
    rise, t_break = (peak - 1) * tau_c / c, peak * tau_c / c / w_belt
    t_slip, t_stick = (np.pi + 2 * np.arctan2(w_belt / wn, rise)) / wn, 2 * rise / w_belt
    result = run(model, stop=3.0, interval=1e-3)
    changes = np.flatnonzero(np.diff(result["contact.mode"]) != 0)
    times = result.time[changes + 1]
    expected = [t_break, t_break + t_slip, t_break + t_slip + t_stick]
    assert np.abs(times[:3] - expected).max() < 1e-6


def test_load_dependent_friction_costs_a_share_of_the_torque(run) -> None:
    """Driving against a constant load with flange_b on the load: tau = (1 + mu) load + tau_c at constant speed."""
    model = mechanics(
        "Inertia body(J=0.1, phi(start=0, fixed=true), w(start=2, fixed=true)); TorqueSource drive; TorqueSource load;"
        "LoadFriction friction(tau_c=0.1, mu=0.2);",
        "drive.u = 1.2*3 + 0.1; load.u = -3; connect(drive.flange, body.flange_a);"
        "connect(body.flange_b, friction.flange_a); connect(friction.flange_b, load.flange);",
    )
    result = run(model, stop=1.0)
    assert np.allclose(result["body.w"], 2.0, rtol=1e-10)
    assert np.allclose(result["friction.loss"], 2.0 * 0.7, rtol=1e-10)


def test_stuck_under_load_does_not_creep(run) -> None:
    model = mechanics(
        f"Inertia body(J=1e-4, {AT_REST}); DryFriction friction(tau_c=0.1); TorqueSource drive; Sine torque("
        "amplitude=0.0999, f=3);",
        "connect(torque.y, drive.u); connect(drive.flange, body.flange_a); connect(body.flange_b, friction.flange_a);",
    )
    for solver in ("ida", "dopri5"):
        result = run(model, stop=100.0, interval=1.0, solver=solver)
        assert np.all(result["body.w"] == 0) and np.all(result["body.phi"] == 0)


PULL = 1e-12 * 1000  # N.m; a contact ends where its deformation is zero but for the rounding of the instant
BACKLASH = mechanics(
    "SpeedSource hub(phi(start={phi0})); Backlash teeth(c=1000, d={d}, b=0.02); Inertia body(J=0.05, {rest});",
    "hub.u = {speed}; connect(hub.flange, teeth.flange_a); connect(teeth.flange_b, body.flange_a);",
)


def test_backlash_moves_nothing_within_its_play_and_never_pulls(run) -> None:
    """The hub crosses half the play at constant speed; then an elastic impact throws the body off at twice that."""
    model = BACKLASH.format(phi0=0, d=0, speed=0.5, rest=AT_REST)
    result = run(model, stop=0.08, interval=1e-4)
    t_contact = 0.01 / 0.5
    t_impact = np.pi * np.sqrt(0.05 / 1000)
    before = result.time < t_contact - 1e-9
    after = (result.time > t_contact + t_impact + 1e-6) & (result["teeth.phi_rel"] < 0.0099)
    assert np.all(result["body.w"][before] == 0)
    assert np.any(after) and np.allclose(result["body.w"][after], 1.0, rtol=1e-6)
    assert np.all(result["teeth.tau"] * result["teeth.side"] >= -PULL)


@pytest.mark.parametrize("d", [1.0, 20.0])
def test_damped_teeth_only_push(run, d: float) -> None:
    result = run(BACKLASH.format(phi0=0, d=d, speed=0.5, rest=AT_REST), stop=0.5, interval=1e-4)
    delta = np.sign(result["teeth.phi_rel"]) * np.maximum(np.abs(result["teeth.phi_rel"]) - 0.01, 0)
    assert np.all(result["teeth.tau"] * result["teeth.side"] >= -PULL)
    assert np.all(np.abs(result["teeth.tau"]) <= 2 * 1000 * np.abs(delta) + 1e-6)


def test_backlash_without_play_is_a_spring_and_damper(run) -> None:
    parts = "TorqueSource drive; Inertia body(J=0.05, {rest}); {element}; Fixed wall;"
    wires = (
        "drive.u = 1; connect(drive.flange, body.flange_a); connect(wall.flange, k.flange_a);"
        "connect(k.flange_b, body.flange_b);"
    )
    results = [
        run(mechanics(parts.format(rest=AT_REST, element=element), wires), stop=0.5, interval=1e-2, events=False)
        for element in ("Backlash k(c=50, d=0.3, b=0)", "SpringDamper k(c=50, d=0.3)")
    ]
    one, other = (result["body.phi"] for result in results)
    steps = sum(result.counters["steps"] for result in results)
    assert np.abs(one - other).max() < 1e-9 * np.abs(one).max() * steps  # each step errs by the tolerance of 1e-9


def test_elastic_end_stop_returns_the_speed_and_a_lossy_one_less(run) -> None:
    """Deepest point of an elastic stop: w sqrt(J/c); with damping the stop keeps energy but never pulls."""
    J, c, w0 = 0.02, 500.0, 3.0
    model = mechanics(
        f"Inertia body(J={J}, phi(start=0, fixed=true), w(start={w0}, fixed=true));"
        f"EndStops stops(phi_max=0.3, c={c}, lambda=0);",
        "connect(body.flange_b, stops.flange_a);",
    )
    elastic = run(model, stop=0.15, interval=1e-5)
    assert elastic["body.phi"].max() == pytest.approx(0.3 + w0 * np.sqrt(J / c), rel=1e-6)
    assert elastic["body.w"][-1] == pytest.approx(-w0, rel=1e-7)
    lossy = run(model, stop=0.15, interval=1e-5, parameters={"stops.lambda": 0.2})
    assert np.all(lossy["stops.tau"] * (lossy["body.phi"] - 0.3) >= -1e-12)
    lost = J * (w0**2 - lossy["body.w"][-1] ** 2) / 2
    heat = np.trapezoid(lossy["stops.loss"], lossy.time)
    assert lost > 0.2 * J * w0**2 / 2 and heat == pytest.approx(lost, rel=1e-4)


def test_hinge_moment_balances_the_torque_at_rest(run) -> None:
    model = mechanics(
        f"Inertia body(J=0.1, {AT_REST}); ViscousFriction bearing(b=2); HingeMoment air(tau0=0.5, c=10);"
        "TorqueSource drive;",
        "drive.u = 3; air.u = 0.5; connect(drive.flange, body.flange_a); connect(body.flange_b, bearing.flange_a);"
        "connect(bearing.flange_b, air.flange);",
    )
    assert run(model, stop=20.0)["body.phi"][-1] == pytest.approx(0.2, rel=1e-7)


def test_ball_screw_drives_a_mass_through_a_compliance(run) -> None:
    """Rigid rotation of the screw: the mass follows at lead/(2 pi) and the reflected load comes back the same way."""
    model = mechanics(
        f"Inertia screwBody(J=1e-4, {AT_REST}); BallScrew screw(lead=5e-3); TorqueSource drive; ForceSource load;"
        "TranslationalSpringDamper nut(c=1e7, d=5e3); Mass ram(m=50, s(start=0, fixed=true), v(start=0, fixed=true));",
        "drive.u = 1; load.u = -400; connect(drive.flange, screwBody.flange_a); "
        "connect(screwBody.flange_b, screw.flange_a); connect(screw.flange_b, nut.flange_a); "
        "connect(nut.flange_b, ram.flange_a); connect(ram.flange_b, load.flange);",
    )
    result = run(model, stop=1.0)
    h = 5e-3 / (2 * np.pi)
    expected = (1 - 400 * h) / (1e-4 + 50 * h * h)
    assert result["ram.v"][-1] / h == pytest.approx(expected, rel=1e-3)
    assert result["ram.v"][-1] == pytest.approx(h * result["screwBody.w"][-1], rel=1e-6)


@pytest.mark.parametrize("body", ["teeth", "stop"])
def test_contact_and_release_keep_the_order_of_the_method(run, body: str) -> None:
    """A body meets an elastic contact and leaves it: x_c + w sin(omega t)/omega between, -w after. RK4 has order 4."""
    J, c, w0 = 0.02, 500.0, 3.0
    parts = {
        "teeth": (
            f"Backlash contact(c={c}, b=0.6); Fixed wall;",
            "connect(wall.flange, contact.flange_a);",
            "flange_b",
        ),
        "stop": (f"EndStops contact(phi_max=0.3, c={c}, lambda=0);", "", "flange_a"),
    }
    component, wire, flange = parts[body]
    model = mechanics(
        f"Inertia body(J={J}, phi(start=0, fixed=true), w(start={w0}, fixed=true)); {component}",
        f"{wire} connect(body.flange_b, contact.{flange});",
    )
    t_left = 0.3 / w0 + np.pi * np.sqrt(J / c)
    errors = []
    for step in (2e-3, 1e-3, 5e-4):
        phi = run(model, stop=0.15, solver="rk4", step=step, interval=1e-2)["body.phi"][-1]
        errors.append(abs(phi - (0.3 - w0 * (0.15 - t_left))))
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert np.all(orders > 3.6) and np.mean(orders) > 3.8
