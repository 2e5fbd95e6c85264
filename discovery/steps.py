"""The steps of an explanation: each fills in more of it, and can be the last that is wanted."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from lacuna.codegen.library.classes import Library
from lacuna.discovery.case.cases import Case
from lacuna.discovery.case.gaps import without_gaps
from lacuna.discovery.case.problem import CaseError
from lacuna.discovery.case.recordings_check import Problem, check_case, without_spikes
from lacuna.discovery.case.thinning import said_of, thinned
from lacuna.discovery.catalogue import catalogue, places
from lacuna.discovery.catalogue.amend import Amendment
from lacuna.discovery.catalogue.hypotheses import enumerate_attachments
from lacuna.discovery.catalogue.searched import believed_structure
from lacuna.discovery.efforts.find import Found, places_of
from lacuna.discovery.efforts.switches import switched, switches
from lacuna.discovery.explanation.explanation import Explanation
from lacuna.discovery.explanation.moved import sensor_instead
from lacuna.discovery.fit.evidence import astray, common_correlation, is_noise
from lacuna.discovery.fit.fit import believed, carried, falling_bandwidths, linearised
from lacuna.discovery.fit.lead import ROUGH, Lead, fit_believed
from lacuna.discovery.fit.machine import Machine
from lacuna.discovery.fit.objective import noise_of
from lacuna.discovery.fit.solver.time_limit import TimeUp
from lacuna.discovery.fit.tracking import trackable
from lacuna.discovery.law.beyond import explain_beyond
from lacuna.discovery.law.locate import effort_at, locate, place_of
from lacuna.discovery.law.open_world import begun_open, equations_first, explain_open, take_at_last
from lacuna.discovery.law.together.nearby import go_on_nearby
from lacuna.discovery.naming.comparison import MIN_GAIN
from lacuna.discovery.naming.dips import explored, is_smooth
from lacuna.discovery.naming.judge import judge, noise_floor, try_judge
from lacuna.discovery.naming.name import rank
from lacuna.discovery.naming.search import Search
from lacuna.discovery.semantic_check import slips, strict_elsewhere

Progress = Callable[[str], None]

STIFFLY = (1.0, 1 / 4, 1 / 16, 1 / 50, 0.0)  # bandwidths of trackers where what is missing is as stiff as they are


def opened(case: Case, library: Library) -> tuple[Explanation, Machine | None]:
    """The case with what is wrong with its recordings, and the believed model; none where they are of no use."""
    result = prepared(case)
    if result.reason:
        return result, None
    machine = _believed_machine(result.case, believed_structure(result.case, library))
    result.problems += [*strict_elsewhere(machine), *slips(machine)]
    return result, machine if _trusted(result, "the recordings contradict themselves") else None


def prepared(case: Case, without: tuple[str, ...] = ()) -> Explanation:
    """The case without gaps and thinned, with what is wrong with its recordings, but `without` problems of these kinds;
    `reason` where they are of no use."""
    result = Explanation(case, [p for p in check_case(case) if p.kind not in without])
    if _trusted(result, "the recordings cannot be trusted"):
        whole = without_gaps(without_spikes(case))
        result.case = thinned(whole, noise_of(whole))
        result.problems += said_of(result.case)
    return result


def _trusted(result: Explanation, otherwise: str) -> bool:
    fatal = [str(p) for p in result.problems if p.fatal]
    if fatal:
        result.reason = f"{otherwise}: " + "; ".join(fatal)
    return not fatal


def fitted(case: Case, progress: Progress, library: Library | None = None) -> Explanation:
    """The believed model fitted and judged. Raises CaseError on recordings that are of no use."""
    result, machine = opened(case, library or case.library())
    if machine is None:
        raise CaseError(result.reason)
    add_fit(result, machine, progress)
    return result


def add_fit(result: Explanation, machine: Machine, progress: Progress) -> None:
    progress("fitting the believed model")
    case = result.case
    result.base, result.lead = fit_believed(case, machine)
    if result.base.machine.case is case and not is_noise(result.base):
        _place_switches(result, progress)
    if result.base.machine.case is not result.case:
        result.case = result.base.machine.case
        length = float(np.ptp(result.case.fit[0].time))
        text = f"what is unknown where it starts grows too fast for one run: it is compared in pieces of {length:.3g} s"
        result.problems.append(Problem("unstable", case.fit[0].name, case.outputs[0].column, None, text, False))
    case, machine = result.case, result.base.machine
    result.amendment, result.final = machine.amendment, result.base
    result.before = result.after = judge(machine, result.base.point)
    result.floor = noise_floor(case, case.validate, result.base.noise)


def _place_switches(result: Explanation, progress: Progress) -> None:
    """Held inputs that switch between samples, as the outputs tell beside what else the believed model lacks."""
    base, before = result.base, result.case
    held = any(switches(before, r) for r in before.fit)
    if not held or base.machine.amendment.trackers or not result.lead.direct:
        return
    progress("looking for when the inputs switched between samples")
    if (case := switched(base)) is None:
        return
    machine = base.machine.amended(base.machine.amendment, case)
    result.case, (result.base, result.lead) = case, fit_believed(case, machine)
    for column in sorted({s.column for r in before.fit for s in switches(before, r)}):
        text = "its steps fall between samples: each was taken to come when the outputs say that it did"
        result.problems.append(Problem("switches", case.fit[0].name, column, None, text, False))


def add_location(result: Explanation, progress: Progress) -> None:
    """What effort is missing, where, in the fitted believed model."""
    progress("locating the missing effort")
    held = result.lead.hold(result.base)
    result.located = locate(held.machine.case, held)


def add_naming(result: Explanation, library: Library, progress: Progress) -> None:
    """The catalogue's effects that could be missing from the fitted believed model, ranked: one round of naming."""
    effects = catalogue.read(library)
    attachments = enumerate_attachments(result.case, result.amendment.structure, effects, result.amendment)
    progress(f"ranking {len(attachments)} hypotheses")
    base = result.lead.hold(result.base)
    result.namings.append(rank(base.machine.case, result.amendment, attachments, base, progress=progress))


