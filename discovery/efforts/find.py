"""The law of a missing effort: located, screened as a regression, fitted by output error, simplified.

Places are taken by their evidence. Where a law of one term found at one leaves noise, only places that the evidence
does not tell from it are tried beside it, so that a tie is said as one. Where it takes two, they may stand for a short
one at another place: an effort of any course, by which places are ranked, does not know which courses are simple.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from lacuna.codegen.library.classes import Library
from lacuna.discovery.case.cases import Case
from lacuna.discovery.case.values import is_parameter
from lacuna.discovery.catalogue.amend import Amendment
from lacuna.discovery.catalogue.trace import left
from lacuna.discovery.efforts.instruments import colour_of, is_colour
from lacuna.discovery.efforts.latent.numeric import NotNumeric
from lacuna.discovery.efforts.law_at import TRIED, LawsAt
from lacuna.discovery.efforts.located import Locator, Site
from lacuna.discovery.efforts.places.opened import opened
from lacuna.discovery.efforts.places.sites import SEVERAL
from lacuna.discovery.fit.evidence import LEFT, common_correlation, nearly_noise, settled
from lacuna.discovery.fit.fit import Fit
from lacuna.discovery.fit.solver.time_limit import TimeUp
from lacuna.discovery.naming.comparison import TIE, rival_score, said
from lacuna.discovery.naming.screen import Candidate
from lacuna.runtime import SimulationError

INDIFFERENT = 5.0  # nats, below which two places are told as one
WORTH = 0.3  # of the best place's gain, that another one must have to be tried where the best one's law leaves too much

Progress = Callable[[str], None]


@dataclass
class Found:
    """What a search at all places says: the places, those not open, and the best law at each that was tried."""

    sites: list[Site] = field(default_factory=list)
    closed: list[tuple[str, str]] = field(default_factory=list)
    laws: list[Candidate] = field(default_factory=list)  # best first
    single: list[Candidate] = field(default_factory=list)  # of one group, where one of two does better; best first
    locator: Locator | None = None
    null: float = 0.0  # log evidence of nothing missing anywhere, over which places have their gain
    reason: str = ""  # why nothing could be located
    tried: set[str] = field(default_factory=set)  # places at which laws were looked for
    short: bool = False  # whether the best law is of one term


def find(
    case: Case,
    amendment: Amendment,
    base: Fit,
    library: Library,
    progress: Progress,
    admitted: Callable[[Site], bool] = lambda site: True,
) -> Found:
    """Locate what `base`, the fit of `amendment`, lacks, and fit laws there: at places that are `admitted`."""
    found = places_of(case, amendment, base, library, progress)
    add_laws(found, case, amendment, base, progress, admitted)
    return found


def add_laws(
    found: Found,
    case: Case,
    amendment: Amendment,
    base: Fit,
    progress: Progress,
    admitted: Callable[[Site], bool] = lambda site: True,
    most: int = TRIED,
    wide: bool = False,
    short: bool = False,
) -> None:
    """Laws at the best places that are `admitted`, up to the `most`-th: those where none has been looked for yet.
    `wide`: also at others that are alike or of their components, and in each quantity of a place by itself. `short`: of
    one group of terms only.

    Laws of one group of terms are looked for at all of these first: one of two at the best place, which takes far
    longer, may stand for a short one at a place that an effort of any course does not tell from it.
    """
    efforts = simplest([s for s in found.sites if s.place is not None and admitted(s)])
    places = [s for s in (_to_try(efforts, most) if wide else efforts[:most]) if s.location not in found.tried]
    begun: list[LawsAt] = []
    try:
        for site in places:
            if _beaten(site, efforts[0]) and (_enough(found, begun, base) or site.gain < WORTH * efforts[0].gain):
                break
            found.tried.add(site.location)
            begun.append(LawsAt(case, amendment, base, found.locator, site, progress, wide, short))
            begun[-1].go_on()
        enough = _enough(found, begun, base)
        for laws in begun:
            behind = efforts[0].gain - laws.site.gain > INDIFFERENT
            likely = not enough or laws in (begun[0], _first(begun, base))
            while likely and not laws.settled and not (behind and any(b.settled for b in begun)) and laws.go_on():
                pass
            _end(found, laws, base, behind)
    except TimeUp:
        for laws in (laws for laws in begun if not laws.ended):
            _put(found.laws, laws.best and laws.best.candidate, base)
        raise


def _end(found: Found, laws: LawsAt, base: Fit, behind: bool) -> None:
    """Take the best law at a place among those found; not one of several terms `behind` one that leaves noise."""
    proposal, single = laws.end()
    if behind and proposal and proposal.law.terms > 1 and found.laws and settled(found.laws[0].fit):
        left(said(proposal.candidate), "comparison", "no shorter than one that leaves noise where more is explained")
    else:
        _put(found.laws, proposal and proposal.candidate, base)
    _put(found.single, single, base)
    if proposal is not None and found.laws[0] is proposal.candidate:
        found.short = proposal.law.terms == 1


def _beaten(site: Site, best: Site) -> bool:
    """Whether an effort at a place tells clearly less than one at the best place, and leaves clearly more."""
    return best.gain - site.gain > INDIFFERENT and not alike(site, best)


def _enough(found: Found, begun: list[LawsAt], base: Fit) -> bool:
    """Whether a law of one term leaves noise, of those found and of those looked for."""
    first = _first(begun, base)
    short = first is not None and first.best.law.terms == 1 and _leaves_noise(first.best.candidate.fit)
    return short or (found.short and _leaves_noise(found.laws[0].fit))


def _leaves_noise(fit: Fit) -> bool:
    return nearly_noise(fit) or is_colour(fit)


def _first(begun: list[LawsAt], base: Fit) -> LawsAt | None:
    """Where the best law is, of the places looked at."""
    fitted = [laws for laws in begun if laws.best is not None]
    if not fitted:
        return None
    correlation = common_correlation(laws.best.candidate.fit for laws in fitted)
    return min(fitted, key=lambda laws: rival_score(laws.best.candidate, base, correlation))


def _to_try(efforts: list[Site], most: int) -> list[Site]:
    """The first `most` places and as many that are alike to the best one, and behind them up to as many of the same
    components: of two equations of one component a law may be short in the one and long in the other. Families are
    beside them: with an effort for each member they explain no less than the one that lacks something."""

    def parts(site: Site) -> set[str]:
        return {s.instance or s.label for s in site.place.sites}

    alone = [s for s in efforts if not is_family(s)]
    wanted = {id(s) for s in [*alone[:most], *(s for s in alone[most : 2 * most] if alike(s, alone[0]))]}
    count = max((k + 1 for k, s in enumerate(efforts) if id(s) in wanted), default=len(efforts))
    first, behind = efforts[:count], efforts[count:]
    near = set[str]().union(*map(parts, first))
    return [*first, *[s for s in behind if parts(s) & near][:most]]


def alike_first(found: Found) -> int:
    """How many of the places to be tried an effort of any course does not tell from the best one."""
    efforts = simplest(found.sites)
    return sum(alike(site, efforts[0]) for site in efforts[:TRIED])


def is_family(site: Site) -> bool:
    """Whether a place is several at once, with an effort of its own in each."""
    return site.place is not None and bool(site.place.sites[0].members)


def alike(site: Site, best: Site) -> bool:
    """Whether an effort at a place leaves hardly more than at another one, whatever the nats between them: to first
    order about a run far from the data these tell apart what laws do not."""
    return 1.0 - site.explains <= LEFT**2 * (1.0 - best.explains)


def places_of(
    case: Case, amendment: Amendment, base: Fit, library: Library, progress: Progress = lambda text: None
) -> Found:
    """The places of the amended model, ranked; no laws."""
    progress("locating among all places of the equations")
    try:
        locator = located(case, amendment, base, library)
        return Found(_ranked(locator, base), locator.opened.closed, locator=locator, null=locator.null)
    except (NotNumeric, SimulationError, np.linalg.LinAlgError) as reason:
        return Found(reason=str(reason))


def located(case: Case, amendment: Amendment, base: Fit, library: Library) -> Locator:
    """Every place of the amended model, about the runs of the machine that is believed, since a fit without what is
    missing may have taken parameters anywhere, or about those of the fit, since what is believed may miss a resonance
    by cycles: about those where some effort explains more. Raises SimulationError where the fit does not run."""
    free = [f.name for f in base.estimate.free if is_parameter(f.name)]
    door = opened(case, amendment, library, free, base.machine)
    found = Locator(case, door, base)
    try:
        believed = Locator(case, door, base, base.point | base.believed())
    except SimulationError:
        return found
    return max(believed, found, key=_told)


def _told(locator: Locator) -> float:
    """Log evidence of an effort at the place where one explains most."""
    sites = locator.ranked()
    return locator.null + max((s.gain for s in sites if s.place is not None), default=-np.inf)


def simplest(sites: list[Site]) -> list[Site]:
    """The places, no sensors, that tell something, without those in several balances at once (what is exchanged, what
    varies) that do not tell clearly more than any one balance."""
    efforts = [s for s in sites if s.place is not None and s.gain > 0]
    one = max((s.gain for s in efforts if s.place.sites[0].kind not in SEVERAL), default=-np.inf)
    return [s for s in efforts if s.place.sites[0].kind not in SEVERAL or s.gain > one + INDIFFERENT]


def _put(laws: list[Candidate], law: Candidate | None, base: Fit) -> None:
    """Add a law to others, best first; of one course in one balance and at all places of a family, as good as one
    another, the one in the balance: nothing tells it of the others."""
    if law is None:
        return
    laws.append(law)
    correlation = common_correlation(c.fit for c in laws)
    scores = {id(c): rival_score(c, base, correlation) for c in laws}
    laws.sort(key=lambda c: scores[id(c)])
    alone = [c for c in laws if not c.attachment.site.members]
    laws[:] = [
        c for c in laws
        if not c.attachment.site.members or not any(
            one.attachment.law.course() == c.attachment.law.course() and scores[id(one)] < scores[id(c)] + TIE
            for one in alone
        )
    ]  # fmt: skip


def _ranked(locator: Locator, base: Fit) -> list[Site]:
    """Places by their evidence; beside errors of sensors with a memory, where nobody gave the level of their noise and
    what the best effort leaves is not white."""
    sites = locator.ranked()
    if not locator.places or locator.white(sites[0]) or all(n.given for n in base.noise.values()):
        return sites
    locator.colour = colour_of(locator)
    return locator.ranked()
