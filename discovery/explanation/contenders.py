"""Between which explanations a further experiment has to decide."""

from __future__ import annotations

from lacuna.discovery.experiment.separation import Rival, released
from lacuna.discovery.explanation.explanation import Explanation
from lacuna.discovery.explanation.wording import at, in_a_sentence
from lacuna.discovery.fit.evidence import common_correlation
from lacuna.discovery.law.law import law_at
from lacuna.discovery.naming.comparison import Ranked, price
from lacuna.discovery.naming.name import Finding

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
