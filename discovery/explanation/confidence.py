"""How sure a finding is, in numbers and words; what it is not told from; how much of the misfit the findings explain.

What the findings leave of the misfit is the share of "none of these": it is always in the race.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from lacuna.discovery.explanation.explanation import Explanation
from lacuna.discovery.fit.evidence import excess
from lacuna.discovery.naming.comparison import TEMPER
from lacuna.discovery.naming.name import Finding

CERTAIN = 0.999  # the most that is ever claimed
NONE = "none of these"
OTHER = "that it is none of what was tried"  # in words


def _by_identity(finding: Finding) -> dict[tuple[str, str], float]:
    total: dict[tuple[str, str], float] = {}
    for r in finding.naming.ranked:
        total[r.identity] = total.get(r.identity, 0.0) + r.confidence
    return total


def confidence(finding: Finding, share: float) -> float:
    """The probability of a finding among all that was tried and what was not: the findings explain `share`."""
    return min(_by_identity(finding)[finding.ranked.identity] * share, CERTAIN)


def odds(finding: Finding, share: float) -> str:
    """The confidence in words, against what comes nearest among all that was tried."""
    own = confidence(finding, share)
    found = _by_identity(finding)
    rivals = [(found[i] * share, f"{i[0]} at {i[1]}") for i in found if i != finding.ranked.identity]
    most, name = max([*rivals, (1.0 - share, OTHER)])
    if own >= CERTAIN:
        return f"more than {CERTAIN / (1 - CERTAIN):.0f} to 1 against the next best, {name}"
    return f"{_to_one(own / max(most, 1 - CERTAIN))} against the next best, {name}"


def _to_one(ratio: float) -> str:
    return f"{float(f'{ratio:.2g}'):g} to 1"


def explained(result: Explanation) -> float:
    """Share of the misfit above noise, on the recordings fitted, that the findings take away."""
    if result.instead:  # nothing is above noise, without it either: it is parameters that it puts back
        return 1.0
    before, after = excess(result.base), excess(result.final)
    return float(np.clip(1.0 - after / before, 0.0, 1.0)) if before > 0 else 1.0


def tie(finding: Finding) -> list[dict[str, str]]:
    """A finding and what the data does not tell from it."""
    identities = [finding.ranked.identity, *dict.fromkeys(r.identity for r in finding.naming.rivals(finding.ranked))]
    alike, _ = finding.ranked.attachment.alike
    others = [{"effect": alike, "location": finding.ranked.attachment.location}] if alike else []
    others += [{"effect": "sensor.offset", "location": f"sensor:{finding.instrument}"}] if finding.instrument else []
    named = [{"effect": effect, "location": location} for effect, location in identities]
    others += [named[0] | {"of": finding.moved}] if finding.moved else []
    return named + others


def alternatives(finding: Finding, share: float) -> list[dict[str, Any]]:
    """What else was tried, the likeliest first; and, last, none of it. As nothing is claimed with more than `CERTAIN`,
    nothing is excluded with more."""
    ordered = sorted(_by_identity(finding).items(), key=lambda item: -item[1])
    return [
        {"effect": effect, "location": location, "confidence": max(of_all * share, 1.0 - CERTAIN)}
        for (effect, location), of_all in ordered if (effect, location) != finding.ranked.identity
    ][:5] + [{"effect": NONE, "location": "", "confidence": 1.0 - min(share, CERTAIN)}]  # fmt: skip


def certainty(result: Explanation) -> str:
    """How sure the verdict is, in a sentence."""
    if result.base is None or result.verdict == "undetermined":
        return "No explanation is claimed."
    share = explained(result)
    if result.findings:
        said = [odds(f, share) for f in result.findings]
        each = "; ".join(f"{f.ranked.attachment.location}: {o}" for f, o in zip(result.findings, said, strict=True))
        return f"How sure: {said[0] if len(said) == 1 else each}."
    tried = [r for naming in result.namings for r in naming.ranked]
    if not tried:
        return "How sure: what is left passes for noise over one sample and over hundreds, so nothing was sought."
    best = min(tried, key=lambda r: r.score)
    against = float(np.exp(np.clip(best.score / TEMPER, -50.0, 50.0)))
    sure = f"{_to_one(min(against, CERTAIN / (1 - CERTAIN)))} against the best of what was tried"
    return f"How sure: {sure}, {best.attachment.effect.identifier} at {best.attachment.location}."
