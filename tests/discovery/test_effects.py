"""Effects of the catalogue in a model, and the values that their fits start from."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import nnls

from lacuna import runtime
from lacuna.codegen.compile import compile_model
from lacuna.codegen.library.classes import Library
from lacuna.discovery.case.cases import load
from lacuna.discovery.catalogue import catalogue
from lacuna.discovery.catalogue.amend import Amendment
from lacuna.discovery.catalogue.attachment import Attachment
from lacuna.discovery.catalogue.places import read
from lacuna.discovery.fit.fit import fit
from lacuna.discovery.fit.lead import fit_believed
from lacuna.discovery.fit.machine import Machine
from lacuna.discovery.fit.solver.least_squares import bounded_linear
from lacuna.discovery.naming import candidate_fit
from lacuna.discovery.naming.screen import Screen, prepare
from lacuna.discovery.naming.shapes import limits_of

from .conftest import BELIEVED, attachment, conceal, write_case

RIPPLE = """model RippleServo
  extends Lacuna.Benches.DcServo;
  Lacuna.Effects.PositionRipple friction(tau_c=2e-4, amplitude=1e-4, periods=3, phase=0.7);
equation
  connect(friction.flange, shaft.flange_b);
end RippleServo;
"""

THRESHOLD = """model SpeedLoop "A speed loop whose drive passes no small command, against a load"
  import Lacuna.Components.*;
  input Real w_ref(unit="rad/s") "Reference speed";
  parameter Real K(unit="V.s/rad") = 0.35 "Gain of the loop";
  Lacuna.Effects.DriveDeadzone drive(width=2);
  Electrical.Ground ground;
  Drives.DcWinding winding(R=2, L=0.7e-3, Ke=0.075, i(start=0, fixed=true));
  Mechanics.Inertia shaft(J=2.5e-5, phi(start=0, fixed=true), w(start=0, fixed=true));
  Mechanics.ViscousFriction bearing(b=3e-4);
  Real u(unit="V") = K*(w_ref - shaft.w) "Command";
equation
  drive.u = u;
  connect(drive.n, ground.p);
  connect(drive.p, winding.p);
  connect(drive.n, winding.n);
  connect(winding.flange, shaft.flange_a);
  connect(shaft.flange_b, bearing.flange_a);
