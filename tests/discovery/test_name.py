"""Naming: rivals that do equally well, and races that are not finished."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
import time

import pytest

from lacuna.codegen.library.classes import Library
from lacuna.discovery.case.cases import Case, load
from lacuna.discovery.catalogue.amend import Amendment
from lacuna.discovery.catalogue.attachment import Attachment
from lacuna.discovery.catalogue.places import read
from lacuna.discovery.fit.fit import Fit, fit
from lacuna.discovery.fit.lead import fit_believed
from lacuna.discovery.fit.machine import Machine
from lacuna.discovery.fit.solver.time_limit import TimeUp, check, within
from lacuna.discovery.naming import name as naming
from lacuna.discovery.naming import restarts
from lacuna.discovery.naming.name import Naming, compete
from lacuna.discovery.naming.restarts import begin_again
from lacuna.discovery.naming.screen import Candidate, Screen, prepare
from lacuna.runtime import SimulationError

from .conftest import attachment

Prepared = Callable[[str], Candidate]


@pytest.fixture(scope="module")
def case(friction_case: Path) -> Case:
    return load(friction_case)


@pytest.fixture(scope="module")
def base(case: Case) -> Fit:
    return fit_believed(case, Machine(case, Amendment(read(Library(), case.model))))[0]


@pytest.fixture
def prepared(case: Case, base: Fit) -> Prepared:
    """Screened candidates by the name of the effect, not fitted yet."""

    def candidate(effect: str) -> Candidate:
        added = attachment(case, effect)
        machine = Machine(case, Amendment(base.machine.amendment.structure, [added]))
        return prepare(Screen(base), added, machine)[0]

    return candidate


def fitted(case: Case, base: Fit, candidate: Candidate, **how: object) -> Candidate:
    free = [*base.estimate.free, *candidate.free]
    return replace(candidate, fit=fit(candidate.machine, case.fit, base.noise, free, base.fixed, **how))


def test_a_rival_that_ended_in_a_dip_is_begun_again_from_where_the_best_hypothesis_ended(
    case: Case, base: Fit, prepared: Prepared
) -> None:
    """Friction that may depend on the direction is dry friction here: left a little off, it comes to the same end."""
    best = fitted(case, base, prepared("CoulombFriction"))
    rival = prepared("AsymmetricFriction")
    level = best.fit.point[best.attachment.full_name("tau_c")]
    dip = best.fit.point | {rival.attachment.full_name(n): 1.0002 * level for n in ("tau_pos", "tau_neg")}
    rival = fitted(case, base, rival, start=dip, stages=1, iterations=0)
    worse = fitted(case, base, prepared("ConstantLoad"))
    left = worse.fit
    assert rival.fit.deviance() > best.fit.deviance() + 20
    begin_again(case, base, [best, rival, worse], lambda text: None)
    assert rival.fit.deviance() == pytest.approx(best.fit.deviance(), abs=4.0)
    assert worse.fit is left


def test_a_rival_that_does_not_run_where_it_is_begun_again_stays_as_it_is(
    case: Case, base: Fit, prepared: Prepared, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Friction that chatters from the best one's parameters is no reason to lose the diagnosis."""
    best, rival = fitted(case, base, prepared("CoulombFriction")), fitted(case, base, prepared("StribeckFriction"))
    own = rival.fit
    prepare = restarts.prepare

    def chatters(screen: Screen, attachment: Attachment, machine: Machine) -> list[Candidate]:
        if attachment is rival.attachment:
            raise SimulationError("chattering")
        return prepare(screen, attachment, machine)

    monkeypatch.setattr(restarts, "prepare", chatters)
    restarts._contend(case, base, [best, rival], lambda text: None)
    assert rival.fit is own


def raced(case: Case, base: Fit, prepared: Prepared, effect: str, monkeypatch: pytest.MonkeyPatch) -> Naming:
    """The naming of a race that runs out of time when its only hypothesis has been fitted."""

    def too_late(*_: object) -> None:
        raise TimeUp("the search was stopped")

    monkeypatch.setattr(naming, "begin_again", too_late)
    return compete(case, [prepared(effect)], base)


def test_a_race_without_time_names_what_leaves_noise(
    case: Case, base: Fit, prepared: Prepared, monkeypatch: pytest.MonkeyPatch
) -> None:
    found = raced(case, base, prepared, "CoulombFriction", monkeypatch)
    assert found.best.identity == ("friction.coulomb", "shaft")
    with pytest.raises(TimeUp):
        raced(case, base, prepared, "ConstantLoad", monkeypatch)


def test_a_limit_counts_from_when_the_work_was_begun() -> None:
    with within(10.0, time.monotonic() - 11.0), pytest.raises(TimeUp, match="stopped after 10 s"):
        check()
    with within(10.0, time.monotonic() - 9.0):
        check()


def test_no_fit_goes_on_when_the_time_is_up(case: Case, base: Fit, prepared: Prepared) -> None:
    with within(0.0), pytest.raises(TimeUp, match="stopped after 0 s"):
        fitted(case, base, prepared("CoulombFriction"))
    check()  # outside, no limit holds
    assert fitted(case, base, prepared("CoulombFriction"), stages=1, iterations=1).fit is not None
