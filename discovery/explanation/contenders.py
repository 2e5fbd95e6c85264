"""Between which explanations a further experiment has to decide, and whether they are one physics after all."""

from __future__ import annotations

from lacuna.discovery.efforts.places.opened import ALIKE
from lacuna.discovery.efforts.places.place import adjoins
from lacuna.discovery.experiment.separation import Rival, released
from lacuna.discovery.explanation.explanation import Explanation
from lacuna.discovery.explanation.wording import at, in_a_sentence
from lacuna.discovery.fit.evidence import common_correlation
from lacuna.discovery.law.law import law_at
from lacuna.discovery.naming.comparison import Ranked, price
from lacuna.discovery.naming.name import AS_LIKELY, Finding
from lacuna.runtime import SimulationError

BELIEVED = "the believed model"
MOST = 3  # rivals of the first explanation


def contenders(result: Explanation) -> list[Rival]:
    """The first explanation and its rivals; none where nothing is open, or where it is an instrument's error or not,
    or a law of one input or another.

    Of findings: the first that is tied, and what it is tied with: at other places, else of other physics there. Where
    nothing stands: the best of all that was tried, the next best, and the believed model. A law that holds another as a
    special case is no rival of it: no experiment speaks for the simpler one.
    """
    if any(f.instrument or f.moved for f in result.findings):
        return []
    for finding in result.findings:
        if rivals := finding.elsewhere or _of_another_kind(finding):
            return _told(finding.ranked, rivals)
    if result.verdict != "undetermined" or result.base is None:
        return []
    believed = released(BELIEVED, result.base)
    tried = _tried(result)
    return [*_told(tried[0], tried[1:], MOST - 1), believed] if tried else []


def _of_another_kind(finding: Finding) -> list[Ranked]:
    own = finding.ranked.attachment
    return [
        r for r in finding.naming.rivals(finding.ranked)
        if not r.attachment.contains(own) and not own.contains(r.attachment)
    ]  # fmt: skip


def is_anywhere(result: Explanation, finding: Finding) -> bool:
    """Whether the data cannot tell where it is, and that makes a difference: what is at one end of a rigid gear is, by
    its ratio, at the other; a force in a damper is the physics that it is on what the damper holds."""
    own = finding.ranked
    others = [r for r in finding.elsewhere if not (_adjoins(own, r) or _turn_as_one(result, own, r))]
    return finding.tied and sum(r.confidence for r in others) > AS_LIKELY * finding.ranked.confidence


def _turn_as_one(result: Explanation, one: Ranked, other: Ranked) -> bool:
    """Whether two hypotheses are one effect at shafts whose speeds have a fixed ratio."""
    machine, recording = result.final.machine, result.case.fit[0]
    shafts = [r.attachment.shaft for r in (one, other)]
    names = [f"{s.location}.w" for s in shafts if s is not None and f"{s.location}.w" in machine.model.variables]
    if len(names) < 2 or one.identity[0] != other.identity[0]:
        return False
    try:
        found = machine.trajectory(result.final.point, recording, names)
    except SimulationError:
        return False
    a, b = (found[n] for n in names)
    return float(a @ a) * float(b @ b) - float(a @ b) ** 2 < ALIKE * float(a @ a) * float(b @ b)


def _adjoins(one: Ranked, other: Ranked) -> bool:
    """Whether two laws are at one component, or at what it is joined to."""
    sites = [r.attachment.site for r in (one, other)]
    return None not in sites and adjoins(*sites)


def _told(first: Ranked, others: list[Ranked], most: int = MOST) -> list[Rival]:
    """The first and the best of each other physics or place."""
    best: dict[tuple[str, str], Ranked] = {}
    for ranked in [first, *others]:
        best.setdefault(ranked.identity, ranked)
    return [released(named(r), r.fit) for r in list(best.values())[: 1 + most]]


def named(ranked: Ranked) -> str:
    """What it is and where; of a law, with its numbers."""
    attachment = ranked.attachment
    if attachment.law is not None:
        return f"{law_at(attachment, ranked.fit.point)} {at(attachment.location)}"
    return f"{in_a_sentence(attachment.effect.title)} at {attachment.location}"


def _tried(result: Explanation) -> list[Ranked]:
    """What was tried on top of the believed model, the likeliest first."""
    base, laws = result.base, result.opened.laws if result.opened else []
    found = {
        id(r): r for r in [*(r for n in result.namings[:1] for r in n.ranked), *(f.ranked for f in result.findings)]
    }
    ranked = [*found.values(), *(Ranked(law, law.fit, 0.0) for law in laws)]
    if not ranked:
        return []
    correlation = common_correlation(r.fit for r in ranked)

    def evidence(r: Ranked) -> float:
        return r.fit.deviance(correlation) + price(len(r.candidate.free), base, correlation)

    return sorted(ranked, key=evidence)
