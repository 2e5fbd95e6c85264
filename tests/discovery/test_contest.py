"""Contests of hypotheses: what shares a model while it is screened, what is not looked at, and what is left."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from lacuna.codegen.library.classes import Library
from lacuna.discovery.case.cases import Case, load
from lacuna.discovery.catalogue import catalogue
from lacuna.discovery.catalogue.amend import Amendment
from lacuna.discovery.catalogue.hypotheses import enumerate_attachments
from lacuna.discovery.catalogue.places import read
from lacuna.discovery.fit.evidence import is_noise
from lacuna.discovery.fit.fit import Fit, linearised
from lacuna.discovery.fit.lead import Lead, fit_believed
from lacuna.discovery.fit.machine import Machine, try_machine
from lacuna.discovery.naming.candidate_fit import shared
from lacuna.discovery.naming.judge import judge, noise_floor
from lacuna.discovery.naming.name import Contest
from lacuna.discovery.naming.race import outdone
from lacuna.discovery.naming.screen import Screen, prepare
from lacuna.discovery.naming.search import Search
from lacuna.discovery.steps import fitted

from .conftest import BELIEVED, attachment, conceal
from .recorded import concealed, record


@pytest.fixture(scope="module")
def case(tmp_path_factory: pytest.TempPathFactory) -> Case:
    """Drag of some 0.7 mN.m, a tenth of what accelerates the shaft."""
    return load(conceal(tmp_path_factory.mktemp("contest"), BELIEVED, drag="QuadraticDrag(c2=7e-8)"))


@pytest.fixture(scope="module")
def base(case: Case) -> Fit:
    return fit_believed(case, Machine(case, Amendment(read(Library(), case.model))))[0]


def test_a_hypothesis_promises_beside_others_what_it_promises_alone(case: Case, base: Fit) -> None:
    """Two errors of one sensor among them: neither reads the other. The solver steps otherwise in a larger model; what
    its tolerance of 1e-6 may change of a response of a tenth of the misfit is far below a thousandth."""
    amendment, screen = base.machine.amendment, Screen(base)
    found = enumerate_attachments(case, amendment.structure, catalogue.read(Library()), amendment)
    machines = shared(case, amendment, found, base)
    assert {"SensorGain", "SensorOffset", "ConstantLoad", "Spring"} <= {
        a.effect.name for a in found if a.label in machines
    }
    assert not any(a.effect.friction or a.part for a in found if a.label in machines)
    for one in (a for a in found if a.label in machines):
        own, _ = try_machine(case, replace(amendment, attachments=[one]), base.machine)
        alone, beside = (prepare(screen, one, m) for m in (own, machines[one.label]))
        assert [c.predicted for c in beside] == pytest.approx([c.predicted for c in alone], abs=1e-3), one.label


def test_errors_of_sensors_are_seen_at_a_shaft_that_turns_on_and_on(case: Case, base: Fit) -> None:
    """A spring there cannot be simulated: all that would share a model with it were of no use."""
    fast = replace(case, fit=[r.redriven("fast", {"u": lambda u: 0 * u + 100.0}) for r in case.fit])
    machine = base.machine.amended(base.machine.amendment, fast)
    there = linearised(machine, fast.fit, base.noise, base.estimate.free, base.fixed, base.point)
    assert max(np.abs(machine.simulate(there.point, r)["theta"]).max() for r in fast.fit) > 2000
    names = ("Spring", "SensorGain", "SensorCubic")
    found = [attachment(fast, name) for name in names]
    machines = shared(fast, machine.amendment, found, there)
    assert found[0].label not in machines
    for one in found[1:]:
        assert prepare(Screen(there), one, machines[one.label])[0].predicted > 0


def test_a_first_look_is_coarse_where_nothing_switches_and_promises_the_same(case: Case, base: Fit) -> None:
    """At a tolerance whose errors are a thousandth of the noise; a hundred times as much is far below the response
    of a tenth of the misfit. A shaft that sticks lets go when it does, which is no error of that size."""
    precise = base.machine.precise(base.point, base.noise)
    base = linearised(precise, case.fit, base.noise, base.estimate.free, base.fixed, base.point)
    fine, coarse = Screen(base), Screen(base, coarsely=True)
    drag, friction = (attachment(case, name) for name in ("QuadraticDrag", "CoulombFriction"))
    alone = [replace(base.machine.amendment, attachments=[a]) for a in (drag, friction)]
    machine, sticking = (try_machine(case, amendment, base.machine)[0] for amendment in alone)
    long, first = (prepare(screen, drag, machine)[0].predicted for screen in (fine, coarse))
    assert coarse.coarsely and long != first == pytest.approx(long, abs=1e-3)
    stuck = base.fixed | {friction.full_name("tau_c"): 2e-3}
    switching = linearised(sticking, case.fit, base.noise, base.estimate.free, stuck, base.point)
    assert not Screen(switching, coarsely=True).coarsely


def test_richer_forms_of_friction_are_not_looked_at_where_something_else_leaves_noise(case: Case, base: Fit) -> None:
    amendment = base.machine.amendment
    names = ("QuadraticDrag", "ConstantLoad", "CoulombFriction", "StribeckFriction", "PositionRipple", "GravityLoad")
    contest = Contest(case, base, amendment, [attachment(case, n) for n in names], lambda text: None)
    naming = contest.naming()
    assert naming.best.attachment.effect.name == "QuadraticDrag" and is_noise(naming.best.fit)
    assert {label.split()[0] for label in naming.unneeded} == {"friction.stribeck", "friction.position"}
    assert naming.best.fit.machine.amendment.attachments == [attachment(case, "QuadraticDrag")]


def test_richer_forms_of_friction_are_looked_at_where_nothing_leaves_noise(case: Case, base: Fit) -> None:
    names = ("CoulombFriction", "StribeckFriction")
    contest = Contest(case, base, base.machine.amendment, [attachment(case, n) for n in names], lambda text: None)
    contest.lead()
    assert {c.attachment.effect.name for c in contest.candidates} == set(names)


def test_a_law_that_ended_in_a_dip_begins_again_where_one_that_it_contains_ended(
    friction_case: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    case = load(friction_case)
    base = fit_believed(case, Machine(case, Amendment(read(Library(), case.model))))[0]
    simple, richer = (attachment(case, n) for n in ("CoulombFriction", "StribeckFriction"))
    contest = Contest(case, base, base.machine.amendment, [simple], lambda text: None)
    contest.lead()
    plain = contest.fitted[simple.label]
    machine, _ = try_machine(case, replace(base.machine.amendment, attachments=[richer]), base.machine)
    starts = prepare(Screen(base), richer, machine)
    free = [*base.estimate.free, *starts[0].free]
    levels = {richer.full_name(n): 0.0 for n in ("tau_c", "tau_s")}
    nothing = base.point | {f.name: f.centre for f in starts[0].free} | levels
    dip = replace(starts[0], fit=linearised(machine, case.fit, base.noise, free, base.fixed | starts[0].fixed, nothing))
    pool = contest.fitted | {richer.label: dip}
    assert outdone(starts, pool) == []  # the plain one leaves noise
    monkeypatch.setattr("lacuna.discovery.naming.race.is_noise", lambda fit: False)
    again = outdone(starts, pool)
    assert again and again[0].start[richer.full_name("tau_s")] == plain.fit.point[simple.full_name("tau_c")]
    assert outdone(starts, {richer.label: dip}) == []
    contest._fit(again)
    assert contest.fitted[richer.label].fit.deviance() < plain.fit.deviance() + 1e-3


def test_a_contest_whose_leaders_go_astray_is_left_and_can_be_resumed(case: Case, base: Fit) -> None:
    effects = [e for e in catalogue.read(Library()) if e.name in ("GravityLoad", "CoggingTorque")]
    search = Search(
        case, effects, Lead(), noise_floor(case, case.fit, base.noise), base.machine.amendment, base,
        judge(base.machine, base.point), restarts=True,
    )  # fmt: skip
    search.run(lambda text: None, most=1)
    assert search.lost() and search.left is not None and not search.namings
    search.resume(lambda text: None)
    assert search.left is None and len(search.namings) == 1


ARM = """model Arm "It swings by a fraction of a turn"
  parameter Real J(unit="kg.m2", min=0) = 0.01;
  parameter Real c(unit="N.m/rad", min=0) = 1.0;
  parameter Real d(unit="N.m.s/rad", min=0) = 0.02;
  input Real u(unit="N.m");
  Lacuna.Components.Mechanics.TorqueSource motor(u=u);
  Lacuna.Components.Mechanics.Inertia arm(J=J, phi(start=0, fixed=true), w(start=0, fixed=true));
  Lacuna.Components.Mechanics.SpringDamper spring(c=c, d=d);
  Lacuna.Components.Mechanics.Fixed fixed;
  MORE
