"""Two laws at two places, each in the other's way; slopes that are infinite at a sample; what parameters' errors do."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from lacuna.codegen.errors import Diagnostic
from lacuna.codegen.symbolic.expr import const, mul, power, var
from lacuna.discovery.case.cases import load
from lacuna.discovery.catalogue import catalogue
from lacuna.discovery.catalogue.amend import Amendment
from lacuna.discovery.catalogue.hypotheses import enumerate_attachments
from lacuna.discovery.catalogue.places import read as read_structure
from lacuna.discovery.efforts.find import Found
from lacuna.discovery.efforts.guide import guide
from lacuna.discovery.efforts.latent.numeric import Evaluator, NotNumeric, finite
from lacuna.discovery.efforts.laws.screening import proposals
from lacuna.discovery.efforts.located import Locator, Site
from lacuna.discovery.efforts.places.opened import opened
from lacuna.discovery.explain import explain
from lacuna.discovery.explanation.explanation import Explanation
from lacuna.discovery.fit.evidence import nearly_noise
from lacuna.discovery.fit.fit import believed, fit
from lacuna.discovery.fit.machine import Machine
from lacuna.discovery.fit.objective import noise_of
from lacuna.discovery.fit.solver.free import Free
from lacuna.discovery.law.empirical_law import fitted_law
from lacuna.discovery.law.law import Law
from lacuna.discovery.law.law_screen import Proposal
from lacuna.discovery.law.terms.law_terms import Group
from lacuna.discovery.law.together.joining import Joining
from lacuna.discovery.law.together.pairs import Place, paired
from lacuna.discovery.law.together.several import _taken_out, find_long_anew, finding, is_of_form, simplify
from lacuna.discovery.naming.candidate_fit import without
from lacuna.discovery.naming.foretold import DRAWS, foretold
from lacuna.discovery.naming.screen import Candidate
from lacuna.discovery.naming.search import Search
from lacuna.discovery.steps import fitted

from .test_efforts import BELIEVED, TORRICELLI, cascade

TWO_LAWS = TORRICELLI.replace("q - k*upper", "q - k*upper - 2e-3*upper^3")
together = pytest.mark.xdist_group("two laws of a cascade")


@pytest.fixture(scope="module")
def result(tmp_path_factory: pytest.TempPathFactory) -> Explanation:
    """A root in the lower tank's outflow, and a loss from the upper one that grows with the cube of its level."""
    return explain(load(cascade(tmp_path_factory.mktemp("two_laws"), TWO_LAWS)))


def searched(result: Explanation) -> Search:
    """The search that has found what was explained."""
    case, base, after = result.case, result.final, result.after
    return Search(case, [], result.lead, result.floor, result.amendment, base, after, list(result.findings))


@together
def test_two_laws_at_two_places_are_found_at_both(result: Explanation) -> None:
    assert result.verdict == "missing_physics"
    assert {f.ranked.attachment.location for f in result.findings} == {"upper", "lower"}
    floor = np.sqrt(np.mean([f**2 for f in result.floor.values()]))
    assert result.after.validate[""] < 1.1 * floor


def test_a_law_is_screened_beside_an_effort_at_another_place(tmp_path: Path) -> None:
    """What both leave is no law of the upper tank's level; beside an effort of any course in the lower one it is."""
    case = load(cascade(tmp_path, TWO_LAWS))
    told = fitted(case, lambda text: None)
    locator = Locator(case, opened(case, told.amendment, case.library(), ["A", "B", "k"]), told.base)
    pair = paired(Found(locator.ranked(), locator=locator), lambda text: None)
    assert {place.site.location for place in pair} == {"upper", "lower"}
    upper = next(place for place in pair if place.site.location == "upper")
    assert all({v.name for v in proposal.law.references()} == {"upper"} for proposal in next(upper.offered))
    alone = locator.ranked()[0]
    ones = [{v.name for v in p.law.references()} for p in next(proposals(locator, alone, guide(locator, alone), 3))]
    assert "q" in ones[0] and {"upper"} in ones  # that of the state whose balance it is goes to the fits, too


