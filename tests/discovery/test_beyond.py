"""A law that no catalogue holds is found as an expression."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lacuna.codegen.library.classes import Library
from lacuna.discovery.case.cases import load
from lacuna.discovery.catalogue.amend import Amendment, probe_name
from lacuna.discovery.catalogue.places import read
from lacuna.discovery.fit.lead import fit_believed
from lacuna.discovery.fit.machine import Machine
from lacuna.discovery.law.empirical_law import find
from lacuna.discovery.law.response import Response, linear
from lacuna.discovery.law.terms.courses import evaluate
from lacuna.runtime import RecordedInput
from tests.discovery.conftest import BELIEVED, write_case, write_model


def losing(folder: Path, torque: str, unit: str, c: float) -> Path:
    """A case of the motor with a torque against its shaft, `c` in it in this unit."""
    lines = ["model ConcealingServo", "  extends Lacuna.Benches.DcServo;"]
    lines += [
        "  Lacuna.Components.Mechanics.TorqueSource loss;",
        f'  parameter Real c(unit="{unit}") = {c};',
        "equation",
    ]
    lines += ["  connect(loss.flange, shaft.flange_b);", f"  loss.u = -{torque};", "end ConcealingServo;"]
    return write_case(folder, write_model(folder, lines), BELIEVED | {"R": 3.45})


def test_a_terms_text_is_what_is_evaluated() -> None:
    trajectory = {"w": np.array([-2.0, 0.0, 4.0]), "time": np.arange(3.0)}
    assert evaluate("sign(w)*abs(w/w_ref)^0.5", trajectory, {"w": 4.0}) == pytest.approx([-(0.5**0.5), 0.0, 1.0])
    assert evaluate("cos(time)*0+1", trajectory, {}) == pytest.approx([1.0, 1.0, 1.0])


@pytest.mark.parametrize(("omega", "followed"), [(15.0, True), (40.0, True), (85.5, False)])
def test_what_is_too_fast_for_the_hats_of_effort_does_not_pass_for_a_slow_effort(omega: float, followed: bool) -> None:
    """128 hats over 8 s: 85.5 rad/s beats with their spacing to 14 rad/s."""
    nodes, time = np.linspace(0.0, 8.0, 128), np.linspace(0.0, 8.0, 8001)
    response = Response([nodes], [np.eye(128)])
    (hats,) = response.to([np.sin(omega * time)], [time])
    share = np.sinc(omega * (nodes[1] - nodes[0]) / (2 * np.pi)) ** 2  # mean of a sine under a hat
    assert np.allclose(hats[1:-1], share * np.sin(omega * nodes[1:-1]) * followed, atol=0.02)


def test_the_linear_response_to_an_effort_is_what_a_simulation_gives(friction_case: Path) -> None:
    """At 60 rad/s hats 3 ms apart, 511 of them over 1.5 s, show all but half a hundredth of a sine; the rest is what an
    effort of a thousandth of the drive's changes to second order."""
    case = load(friction_case)
    structure = read(Library(), case.model)
    base, _ = fit_believed(case, Machine(case, Amendment(structure)))
    machine = base.machine.amended(Amendment(structure, probes=(structure.shafts[0],)), case)
    recording, amount = case.fit[0], 1e-6
    effort = np.sin(60.0 * recording.time)
    found = linear(machine, base, 0, 512).to([np.sin(60.0 * r.time) for r in case.fit], [r.time for r in case.fit])[0]
    still = machine.simulate(base.point, recording)
    moved = machine.simulate(base.point, recording, {probe_name(0): RecordedInput(recording.time, amount * effort)})
    said = np.concatenate([(still[c] - moved[c]) / amount / base.noise[c].std for c in base.noise])
    assert np.linalg.norm(found - said) < 0.01 * np.linalg.norm(said)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("torque", "unit", "c", "shape", "phi", "expected"),
    [
        ("c*w^3", "N.m.s3/rad3", 5e-10, "^3", 0.0, 0.004),
        ("c*w*sin(4*theta)", "N.m.s/rad", 2e-5, "sin(4*shaft.phi)", 0.3, 0.00373),  # too fast for 128 hats of effort
    ],
)
def test_a_loss_that_no_catalogue_holds_is_found_as_a_law(
    tmp_path: Path, torque: str, unit: str, c: float, shape: str, phi: float, expected: float
) -> None:
    case = load(losing(tmp_path, torque, unit, c))
    machine = Machine(case, Amendment(read(Library(), case.model)))
    base, _ = fit_believed(case, machine)
    law = find(case, machine.amendment, base)
    prefix = f"{law.attachment.component}."
    values = {n.removeprefix(prefix): v for n, v in law.fit.point.items() if n.startswith(prefix)}
    text = law.attachment.law.expression(values)
    assert law.attachment.location == "shaft" and "shaft.w" in text and shape in text
    at_200 = text.replace("^", "**").replace("shaft.w", "200.0").replace("shaft.phi", str(phi))
    known = {"sign": np.sign, "abs": abs, "sin": np.sin, "cos": np.cos}
    assert eval(at_200, known) == pytest.approx(expected, rel=0.02)
