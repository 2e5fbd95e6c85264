"""The search's moves: which laws go first, what joins, what two effects have to show, what is dropped."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from lacuna.codegen.library.classes import Library
from lacuna.discovery import steps
from lacuna.discovery.case.cases import Case, load
from lacuna.discovery.catalogue.amend import Amendment
from lacuna.discovery.catalogue.catalogue import read as read_catalogue
from lacuna.discovery.catalogue.places import read
from lacuna.discovery.explain import explain
from lacuna.discovery.fit.fit import Fit, fit
from lacuna.discovery.fit.lead import Lead, fit_believed
from lacuna.discovery.fit.machine import Machine
from lacuna.discovery.fit.solver.time_limit import TimeUp
from lacuna.discovery.naming import search as searching
from lacuna.discovery.naming.comparison import Ranked
from lacuna.discovery.naming.judge import judge, noise_floor
from lacuna.discovery.naming.left_out import left_out
from lacuna.discovery.naming.name import Finding, Naming
from lacuna.discovery.naming.race import _enriched, best_starts, first_round, in_the_race
from lacuna.discovery.naming.restarts import _shared
from lacuna.discovery.naming.screen import Candidate, Screen, prepare
from lacuna.discovery.naming.search import Search

from .conftest import BELIEVED, attachment, conceal


def fitted(case: Case, *names: str) -> tuple[Fit, list[Candidate], Candidate]:
    """(the believed model's fit, a candidate for each effect added to those before it, the last one)."""
    structure = read(Library(), case.model)
    believed, _ = fit_believed(case, Machine(case, Amendment(structure)))
    added = [attachment(case, name) for name in names]
    candidates, base = [], believed
    for number, one in enumerate(added, 1):
        machine = Machine(case, Amendment(structure, added[:number]))
        found = prepare(Screen(base), one, machine)[0]
        base = fit(machine, case.fit, base.noise, [*base.estimate.free, *found.free], base.fixed)
        candidates.append(replace(found, fit=base))
    return believed, candidates, candidates[-1]


def both_laws(case: Case) -> tuple[Fit, list[Ranked]]:
    """(the believed model's fit, Stribeck friction ranked 100 before the Coulomb friction that it contains)."""
    base, _, coulomb = fitted(case, "CoulombFriction")
    _, _, stribeck = fitted(case, "StribeckFriction")
    return base, [Ranked(stribeck, stribeck.fit, -3000.0, 1.0), Ranked(coulomb, coulomb.fit, -2900.0, 0.0)]


def tell_as(monkeypatch: pytest.MonkeyPatch, told: Callable[[Machine, dict[str, float]], dict[str, float]]) -> None:
    """Let the search see these NRMSE of recordings left out, made of the machine and its own."""
    real = searching.left_out
    monkeypatch.setattr(searching, "left_out", lambda case, fit: told(fit.machine, real(case, fit)))


def candidate(case: Case, name: str, promise: float) -> Candidate:
    return Candidate(attachment(case, name), None, [], predicted=promise)


BOTH = ["friction.stribeck", "friction.coulomb"]


@pytest.mark.parametrize(
    ("richer", "simpler", "chosen"),
    [(0.96, 0.95, ["friction.coulomb"]), (0.96, 0.5, BOTH), (0.99, 0.92, BOTH)],  # the last leaves eight times as much
)
def test_a_law_waits_for_a_simpler_one_that_promises_as_much(
    friction_case: Path, richer: float, simpler: float, chosen: list[str]
) -> None:
    case = load(friction_case)
    pool = [candidate(case, "StribeckFriction", richer), candidate(case, "CoulombFriction", simpler)]
    assert [c.attachment.effect.identifier for c in first_round(pool)] == chosen


@pytest.mark.parametrize(
    ("name", "others", "tried"),
    [
        ("TorqueRipple", 0.6, 8),  # any of these numbers of periods may be the one
        ("TorqueRipple", 0.3, 3),
        ("DriveDeadzone", 0.6, 3),  # from one width a fit comes to another
    ],
)
def test_whole_numbers_that_promise_alike_are_all_tried(
    friction_case: Path, name: str, others: float, tried: int
) -> None:
    case = load(friction_case)
    pool = [candidate(case, name, 0.9), *(candidate(case, name, 0.9 * others) for _ in range(11))]
    assert len(first_round(pool)) == tried


def test_the_most_promising_start_of_a_hypothesis_brings_it_into_the_first_round(friction_case: Path) -> None:
    """Others of its starts promise less than every start of the rivals."""
    case = load(friction_case)
    names = (
        "GravityLoad",
        "QuadraticDrag",
        "IronLoss",
        "ConstantLoad",
        "Spring",
        "Heating",
        "TorqueRipple",
        "DeadTime",
    )
    pool = [candidate(case, "DriveDeadzone", 0.8), candidate(case, "DriveDeadband", 0.5)]
    pool += [candidate(case, name, 0.4) for name in names] + [candidate(case, "DriveDeadzone", 0.01)]
    assert "DriveDeadzone" in [c.attachment.effect.name for c in first_round(pool)]
    assert [c.predicted for c in best_starts(pool)] == [c.predicted for c in pool[:-1]]


def test_an_accepted_fit_that_has_not_converged_is_carried_on(
    friction_case: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Beside the one that has converged there is one that stopped after a step; both come to the same end."""
    case = load(friction_case)
    believed, _, last = fitted(case, "CoulombFriction")
    short = fit(
        last.machine, case.fit, believed.noise, last.fit.estimate.free, last.fit.fixed, start=believed.point,
        stages=1, iterations=1,
    )  # fmt: skip
    judged = judge(last.machine, short.point)
    finding = Finding(Ranked(last, short, -100.0), None, judged, judged)
    floor = noise_floor(case, case.validate, believed.noise)
    search = Search(case, [], Lead(), floor, last.machine.amendment, short, judged, [finding])
    search._carry_on(lambda text: None)
    assert search.fit.deviance() < short.deviance() - 10
    assert search.fit.deviance() == pytest.approx(last.fit.deviance(), abs=1.0)
    assert search.findings[0].after is search.judgement
    ended = search.fit
    monkeypatch.setattr(searching, "carried", None)  # converged: no other fit is made
    search._carry_on(lambda text: None)
    assert search.fit is ended


def test_a_richer_law_begins_where_the_one_it_contains_has_ended(friction_case: Path) -> None:
    case = load(friction_case)
    base, _, best = fitted(case, "CoulombFriction")
    richer = attachment(case, "StribeckFriction")
    machine = Machine(case, Amendment(base.machine.amendment.structure, [richer]))
    begun = _enriched(prepare(Screen(base), richer, machine)[0], best)
    level = best.fit.point[best.attachment.full_name("tau_c")]
    assert begun.start[richer.full_name("tau_c")] == begun.start[richer.full_name("tau_s")] == level
    assert begun.start["R"] == best.fit.point["R"]


def test_the_race_is_shorter_once_a_hypothesis_leaves_noise() -> None:
    assert in_the_race(-100.0, None, -1000.0, won=False)
    assert in_the_race(-100.0, None, -1000.0, won=True)
    assert in_the_race(-950.0, -950.0, -1000.0, won=False)
    assert not in_the_race(-950.0, -950.0, -1000.0, won=True)
    assert in_the_race(-800.0, -700.0, -1000.0, won=True)


def test_two_effects_that_pay_only_together_are_found(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What pays is set so high that neither of the two reaches it alone: within a fifth of the noise."""
    both = {"friction": "CoulombFriction(tau_c=0.0015)", "gravity": "GravityLoad(mgl=0.004)"}
    case = load(conceal(tmp_path, BELIEVED, **both))
    structure = read(Library(), case.model)
    base, lead = fit_believed(case, Machine(case, Amendment(structure)))
    floor = noise_floor(case, case.fit, base.noise)
    monkeypatch.setattr(searching, "pays", lambda before, after, _: all(after[c] < 1.2 * floor[c] for c in floor))
    effects = [e for e in read_catalogue(Library()) if e.name in ("CoulombFriction", "GravityLoad", "QuadraticDrag")]
    before = judge(base.machine, base.point)
    search = Search(case, effects, lead, floor, Amendment(structure), base, before)
    assert search.add(lambda text: None)
    assert sorted(f.ranked.attachment.effect.identifier for f in search.findings) == [
        "friction.coulomb",
        "load.gravity",
    ]
    assert search.findings[0].after.validate[""] > 2 * max(noise_floor(case, case.validate, base.noise).values())


@pytest.mark.parametrize(("unseen", "exchanged"), [(1.0, True), (2.0, False)])
def test_a_finding_gives_way_to_the_simpler_law_unless_that_tells_less_of_what_is_left_out(
    friction_case: Path, monkeypatch: pytest.MonkeyPatch, unseen: float, exchanged: bool
) -> None:
    """Both laws leave the same, so that the simpler one wins by its price but does not pay over the richer one."""
    case = load(friction_case)
    believed, _, stribeck = fitted(case, "StribeckFriction")
    judged = judge(stribeck.machine, stribeck.fit.point)
    naming = Naming([Ranked(stribeck, stribeck.fit, -100.0)], [])
    finding = Finding(naming.best, naming, judged, judged)
    floor = noise_floor(case, case.validate, believed.noise)
    search = Search(
        case, read_catalogue(Library()), Lead(), floor, stribeck.machine.amendment, stribeck.fit, judged, [finding]
    )
    tell_as(
        monkeypatch,
        lambda machine, own: own if machine is stribeck.machine else {c: unseen * v for c, v in own.items()},
    )
    search._reconsider(0, lambda text: None)
    assert (search.findings[0].ranked.identity == ("friction.coulomb", "shaft")) == exchanged


def test_a_finding_that_is_reconsidered_waits_for_no_simpler_law(friction_case: Path) -> None:
    """A constant load that promises something was not tried beside asymmetric friction before: it is a rival now."""
    case = load(friction_case)
    believed, _, asymmetric = fitted(case, "AsymmetricFriction")
    judged = judge(asymmetric.machine, asymmetric.fit.point)
    naming = Naming([Ranked(asymmetric, asymmetric.fit, -100.0)], [])
    finding = Finding(naming.best, naming, judged, judged)
    amendment = asymmetric.machine.amendment
    search = Search(case, read_catalogue(Library()), Lead(), {}, amendment, asymmetric.fit, judged, [finding])
    rivals = search._rivals(finding, believed.machine.amendment, believed)
    labels = {c.attachment.effect.name for c in first_round(sorted(rivals, key=lambda c: -c.predicted))}
    assert {"AsymmetricFriction", "CoulombFriction"} <= labels


def test_a_simpler_friction_begins_at_the_mean_level_of_the_one_that_contains_it(friction_case: Path) -> None:
    case = load(friction_case)
    _, _, coulomb = fitted(case, "CoulombFriction")
    _, _, asymmetric = fitted(case, "AsymmetricFriction")
    own = asymmetric.attachment
    levels = {own.full_name("tau_pos"): 0.001, own.full_name("tau_neg"): 0.002}
    estimate = replace(
        asymmetric.fit.estimate, values=np.array([levels.get(f.name, 1.0) for f in asymmetric.fit.estimate.free])
    )
    richer = replace(asymmetric, fit=replace(asymmetric.fit, estimate=estimate))
    assert _shared(coulomb, richer) == {coulomb.attachment.full_name("tau_c"): pytest.approx(0.0015)}


def test_a_law_that_does_not_pay_gives_way_to_the_simpler_one_it_contains(
    friction_case: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    case = load(friction_case)
    base, ranked = both_laws(case)
    contest = SimpleNamespace(naming=lambda final: Naming(ranked, []), best=lambda: ranked[0].candidate)
    monkeypatch.setattr(Search, "_begun", lambda search, progress: contest)
    before = judge(base.machine, base.point)
    stribeck = ranked[0].fit.machine
    unfound = left_out(case, base)
    tell_as(monkeypatch, lambda machine, own: unfound if machine is stribeck else own)
    floor = noise_floor(case, case.validate, base.noise)
    search = Search(case, [], Lead(), floor, base.machine.amendment, base, before)
    assert search.add(lambda text: None)
    assert [f.ranked.identity for f in search.findings] == [("friction.coulomb", "shaft")]
    assert search.reason == ""


def test_a_finding_that_the_others_do_without_is_dropped(friction_case: Path) -> None:
    case = load(friction_case)
    believed, candidates, last = fitted(case, "CoulombFriction", "QuadraticDrag")
    judged = judge(last.machine, last.fit.point)
    findings = [Finding(Ranked(c, c.fit, -100.0), None, judged, judged) for c in candidates]
    floor = noise_floor(case, case.validate, believed.noise)
    search = Search(case, [], Lead(), floor, last.machine.amendment, last.fit, judged, findings)
    search.drop_needless(lambda text: None)
    assert [f.ranked.attachment.effect.name for f in search.findings] == ["CoulombFriction"]
    assert [a.effect.name for a in search.amendment.attachments] == ["CoulombFriction"]
    assert search.fit.machine.amendment.attachments == [candidates[0].attachment]


def test_a_search_that_runs_out_of_time_leaves_what_it_has_found(
    friction_case: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    case = load(friction_case)
    stopped = explain(case, limit=0.0)
    assert (stopped.verdict, stopped.findings) == ("undetermined", []) and "stopped after 0 s" in stopped.reason

    def none_for_places(*_: object) -> None:
        raise TimeUp("the search was stopped among the places")

    with monkeypatch.context() as patch:
        patch.setattr(steps, "begun_open", none_for_places)
        assert explain(case).reason == "the search was stopped among the places"

    def until_second_round(text: str) -> None:
        if ", round 2" in text:
            raise TimeUp("the search was stopped")

    monkeypatch.setattr(Search, "settled", lambda self: False)
    stopped = explain(case, until_second_round)
    assert stopped.reason == "the search was stopped"
    assert [f.ranked.identity for f in stopped.findings] == [("friction.coulomb", "shaft")]


def test_once_released_a_law_has_to_beat_the_simpler_one_it_contains(
    friction_case: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Held, the richer law leads by 100; released, both leave the same, and the price of its parameters decides."""
    case = load(friction_case)
    base, held = both_laws(case)
    coulomb = held[1].fit
    monkeypatch.setattr(Search, "polished", lambda self, ranked, base: ranked.fit)
    floor = noise_floor(case, case.validate, base.noise)
    before = judge(base.machine, base.point)
    search = Search(case, [], Lead((10.0, 0.0)), floor, base.machine.amendment, base, before)
    naming = Naming(held, [])
    best, found = search._best_released(held[0], naming, lambda text: None)
    assert best.identity == ("friction.coulomb", "shaft")
    assert found is coulomb
    assert naming.best is best
    assert best.confidence > 0.5