def test_places_that_leave_as_little_are_tried_beside_the_best_one() -> None:
    def site(location: str, explains: float) -> Site:
        return Site(location, "effort", 1e4 * explains, explains)

    car, *_ = others = [site("car", 0.9), site("weight", 0.99), site("sheave", 0.988), site("rope", 0.97)]
    ranked = sorted(others[1:], key=lambda s: -s.gain)
    near = Place(None, ranked[0], ranked).alike(car)
    assert [p.site.location for p in near] == ["sheave"]
    assert Place(None, ranked[0], ranked).alike(ranked[1]) == []


def test_a_finding_that_the_others_do_without_is_dropped(tmp_path: Path) -> None:
    """An offset of a sensor that is found first, and is nothing once the law stands."""
    case = load(cascade(tmp_path, TORRICELLI))
    result = explain(case)
    offsets = [e for e in catalogue.read(case.library()) if e.identifier == "sensor.offset"]
    offset = enumerate_attachments(result.case, result.amendment.structure, offsets, result.amendment)[0]
    own = Free(offset.full_name(offset.effect.parameters[0].name), 0.0, 1e-3)
    amendment = replace(result.amendment, attachments=[*result.amendment.attachments, offset])
    machine = result.final.machine.amended(amendment)
    free = [*result.final.estimate.free, own]
    both = fit(machine, result.case.fit, result.final.noise, free, result.final.fixed, start=result.final.point)
    first = finding(Candidate(offset, machine, [own], fit=both), result.base, result.before, result.after)
    search = Search(
        result.case, [], result.lead, result.floor, amendment, both, result.after, [first, *result.findings]
    )
    search.drop_needless(lambda text: None)
    assert [f.ranked.attachment.effect.identifier for f in search.findings] == ["unknown"]
    assert search.fit.deviance() == pytest.approx(result.final.deviance(), abs=0.1)  # as near as a fit ends


def test_what_is_told_best_where_a_law_is_already_is_that_laws_form() -> None:
    """Laws at other places would stand for the difference, as two terms of a valve did for a Stribeck curve."""

    def left(here: float, elsewhere: float) -> bool:
        place = SimpleNamespace(sites=[SimpleNamespace(kind="node")])
        sites = [Site("slide", "effort", here, 0.9, place), Site("valve", "effort", elsewhere, 0.8, place)]
        return is_of_form(sites, lambda site: site.location != "slide")

    assert left(here=1000.0, elsewhere=900.0)
    assert not left(here=1000.0, elsewhere=998.0)
    assert not left(here=900.0, elsewhere=1000.0)


def test_a_slope_that_is_infinite_at_a_sample_is_that_beside_it() -> None:
    level = np.array([0.0, 0.25, 1.0, 0.0])
    slope = mul(const(0.5), power(var("h"), const(-0.5)))
    assert finite(Evaluator(lambda n: level), 4)(slope) == pytest.approx([1.0, 1.0, 0.5, 0.5])
    with pytest.raises(NotNumeric):
        finite(Evaluator(lambda n: 0.0 * level), 4)(slope)


def test_what_is_foretold_is_the_response_to_the_drawn_parameters(tmp_path: Path) -> None:
    case = load(cascade(tmp_path, BELIEVED))
    machine = Machine(case, Amendment(read_structure(case.library(), case.base)))
    free, fixed = believed(case, machine)
    (k,) = [f for f in free if f.name == "k"]
    found = fit(machine, case.fit, noise_of(case), [k], fixed | {f.name: f.centre for f in free if f is not k})
    error = float(np.sqrt(found.estimate.covariance(found.inflation())[0, 0]))
    (recording,) = case.validate
    drawn = np.abs(np.random.default_rng(0).standard_normal(DRAWS)).max()
    higher, lower = (machine.simulate(found.point | {"k": found.point["k"] + s}, recording) for s in (error, -error))
    for column, spread in foretold(found, case.validate).items():
        moved = drawn * np.sqrt(np.mean((higher[column] - lower[column]) ** 2)) / 2
        assert spread == pytest.approx(moved / np.std(recording.columns[column]), rel=0.02)


