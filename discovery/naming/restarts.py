"""Hypotheses begun again from elsewhere, so that no dip which a fit ended in decides which of them is named.

Laws that the best one contains begin where it ended; and so do its rivals.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial

from lacuna.discovery.case.cases import Case
from lacuna.discovery.fit.evidence import is_noise
from lacuna.discovery.fit.fit import Fit, linearised
from lacuna.discovery.fit.solver.side_by_side import in_threads
from lacuna.discovery.naming.candidate_fit import fit_candidate
from lacuna.discovery.naming.comparison import TIE, Progress, best_correlation, score
from lacuna.discovery.naming.race import HALF, NEAR, ROUNDS
from lacuna.discovery.naming.screen import Candidate, Screen, prepare, telling_recordings
from lacuna.runtime import SimulationError

AS_GOOD = 3.0  # times what the best hypothesis leaves, that rivals may at first where they are begun again from its end


def begin_again(case: Case, base: Fit, candidates: list[Candidate], progress: Progress) -> None:
    """Fit those that may do better again, on top of `base`."""
    _simplify(case, base, candidates, progress)
    _contend(case, base, candidates, progress)


def _near(base: Fit, best: Candidate) -> float:
    """The deviance up to which a rival of the best hypothesis may still be made equal to it."""
    return best.fit.deviance() + NEAR * (base.deviance() - best.fit.deviance())


def _take(candidate: Candidate, found: Fit | None) -> None:
    """Keep a fit that is better than the one that the candidate has."""
    if found is not None and found.deviance() < candidate.fit.deviance():
        candidate.fit = found


def _simplify(case: Case, base: Fit, candidates: list[Candidate], progress: Progress) -> None:
    """Start the laws that the best hypothesis contains from where it ended: a simpler one may do as well."""
    best = min(candidates, key=lambda c: c.fit.deviance())
    for candidate in candidates:
        if best.attachment.contains(candidate.attachment):
            _take(candidate, _from_richer(case, base, candidate, best, progress))


def _from_richer(
    case: Case, base: Fit, candidate: Candidate, best: Candidate, progress: Progress
) -> Fit | None:  # fmt: skip
    """The fit of a law from the values of one that contains it; None where a first look shows it far behind."""
    start = candidate.fit.point | {f.name: best.fit.point[f.name] for f in base.estimate.free}
    start |= _shared(candidate, best)
    correlation = best_correlation([best])
    goal = HALF * score(best, base, correlation)

    def hopeful(found: Fit) -> bool:
        return score(replace(candidate, fit=found), base, correlation) <= goal

    return _fit_again(case, base, replace(candidate, start=start, shift={}), hopeful, progress)


def _shared(candidate: Candidate, richer: Candidate) -> dict[str, float]:
    """The values of a law in one that contains it: of the same name, or the mean of the levels of friction there."""
    own, point = richer.attachment, richer.fit.point
    places = {f.name: own.full_name(f.name.rsplit(".", 1)[-1]) for f in candidate.free}
    shared = {name: point[place] for name, place in places.items() if place in point}
    levels = [point[own.full_name(n)] for n in own.effect.levels if own.full_name(n) in point]
    if candidate.attachment.effect.friction and levels and not shared:
        shared = dict.fromkeys(places, sum(levels) / len(levels))
    return shared


def _fit_again(
    case: Case, base: Fit, candidate: Candidate, hopeful: Callable[[Fit], bool], progress: Progress
) -> Fit | None:  # fmt: skip
    """The fit of a candidate from its start; None where a first look at it is not hopeful."""
    candidate = replace(candidate, fit=None)
    for stages, iterations, _ in (ROUNDS[0], ROUNDS[-1]):
        candidate.fit = fit_candidate(case, base, stages, iterations, progress, candidate)
        if candidate.fit is None or not hopeful(candidate.fit):
            return None
    return candidate.fit


def _contend(case: Case, base: Fit, candidates: list[Candidate], progress: Progress) -> None:
    """Begin rivals of the best hypothesis again, the base's parameters where that one left them.

    Without an effect they stand for it as well as they can, and on the way back a fit may end in a dip: which of two
    hypotheses that do equally well is named must not hang on that. Where the best one leaves nothing but noise, those
    that leave as little are in no dip.
    """
    best = min(candidates, key=lambda c: c.fit.deviance())
    near = _near(base, best)
    close = sorted([c for c in candidates if c.fit.deviance() <= near], key=lambda c: c.fit.deviance())
    sure = best.fit.deviance() + TIE if is_noise(best.fit) else float("-inf")
    if len(close) < 2 or close[-1].fit.deviance() <= sure:
        return
    there = linearised(base.machine, case.fit, base.noise, base.estimate.free, base.fixed, best.fit.point)
    if there is None:
        return
    screen = Screen(there, telling_recordings(there), coarsely=True)

    def fit_again(pair: tuple[Candidate, Candidate]) -> None:
        candidate, again = pair
        found = _fit_again(case, there, again, lambda f: f.deviance() <= candidate.fit.deviance(), progress)
        if found is not None:
            candidate.fit, candidate.free, candidate.fixed = found, again.free, again.fixed

    prepared = in_threads(partial(_prepared, screen), close)
    least = AS_GOOD * (1.0 - prepared[0].predicted)
    pairs = zip(close, prepared, strict=True)
    in_threads(fit_again, [p for p in pairs if p[0].fit.deviance() > sure and 1.0 - p[1].predicted <= least])


def _prepared(screen: Screen, candidate: Candidate) -> Candidate:
    """The candidate at its most promising start against another fit of the base; without promise where it does not run
    there."""
    try:
        found = prepare(screen, candidate.attachment, candidate.machine)
    except SimulationError:
        found = []
    return found[0] if found else replace(candidate, predicted=0.0)
