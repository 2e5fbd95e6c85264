"""The best law at one place: screened, fitted in a race, varied, simplified."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np

from lacuna.discovery.case.cases import Case
from lacuna.discovery.catalogue.amend import Amendment
from lacuna.discovery.efforts.guide import Guided, guide
from lacuna.discovery.efforts.latent.numeric import NotNumeric
from lacuna.discovery.efforts.laws.begun import begun_at
from lacuna.discovery.efforts.laws.screening import proposals
from lacuna.discovery.efforts.laws.variants import varied
from lacuna.discovery.efforts.located import Locator, Site
from lacuna.discovery.fit.evidence import astray, common_correlation, settled
from lacuna.discovery.fit.fit import Fit
from lacuna.discovery.fit.lead import joined
from lacuna.discovery.law.empirical_law import race, simplified, unfitted
from lacuna.discovery.law.law_screen import Proposal
from lacuna.discovery.naming.comparison import TIE, note_laws, rival_score
from lacuna.discovery.naming.race import NEAR
from lacuna.discovery.naming.screen import Candidate
from lacuna.runtime import SimulationError

TRIED = 3  # places at most at which laws are fitted, and laws of one group of terms there, and of two

Progress = Callable[[str], None]


def law_at(
    case: Case, amendment: Amendment, base: Fit, locator: Locator, site: Site, progress: Progress, wide: bool = False
) -> tuple[Proposal | None, Candidate | None]:
    """The best law at a place: of one group of terms, or of two where one does not leave noise; and, where it is of two
    that are not a level and one term, the best of one."""
    best: Proposal | None = None
    single: Proposal | None = None
    begun: list[Candidate | None] = []
    fitted: list[Proposal] = []
    for tried, guided in _offered(locator, site, progress, wide):
        for proposal in tried:
            progress(f"fitting a law at {site.location}: {proposal.law.text()}")
            proposal.candidate = begun_at(case, amendment, base, proposal, guided.point)
        begun += [p.candidate for p in tried]
        race(case, base, [p.candidate for p in tried if p.candidate is not None], best and best.candidate)
        if best is None:
            _join(case, base, [p.candidate for p in tried if p.candidate is not None], guided)
        tried = [p for p in (best, *tried) if p is not None and p.candidate is not None and p.candidate.fit is not None]
        fitted += tried
        best = _best(tried, base)
        if best is not None and not settled(best.candidate.fit):
            near = _near(tried, best, base)
            best = _best([best, *(v for law in near for v in _varied(case, amendment, base, law))], base)
        if best is not None and len(best.law.groups) > 1:
            best = _shortest([p for p in tried if len(p.law.groups) > 1], best, base)
        single = best if best is None or len(best.law.groups) == 1 else single
        if best is not None and settled(best.candidate.fit):
            break
    note_laws(begun, best and best.candidate, base)
    if best is None:
        return None, None
    best = _in_its_balance(fitted, best, base, site.location)
    apart = best is not single and best.law.terms > 1
    return simplified(case, amendment, base, best), single.candidate if apart and single else None


def _near(fitted: list[Proposal], best: Proposal, base: Fit) -> list[Proposal]:
    """The best law and those still in the race with it: which of them has the right form, their variants say."""
    correlation = best.candidate.fit.correlation()
    least = rival_score(best.candidate, base, correlation)
    return [p for p in fitted if rival_score(p.candidate, base, correlation) < (1 - NEAR) * least]


def _varied(case: Case, amendment: Amendment, base: Fit, best: Proposal) -> list[Proposal]:
    """A fitted law's variants, fitted from there side by side."""
    found = varied(best)
    for other in found:
        other.candidate = unfitted(case, amendment, base, other.law, other.start, best.candidate.fit.point)
    found = [other for other in found if other.candidate is not None]
    race(case, base, [other.candidate for other in found], best.candidate)
    return [other for other in found if other.candidate.fit is not None]


def _join(case: Case, base: Fit, laws: list[Candidate], guided: Guided) -> None:
    """The first law again, by multiple shooting along what it was screened on, where every one's fit has gone astray:
    what is found there to first order may be out of reach of a run from the beginning."""
    if not laws or any(not astray(law.fit) for law in laws if law.fit is not None):
        return
    first = laws[0]
    courses = {r.piece: p.along.values for r, p in zip(case.fit, guided.pieces, strict=True)}
    free = [*base.estimate.free, *first.free]
    found = joined(first.machine, case, base.noise, free, base.fixed, first.start, courses)
    whole = found is not None and found.machine is first.machine
    if whole and (first.fit is None or found.deviance() < first.fit.deviance()):
        first.fit = found


def _offered(
    locator: Locator, site: Site, progress: Progress, wide: bool
) -> Iterator[tuple[list[Proposal], Guided]]:  # fmt: skip
    """Laws to be fitted at a place, as they are asked for, and what they were screened along."""
    try:
        guided = guide(locator, site)
        progress(f"screening laws at {site.location}")
        for offered in proposals(locator, site, guided, TRIED, apart=wide):
            yield offered, guided
    except (NotNumeric, SimulationError, np.linalg.LinAlgError):
        return


def _best(fitted: list[Proposal], base: Fit) -> Proposal | None:
    return min(fitted, key=_scorer(fitted, base)) if fitted else None


def _shortest(fitted: list[Proposal], best: Proposal, base: Fit) -> Proposal:
    """Of laws that the data does not tell from the best one the best of the fewest numbers."""
    scored = _scorer([*fitted, best], base)
    untold = [p for p in (*fitted, best) if scored(p) < scored(best) + TIE]
    return min(untold, key=lambda p: (len(p.candidate.free), scored(p)))


def _in_its_balance(fitted: list[Proposal], best: Proposal, base: Fit, location: str) -> Proposal:
    """Of laws of no more numbers that the data does not tell from the best one that in the place's own balance: an
    input is off only where that says more (what is behind a coil's voltage is behind its current)."""
    own = [p for p in fitted if p.law.site.location == location and len(p.candidate.free) <= len(best.candidate.free)]
    if best.law.site.location == location or not own:
        return best
    scored = _scorer([best, *own], base)
    first = min(own, key=scored)
    return first if scored(first) < scored(best) + TIE else best


def _scorer(fitted: list[Proposal], base: Fit) -> Callable[[Proposal], float]:
    """Deviance and price of a law, samples discounted alike."""
    correlation = common_correlation(p.candidate.fit for p in fitted)
    return lambda p: rival_score(p.candidate, base, correlation)