def test_a_law_that_another_is_a_function_of_stays() -> None:
    def amended(_: object) -> Machine:
        raise Diagnostic("R002", "there is no variable law_T2")

    found = SimpleNamespace(estimate=SimpleNamespace(free=[]), fixed={}, machine=SimpleNamespace(amended=amended))
    ranked = SimpleNamespace(attachment=SimpleNamespace(component="law_T2"))
    assert without(found, ranked, None) is None


@together
def test_a_term_that_stood_for_what_is_missing_elsewhere_goes(result: Explanation) -> None:
    """A constant in the upper tank's law beside what is missing there: once the lower one's stands it is nothing."""
    search = searched(result)
    k = next(k for k, f in enumerate(search.findings) if f.ranked.attachment.location == "upper")
    ranked = search.findings[k].ranked
    law, start = ranked.attachment.law, ranked.attachment.own_values(search.fit.point)
    richer = Law(law.site, (*law.groups, Group(("1",))))
    added = f"c_{len(richer.numbered())}"
    amendment, base = _taken_out(search, k)
    law = fitted_law(search.case, amendment, base, richer, start | {added: 0.01 * start["c_1"]})
    search.findings[k] = finding(law, base, result.before, result.after)
    search.take([*amendment.attachments, law.attachment], law.fit, result.after)
    simplify(search, lambda text: None)
    kept = [f.ranked.attachment for f in search.findings if f.ranked.attachment.location == "upper"]
    assert [len(a.law.groups) for a in kept] == [len(richer.groups) - 1]


@together
def test_a_law_of_several_terms_is_found_anew_beside_the_others(result: Explanation) -> None:
    """The cube of the upper tank's level, for which two other powers of it stood."""
    search = searched(result)
    k = next(k for k, f in enumerate(search.findings) if f.ranked.attachment.location == "upper")
    site = search.findings[k].ranked.attachment.law.site
    level = next(v for v in site.variables if v.name == "upper" and not v.minus)
    longer = Law(site, (Group((f"{level.scaled}^2",)), Group((f"{level.scaled}^4",))))
    amendment, base = _taken_out(search, k)
    law = fitted_law(search.case, amendment, base, longer, {"c_1": -1e-4, "c_2": -1e-4})
    search.findings[k] = finding(law, base, result.before, result.after)
    search.take([*amendment.attachments, law.attachment], law.fit, result.after)
    find_long_anew(search, search.case.library(), lambda text: None)
    found = search.findings[k].ranked.attachment
    assert (found.location, len(found.law.groups)) == ("upper", 1)
    assert search.fit.deviance() == pytest.approx(result.final.deviance(), abs=2.0)


@together
def test_of_two_laws_one_is_found_anew_with_the_other_in_the_model(result: Explanation) -> None:
    """The cube of the upper tank's level, for which the level itself stood."""
    base = result.base
    unbegun = Search(result.case, [], result.lead, result.floor, base.machine.amendment, base, result.before)
    joining = Joining(unbegun, result.case.library(), lambda text: None)
    laws = {f.ranked.attachment.location: f.ranked.attachment for f in result.findings}
    upper, lower = (Proposal(a.law, a.own_values(result.final.point)) for a in (laws["upper"], laws["lower"]))
    level = next(v for v in upper.law.site.variables if v.name == "upper" and not v.minus)
    wrong = joining._joint(lower, Proposal(Law(upper.law.site, (Group((level.scaled,)),)), {"c_1": -1e-3}))
    assert not nearly_noise(wrong.fit)
    right = joining._anew(wrong)
    assert nearly_noise(right.fit)
    assert right.two.law.text() == upper.law.text() and right.one.law.site.location == "lower"