def add_amendment(result: Explanation, library: Library, effect: str, progress: Progress) -> None:
    """The model amended by one effect: the named one, or the best of all. Raises CaseError where it does not pay."""
    effects = [e for e in catalogue.read(library) if effect in ("", e.identifier)]
    if not effects:
        raise CaseError(f"the catalogue has no effect {effect}")
    search = _search(result, effects)
    if not search.add(progress):
        raise CaseError(search.reason or f"{effect or 'no effect of the catalogue'} does not explain these recordings")
    _take(result, search)


def add_findings(result: Explanation, library: Library, progress: Progress) -> None:
    """Findings until what is left is noise or nothing pays: of the catalogue, then an empirical law.

    Where the time is up, what was found until then stands.
    """
    unbegun = _search(result, [])
    if not unbegun.settled():
        unbegun.effects = catalogue.read(library)

    def located(found: Found) -> None:
        result.opened = found

    search = _begun(unbegun)
    shafts = trackable(result.case, result.base.machine.model, result.amendment.structure)[:1]
    try:
        places_known = begun_open(unbegun, library, progress)
        search = _begun(unbegun)
        first = places_known is not None and equations_first(unbegun, places_known, progress)
        if first:
            explain_open(search, unbegun, library, progress, places_known, located)
        if not search.findings:
            held, search.restarts = unbegun, bool(shafts)
            search.run(progress, most=1)
            if search.lost():
                search, held = _anew(result, search, unbegun, shafts, progress)
            if not go_on_nearby(search, library, progress):
                explain_beyond(search, held, progress)
            unbegun = held if search.amendment.trackers or not search.lead.direct else unbegun
            if not first:
                explain_open(search, unbegun, library, progress, places_known, located)
        if not search.findings:
            result.instead = sensor_instead(search, catalogue.read(library), progress)
        if result.instead:
            result.opened = places_of(search.case, unbegun.amendment, unbegun.fit, library)
    except TimeUp as stopped:
        search.reason = result.stopped = str(stopped)
        if result.opened is not None:
            take_at_last(search, unbegun, result.opened, progress)
    _take(result, search)


def add_scatter(result: Explanation, progress: Progress) -> None:
    """Where the ground around the final fit is rough: the best dip nearby, and how far apart the dips are. Where
    nothing was found for what is left, it may be that of a dip: dips are gone through as long as they are lower."""
    if result.final is None or not result.lead.direct or (is_noise(result.final) and not result.findings):
        return
    if is_smooth(result.final):
        return
    while True:
        before = result.final
        best, result.scatter = explored(before, progress)
        after = try_judge(best.machine, best.point) if best is not before else None
        if after is None:
            return
        result.final = best
        if result.findings:
            result.rejudge(after)
            return
        result.base, result.before, result.after = best, after, after
        if before.deviance(best.correlation()) - best.deviance(best.correlation()) < MIN_GAIN:
            return


