"""Whole actuators: energy balances, faults, scenarios, variants."""

from __future__ import annotations

import numpy as np
import pytest

VARIANTS = [
    "Ramp", "SlowSine", "Reversal", "Eccentric", "ShortedTurns", "EndStop", "LoadStep", "Sampled", "Pwm", "Hysteresis",
]  # fmt: skip
SCENARIOS = ["FlightControlEma", "BallScrewEma", *(f"Scenarios.{name}" for name in VARIANTS)]


@pytest.mark.parametrize("name", SCENARIOS)
def test_energy_and_currents_balance(run, name: str) -> None:
    """Supplied = lost + delivered + stored, to 1e-6 of what was turned over; phase currents sum to zero."""
    result = run(f"Actuators.{name}", rtol=None)
    turned_over = sum(
        np.abs(np.diff(result[k])).sum() for k in ("supplied.E", "copper.E", "rubbed.E", "delivered.E", "stored")
    )
    assert np.abs(result["unaccounted"]).max() < 1e-6 * turned_over
    assert np.abs(result["winding.a.i"] + result["winding.b.i"] + result["winding.c.i"]).max() < 1e-9
    for heat in ("copper.E", "rubbed.E"):
        assert np.diff(result[heat]).min() > -1e-9 * turned_over


def settled(run, **parameters: float) -> dict[str, float]:
    result = run("Actuators.FlightControlEma", stop=1.5, parameters=parameters, rtol=1e-7)
    return {
        n: result[n][-1]
        for n in ("surface.phi", "controller.position", "copper.E", "rubbed.E", "followingError.tripped")
    }


def test_step_is_followed_and_nothing_trips(run) -> None:
    end = settled(run)
    assert end["surface.phi"] == pytest.approx(0.1, abs=5e-4)
    assert end["followingError.tripped"] == 0


def test_offset_of_the_transducer_is_invisible_to_the_loop(run) -> None:
    end = settled(run, offset=0.01)
    assert end["controller.position"] == pytest.approx(0.1, abs=5e-4)
    assert end["surface.phi"] == pytest.approx(0.09, abs=5e-4)


def test_friction_costs_energy(run) -> None:
    healthy, worn = settled(run), settled(run, friction=2.0)
    assert worn["rubbed.E"] > 1.3 * healthy["rubbed.E"]
    assert worn["copper.E"] > healthy["copper.E"]


def test_play_lets_motor_and_surface_part(run) -> None:
    result = run("Actuators.Scenarios.Reversal", rtol=1e-7)
    gap = result["rotor.phi"] / 160 - result["surface.phi"]
    assert gap.max() > 2e-3 and gap.min() < -2e-3
    pull = -result["transmission.tau"] * result["transmission.side"]
    assert pull.max() < 1e-10  # N.m: the rounding of the instant of release


def test_end_stop_holds_and_following_error_trips(run) -> None:
    result = run("Actuators.Scenarios.EndStop", rtol=1e-7)
    assert result["surface.phi"].max() < 0.105
    assert result["followingError.tripped"][-1] == 1
    exceeded = result.time[np.argmax(result["followingError.exceeded"] == 1)]
    assert result["followingError.t_trip"][-1] >= exceeded + 0.2


def test_slow_sine_sticks_at_its_reversals(run) -> None:
    result = run("Actuators.Scenarios.SlowSine", rtol=1e-7)
    stuck = result["hingeFriction.mode"] == 0
    assert 0.02 < stuck.mean() < 0.9
    moving = np.abs(result["surface.w"][stuck])
    assert moving.max() == 0.0


def test_shorted_turns_unbalance_the_phases(run) -> None:
    healthy, shorted = run("Actuators.FlightControlEma", rtol=1e-7), run("Actuators.Scenarios.ShortedTurns", rtol=1e-7)

    def unbalance(result) -> float:
        rms = [np.sqrt(np.trapezoid(result[f"winding.{x}.i"] ** 2, result.time)) for x in "abc"]
        return (max(rms) - min(rms)) / np.mean(rms)

    assert unbalance(shorted) > unbalance(healthy) + 0.01


def test_sampled_control_with_noise_repeats_itself_exactly(run) -> None:
    first, second = (run("Actuators.Scenarios.Sampled", stop=0.3, rtol=None) for _ in range(2))
    assert all(np.array_equal(first[n], second[n]) for n in ("rotor.w", "controller.i_ref", "surface.phi"))
    other = run("Actuators.Scenarios.Sampled", stop=0.3, rtol=None, parameters={"controller.seed": 5})
    assert not np.array_equal(first["controller.i_ref"], other["controller.i_ref"])


@pytest.mark.parametrize("variant", ["Pwm", "Hysteresis"])
def test_switched_drives_move_the_surface_as_the_averaged_one_does(run, variant: str) -> None:
    times = np.linspace(0.02, 0.1, 9)
    options = {"stop": 0.1, "output_times": times, "events": False}
    averaged = run("Actuators.FlightControlEma", parameters={"command.t_start": 0.01}, **options)
    switched = run(f"Actuators.Scenarios.{variant}", rtol=1e-7, **options)
    assert np.abs(averaged["surface.phi"] - switched["surface.phi"]).max() < 0.15 * averaged["surface.phi"].max()


def test_ball_screw_actuator_reaches_its_command(run) -> None:
    result = run("Actuators.BallScrewEma", rtol=1e-7)
    assert result["ram.s"][-1] == pytest.approx(0.02, abs=1e-5)


def test_load_and_command_from_files(run, tmp_path) -> None:
    """A recorded hinge moment and a recorded command, by redeclaration alone."""
    (tmp_path / "flight.csv").write_text("time,command,moment\n0,0,0\n0.1,0.05,0\n0.3,0.05,40\n1.0,0.05,40\n")
    model = """
    model Test
      extends Lacuna.Actuators.FlightControlEma(
        redeclare Lacuna.Components.Sources.CsvTable command(fileName="flight.csv", column="command"),
        redeclare Lacuna.Components.Sources.CsvTable gust(fileName="flight.csv", column="moment"));
    end Test;
    """.strip()
    result = run(model, stop=1.0, interval=0.05, rtol=1e-7, events=False)
    moment = np.interp(result.time, [0.1, 0.3], [0, 40])
    assert np.abs(result["aero.tau"] - moment - 30 * result["surface.phi"]).max() < 1e-9
    assert result["surface.phi"][-1] == pytest.approx(0.05, abs=2e-3)