equation
  connect(motor.flange, arm.flange_a);
  connect(arm.flange_b, spring.flange_a);
  connect(spring.flange_b, fixed.flange);
  JOINED
end Arm;
"""
ARM_CASE = """title = "arm"
model = "Arm.mo"
source = "synthetic"
[parameters]
J = 0.01
c = 1.0
d = 0.02
[uncertainty]
J = 0.05
c = 0.1
d = 0.3
[signals.u]
role = "input"
variable = "u"
unit = "N.m"
[signals.phi]
role = "output"
variable = "arm.phi"
unit = "rad"
noise_std = 1e-3
[recordings]
fit = ["r1.csv", "r2.csv"]
validate = ["r3.csv"]
"""


def test_whole_numbers_that_no_start_has_are_stepped_to(tmp_path: Path) -> None:
    """Cogging of 22 periods a turn, felt within a fraction of one: starts are at 21 and 24."""
    effect = "Lacuna.Effects.CoggingTorque cogging(amplitude=0.04, periods=22, phase=0.7);"
    concealing = ARM.replace("MORE", effect).replace("JOINED", "connect(cogging.flange, arm.flange_a);")
    folder, machine = concealed(tmp_path, "Arm", concealing, ARM.replace("MORE", "").replace("JOINED", ""), ARM_CASE)
    time, random = np.arange(2000) * 5e-3, np.random.default_rng(3)
    for k in (1, 2, 3):
        u = 0.6 * np.sin(1.1 * k * time) + 0.2 * np.sin(4.3 * time + k)
        errors = {"phi": 1e-3 * random.normal(size=len(time))}
        record(folder / f"r{k}.csv", machine, time, {"u": u}, {"phi": "arm.phi"}, errors)
    start = fitted(load(folder), lambda text: None)
    case, base, library = start.case, start.base, start.case.library()
    every = enumerate_attachments(case, start.amendment.structure, catalogue.read(library), start.amendment)
    cogging = next(a for a in every if a.effect.name == "CoggingTorque")
    assert 22.0 not in cogging.effect.starts["periods"]
    best = Contest(case, base, start.amendment, [cogging], lambda text: None).naming().best
    assert best.fit.point[cogging.full_name("periods")] == 22.0
    assert best.fit.point[cogging.full_name("amplitude")] == pytest.approx(0.04, rel=0.02)