def add_effort(result: Explanation, progress: Progress) -> None:
    """What is missing at the first finding's place by the parameters that were fitted with it: what the law is for."""
    attachments = [f.ranked.attachment for f in result.findings]
    probes = [a.shaft or a.lines[0] for a in attachments if a.shaft or a.lines]
    if not probes or result.located is None:
        return
    progress("locating what the law stands for")
    base = result.lead.hold(result.base)
    there = {f.name: result.final.point[f.name] for f in base.estimate.free}
    held = linearised(base.machine, base.machine.case.fit, base.noise, base.estimate.free, base.fixed, there)
    result.effort = effort_at(held.machine.case, held, place_of(probes[0])) if held else None


def _begun(unbegun: Search) -> Search:
    """A search with nothing found as yet, from one that stays as it is."""
    return replace(unbegun, findings=[], namings=[])


def _held(result: Explanation, unbegun: Search, shafts: list[places.Shaft]) -> Search:
    """A search not yet begun, that compares hypotheses with these recorded shafts held near their motion."""
    case = result.case
    machine = result.base.machine.amended(Amendment(result.amendment.structure, trackers=shafts))
    base = carried(result.base, machine, stages=1)
    lead = Lead(falling_bandwidths(case, machine, STIFFLY), held=1)
    if base is None:
        return unbegun
    return replace(unbegun, lead=lead, amendment=machine.amendment, fit=base)


def _anew(
    result: Explanation, direct: Search, unbegun: Search, shafts: list[places.Shaft], progress: Progress
) -> tuple[Search, Search]:  # fmt: skip
    """(the search begun anew with recorded shafts held, or the direct one where that ends no worse; what it was begun
    from).

    Where the first finding leaves far more than noise, every hypothesis may have ended in a dip of rough ground:
    an output error grows with the recording, and what is missing near its beginning decides all that follows.
    """
    progress("looking again, the recorded shaft held near its motion")
    held = _held(result, unbegun, shafts)
    search = _begun(held)
    search.run(progress, most=1)
    if direct.left is not None and (not search.findings or astray(search.fit)):
        direct.resume(progress)
        if not direct.lost():
            return direct, unbegun
    correlation = common_correlation([search.fit, direct.fit])
    if not search.findings or search.fit.deviance(correlation) > direct.fit.deviance(correlation) - MIN_GAIN:
        return direct, held
    if not astray(search.fit):
        return _let_go(search, direct), held
    result.base, result.lead = held.fit, held.lead
    return search, held


def _let_go(search: Search, direct: Search) -> Search:
    """The search without trackers: a finding that leaves little has led it to where fits need no hold."""
    amendment = replace(search.amendment, trackers=[])
    machine = search.fit.machine.amended(amendment, search.case)
    found = carried(search.fit, machine)
    after = try_judge(machine, found.point) if found is not None else None
    if after is None:
        return search
    free = replace(direct, amendment=amendment, findings=search.findings, namings=search.namings,
                   exhausted=False, left=None)  # fmt: skip
    free.take(amendment.attachments, found, after)
    return free


def _search(result: Explanation, effects: list[catalogue.Effect]) -> Search:
    floor = noise_floor(result.case, result.case.fit, result.base.noise)
    return Search(
        result.case, effects, result.lead, floor, result.amendment, result.final, result.after,
        result.findings, result.namings,
    )  # fmt: skip


def _take(result: Explanation, search: Search) -> None:
    result.amendment, result.final, result.after = search.amendment, search.fit, search.judgement
    result.findings, result.namings, result.reason = search.findings, search.namings, search.reason


def _believed_machine(case: Case, structure: places.Structure) -> Machine:
    """The believed model; with trackers on recorded shafts where its events make a fit rough."""
    machine = Machine(case, Amendment(structure))
    free, fixed = believed(case, machine)
    shafts = trackable(case, machine.model, structure)[:1]
    values = fixed | {f.name: f.centre for f in free}
    machine = machine.precise(values, noise_of(case))
    if not shafts or machine.events_per_second(values, case.fit[0]) < ROUGH:
        return machine
    return machine.amended(Amendment(structure, trackers=shafts))