end SpeedLoop;
"""


def test_phases_share_the_temperature_of_their_machine(tmp_path: Path) -> None:
    """Rotor held by its friction, b high and c low: both windings warm with the square of one current, all by the same
    rise. der(r) = (h (1 + r/R_0) - r)/tau with the heat h = 2 k i^2 of the cold windings, so at constant i the rise is
    r = h/(1 - g) (1 - exp(-(1 - g) t/tau)) with g = h/R_0."""
    library = Library()
    structure = read(library, "Benches.BldcDrive")
    heating = next(e for e in catalogue.read(library) if e.name == "Heating")
    lines = tuple(structure.phases()[0])
    added = Attachment(heating, "warm", "winding", lines=lines)
    path = tmp_path / "WarmDrive.mo"
    path.write_text(Amendment(structure, [added]).text("WarmDrive"), encoding="utf-8")
    k, tau, cold, v_bus = 1e-3, 0.2, 1e-3, 1.2
    result = runtime.simulate(
        runtime.Model(compile_model(str(path)).path), solver="dopri5", rtol=1e-9, stop=0.5, interval=1e-3,
        parameters={"warm.k_R": k, "warm.tau_th": tau, "warm.R_0": cold}, inputs={"v_bus": v_bus, "dir": 1.0},
    )  # fmt: skip
    assert np.all(result["w"] == 0.0)
    assert np.array_equal(result["warm.rise"], result["warm_b.rise"])
    assert np.array_equal(result["warm.rise"], result["warm_c.rise"])
    current = v_bus / (2 * 2.13)
    heat = 2 * k * current**2
    left = 1 - heat / cold
    expected = heat / left * (1 - np.exp(-left * result.time / tau))
    slack = heat * 0.01  # the current rises within L/R = 0.3 ms, and falls by 0.02 % as the windings warm
    assert np.abs(result["warm.rise"] - expected).max() < slack


def test_a_wave_starts_with_its_mean_level_and_its_amplitude(tmp_path: Path) -> None:
    """Both are columns of one linear problem: friction of mean 2e-4 N.m that swings by half of it. It is linear for a
    little friction only, so the start is of the right size and no more."""
    (tmp_path / "RippleServo.mo").write_text(RIPPLE, encoding="utf-8")
    case = load(write_case(tmp_path / "case", str(tmp_path / "RippleServo.mo"), BELIEVED))
    machine = Machine(case, Amendment(read(Library(), case.model)))
    base, _ = fit_believed(case, machine)
    ripple = attachment(case, "PositionRipple")
    amended = Machine(case, Amendment(machine.amendment.structure, [ripple]))
    best = prepare(Screen(base), ripple, amended)[0]
    assert best.fixed[ripple.full_name("periods")] == 3
    assert 1e-4 < best.start[ripple.full_name("tau_c")] < 4e-4
    assert 0.5e-4 < best.start[ripple.full_name("amplitude")] < 2e-4
    assert best.start[ripple.full_name("phase")] == pytest.approx(0.7, abs=0.5)


def test_the_start_of_a_hypothesis_takes_the_believed_parameters_along(tmp_path: Path) -> None:
    """To first order: what is left after both have moved is the share that the screen says, and the start that is
    taken misses by less than that of the effect alone."""
    (tmp_path / "RippleServo.mo").write_text(RIPPLE, encoding="utf-8")
    case = load(write_case(tmp_path / "case", str(tmp_path / "RippleServo.mo"), BELIEVED))
    base, _ = fit_believed(case, Machine(case, Amendment(read(Library(), case.model))))
    screen = Screen(base)
    column = np.sin(np.arange(len(screen.residual)) / 300.0) + screen.jacobian[: len(screen.residual), 0]
    share, amount = screen.explained([column])
    shift = screen.shifted([column], amount)
    free = base.estimate.free
    steps = np.array([(shift[f.name] - base.point[f.name]) / f.scale for f in free])
    pad = np.zeros(len(screen.load) - len(column))
    left = screen.load + screen.jacobian @ steps + amount[0] * np.concatenate([column, pad])
    assert left @ left == pytest.approx((1 - share) * screen.cost, rel=1e-6)
    assert np.abs(screen.jacobian.T @ left).max() < 1e-6 * np.abs(screen.jacobian.T @ screen.load).max() + 1e-6

    ripple = attachment(case, "PositionRipple")
    candidate = prepare(screen, ripple, Machine(case, Amendment(base.machine.amendment.structure, [ripple])))[0]
    fixed = base.fixed | candidate.fixed

    def missed(start: dict[str, float]) -> float:
        found = fit(candidate.machine, case.fit, base.noise, [*free, *candidate.free], fixed, start=start, iterations=0)
        return found.estimate.cost

    taken = candidate_fit._start(case, base, candidate)
    assert missed(taken) < missed(base.point | candidate.start)


def test_a_stop_is_found_with_its_place_and_its_stiffness_and_damping(tmp_path: Path) -> None:
    case = load(conceal(tmp_path, BELIEVED, stop="EndStop(phi_max=6.5, c=0.02, d=2e-4, J=shaft.J)"))
    machine = Machine(case, Amendment(read(Library(), case.model)))
    base, _ = fit_believed(case, machine)
    stop = attachment(case, "EndStop")
    amended = Machine(case, Amendment(machine.amendment.structure, [stop]))
    best = prepare(Screen(base), stop, amended)[0]
    assert best.predicted > 0.5
    found = candidate_fit.fit_candidate(case, base, 10, 4, lambda text: None, best)
    values = {n: found.point[stop.full_name(n)] for n in ("phi_max", "c", "d")}
    assert values["phi_max"] == pytest.approx(6.5, rel=0.003)
    assert values["c"] == pytest.approx(0.02, rel=0.05) and values["d"] == pytest.approx(2e-4, rel=0.1)


def test_a_parameter_that_starts_at_zero_can_move() -> None:
    """A start of zero is no bound: the angle at which a spring is at rest has to be found."""
    assert limits_of([{"spring.s_0": 0.0, "spring.k": 2.0}]) == {"spring.k": (0.2, 20.0)}


def test_a_threshold_in_a_loop_lets_the_loop_settle_on_it(tmp_path: Path) -> None:
    """The drive is on a share of the time: the command settles at its threshold, the speed below the reference by
    width/K. A step there would switch without end."""
    (tmp_path / "SpeedLoop.mo").write_text(THRESHOLD, encoding="utf-8")
    model = runtime.Model(compile_model(str(tmp_path / "SpeedLoop.mo")).path)
    time = np.linspace(0.0, 1.0, 2001)
    w_ref = runtime.RecordedInput(time, 20.0 * np.minimum(1.0, time / 1e-3))
    result = runtime.simulate(model, inputs={"w_ref": w_ref}, stop=1.0, rtol=1e-6, output_times=time)
    u, v = np.array(result["u"]), np.array(result["drive.v"])
    assert np.all(v[np.abs(u) < 2 * 0.999] == 0.0)
    beyond = np.abs(u) > 2 * 1.001
    assert beyond.any()
    assert np.array_equal(v[beyond], u[beyond])
    late = time > 0.5
    assert np.mean(result["shaft.w"][late]) == pytest.approx(20.0 - 2 / 0.35, rel=2e-3)


def test_bounded_least_squares_agrees_with_non_negative_ones() -> None:
    random = np.random.default_rng(2)
    for _ in range(20):
        columns, target = random.normal(size=(60, 4)), random.normal(size=60)
        bounds = np.array([(-1e-300, np.inf)] * 4)
        assert bounded_linear(columns, target, bounds) == pytest.approx(nnls(columns, target)[0], abs=1e-9)


def test_a_column_that_does_nothing_leaves_the_others_as_they_are() -> None:
    """A step of an input to which nothing answers yet ended the search (exit 70)."""
    random = np.random.default_rng(3)
    columns, target = random.normal(size=(60, 3)), random.normal(size=60)
    bounds = np.array([(0.0, 1.0)] * 3)
    for limits in (None, bounds):
        alone = bounded_linear(columns, target, limits)
        beside = bounded_linear(
            np.insert(columns, 1, 0.0, axis=1), target, None if limits is None else np.vstack([limits, [(0.0, 1.0)]])
        )
        assert np.delete(beside, 1) == pytest.approx(alone, abs=1e-9)
